#!/usr/bin/python3
"""Under the name of a joint_trajectory_controller the driver has its names, types, rates, codes and texts."""
import math
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import FollowJointTrajectoryResult as Result
from control_msgs.msg import JointTolerance

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import Driver, goal, point  # noqa: E402

NODE = '/rrbot_controller'
JOINTS = ['joint1', 'joint2']
ZERO = [0.0, 0.0]


class RRBot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver(NODE)

    def test_topics(self):
        topics = dict(rospy.get_published_topics(NODE))
        action = NODE + '/follow_joint_trajectory'
        for name, expected in ((NODE + '/state', 'control_msgs/JointTrajectoryControllerState'),
                               (action + '/result', 'control_msgs/FollowJointTrajectoryActionResult'),
                               (action + '/feedback', 'control_msgs/FollowJointTrajectoryActionFeedback'),
                               (action + '/status', 'actionlib_msgs/GoalStatusArray')):
            self.assertEqual(topics.get(name), expected, name)

    def test_state_comes_at_its_rate(self):
        first = self.driver.state.next()
        count = self.driver.state.count
        last = self.driver.state.wait_for(lambda m: (m.header.stamp - first.header.stamp).to_sec() > 2.0, '2 s of states')
        rate = (self.driver.state.count - count) / (last.header.stamp - first.header.stamp).to_sec()
        self.assertGreater(rate, 85.0)
        self.assertLess(rate, 110.0)

    def test_several_points(self):
        status, result = self.driver.action.execute(goal(JOINTS, [
            point(0.0, ZERO), point(1.0, [math.pi / 4, 0.0]), point(2.0, [0.0, -math.pi / 4]), point(3.0, ZERO)]))
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        self.assertEqual(result.error_code, Result.SUCCESSFUL)
        for position in self.driver.positions():
            self.assertAlmostEqual(position, 0.0, delta=0.01)

    def test_joints_in_another_order(self):
        status, result = self.driver.action.execute(goal(['joint2', 'joint1'], [point(1.5, [0.3, -0.3], ZERO)]))
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        actual = self.driver.positions()
        self.assertAlmostEqual(actual[0], -0.3, delta=0.01)
        self.assertAlmostEqual(actual[1], 0.3, delta=0.01)
        self.driver.go(JOINTS, ZERO, 1.5)

    def test_stamp_in_the_future(self):
        self.driver.go(JOINTS, ZERO, 1.0)
        start = rospy.Time.now() + rospy.Duration(1.0)
        self.driver.action.send(goal(JOINTS, [point(1.0, [0.3, 0.3], ZERO)], start))
        moving = self.driver.wait_moving()
        self.assertGreater(moving.header.stamp, start)
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        self.driver.go(JOINTS, ZERO, 1.0)

    def expect_rejected(self, bad, code, text):
        status, result = self.driver.action.execute(bad)
        self.assertEqual(status, GoalStatus.REJECTED, result)
        self.assertEqual(result.error_code, code, result)
        self.assertIn(text, result.error_string)

    def test_rejections(self):
        there = [0.1, 0.1]
        self.expect_rejected(goal(['bad', 'joint2'], [point(1, there)]), Result.INVALID_JOINTS, 'bad')
        self.expect_rejected(goal(['joint1'], [point(1, [0.1])]), Result.INVALID_JOINTS, 'joint2')
        self.expect_rejected(goal([], []), Result.INVALID_JOINTS, '')
        self.expect_rejected(goal(JOINTS, [point(2, there), point(1, there)]), Result.INVALID_GOAL,
                             'Trajectory message contains waypoints that are not strictly increasing in time.')
        self.expect_rejected(goal(JOINTS, [point(1, there, [0.0])]), Result.INVALID_GOAL,
                             'Size mismatch in trajectory point position, velocity or acceleration data.')

    def test_path_tolerance_aborts_and_stops(self):
        """joint_trajectory_controller lets the motion go on."""
        tight = goal(JOINTS, [point(2.0, [1.5, 1.5], ZERO)])
        tight.path_tolerance = [JointTolerance(name='joint1', position=1e-7)]
        status, result = self.driver.action.execute(tight)
        self.assertEqual(status, GoalStatus.ABORTED, result)
        self.assertEqual(result.error_code, Result.PATH_TOLERANCE_VIOLATED)
        self.assertIn('joint1 path error', result.error_string)
        self.assertLess(self.driver.wait_standstill()[0], 1.4)
        self.driver.go(JOINTS, ZERO, 2.0)


if __name__ == '__main__':
    rospy.init_node('rrbot_client')
    rostest.rosrun('interpolated_motion_driver', 'rrbot', RRBot)
