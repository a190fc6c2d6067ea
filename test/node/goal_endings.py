#!/usr/bin/python3
"""How goals end before their time: cancelled, replaced by another client, by a command, by a stop."""
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import FollowJointTrajectoryResult as Result
from control_msgs.srv import QueryTrajectoryState
from trajectory_msgs.msg import JointTrajectory

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import Driver, goal, point, trajectory  # noqa: E402

JOINTS = ['joint%d' % i for i in range(1, 7)]
ZERO = [0.0] * 6
LONG_WAY = [2.0] * 6
LONG_TIME = 10.0


class GoalEndings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver('/driver')
        cls.command = rospy.Publisher('/driver/command', JointTrajectory, queue_size=1)
        while cls.command.get_num_connections() == 0:
            rospy.rostime.wallsleep(0.01)

    def setUp(self):
        self.driver.wait_standstill()
        here = self.driver.positions()
        if max(abs(p) for p in here) > 1e-3:
            self.driver.go(JOINTS, ZERO, 2.0)

    def start_long_goal(self):
        self.driver.action.send(goal(JOINTS, [point(LONG_TIME, LONG_WAY, ZERO)]))
        self.driver.wait_moving()

    def expect_preempted_on_the_way(self):
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.PREEMPTED, result)
        self.assertNotEqual(result.error_string, '')

    def expect_standing_on_the_way(self):
        for position in self.driver.wait_standstill():
            self.assertLess(position, 1.9)

    def test_cancel(self):
        self.start_long_goal()
        self.driver.action.cancel()
        self.expect_preempted_on_the_way()
        # The result comes when the motion has ended, not before.
        for velocity in self.driver.state.next().actual.velocities:
            self.assertLess(abs(velocity), 0.1)
        self.expect_standing_on_the_way()

    def test_cancel_before_motion(self):
        self.driver.action.send(goal(JOINTS, [point(LONG_TIME, LONG_WAY, ZERO)]))
        self.driver.action.cancel()
        status, result = self.driver.action.ending()
        # Accepted by then, or still being planned.
        self.assertIn(status, (GoalStatus.PREEMPTED, GoalStatus.RECALLED), result)
        self.assertNotEqual(result.error_string, '')
        self.expect_standing_on_the_way()

    def test_goal_of_another_client_replaces(self):
        self.start_long_goal()
        second = self.driver.client()
        status, result = second.execute(goal(JOINTS, [point(3.0, [-0.2] * 6, ZERO)]))
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        self.expect_preempted_on_the_way()
        for position in self.driver.positions():
            self.assertAlmostEqual(position, -0.2, delta=0.01)

    def test_rejected_goal_leaves_the_running_one_alone(self):
        self.start_long_goal()
        second = self.driver.client()
        status, result = second.execute(goal(JOINTS, [point(1.0, [float('nan')] * 6)]))
        self.assertEqual(status, GoalStatus.REJECTED, result)
        self.assertTrue(self.driver.action.is_active())
        self.driver.wait_moving()
        self.driver.action.cancel()
        self.expect_preempted_on_the_way()

    def test_command_replaces_the_goal(self):
        self.start_long_goal()
        self.command.publish(trajectory(JOINTS, [point(3.0, [-0.2] * 6, ZERO)]))
        self.expect_preempted_on_the_way()
        self.driver.state.wait_for(lambda m: max(abs(p + 0.2) for p in m.actual.positions) < 0.01, 'the command done')

    def test_bad_command_leaves_the_goal_alone(self):
        self.start_long_goal()
        self.command.publish(trajectory(JOINTS, [point(3.0, [float('inf')] * 6)]))
        # A goal that is rejected after it shows that the command has been dealt with.
        status, _ = self.driver.client().execute(goal([], []))
        self.assertEqual(status, GoalStatus.REJECTED)
        self.assertTrue(self.driver.action.is_active())
        self.driver.action.cancel()
        self.expect_preempted_on_the_way()

    def test_empty_command_stops(self):
        self.start_long_goal()
        self.command.publish(JointTrajectory())
        self.expect_preempted_on_the_way()
        self.expect_standing_on_the_way()

    def test_empty_goal_stops_and_succeeds(self):
        self.start_long_goal()
        status, result = self.driver.client().execute(goal(JOINTS, []))
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        self.expect_preempted_on_the_way()
        self.expect_standing_on_the_way()

    def test_halt(self):
        self.start_long_goal()
        answer = self.driver.trigger('halt')
        self.assertTrue(answer.success, answer.message)
        status, result = self.driver.action.ending()
        self.assertIn(status, (GoalStatus.PREEMPTED, GoalStatus.ABORTED), result)
        self.assertNotEqual(result.error_string, '')
        self.expect_standing_on_the_way()

    def test_clear_buffers(self):
        self.start_long_goal()
        answer = self.driver.trigger('clear_buffers')
        self.assertTrue(answer.success, answer.message)
        self.driver.action.ending()
        self.driver.buffers.wait_for(lambda m: max(m.fill) == 0, 'empty buffers')
        self.expect_standing_on_the_way()

    def test_query_state(self):
        before = rospy.Time.now()
        query = self.driver.service('query_state', QueryTrajectoryState)
        self.driver.action.send(goal(JOINTS, [point(2.0, [0.4] * 6, ZERO)]))
        self.driver.wait_moving()
        now = query(rospy.Time.now())
        self.assertEqual(now.name, JOINTS)
        for position in now.position:
            self.assertTrue(-0.01 <= position <= 0.41, position)
        self.assertEqual(len(now.velocity), 6)
        self.assertEqual(len(now.acceleration), 6)
        end = query(rospy.Time.now() + rospy.Duration(3600))
        for position, velocity in zip(end.position, end.velocity):
            self.assertAlmostEqual(position, 0.4, delta=1e-3)
            self.assertAlmostEqual(velocity, 0.0, delta=1e-3)
        with self.assertRaises(rospy.ServiceException):
            query(before - rospy.Duration(3600))
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        self.assertEqual(result.error_code, Result.SUCCESSFUL)


if __name__ == '__main__':
    rospy.init_node('goal_endings')
    rostest.rosrun('interpolated_motion_driver', 'goal_endings', GoalEndings)
