#!/usr/bin/python3
"""Every kind of goal that must not be driven is rejected with code and text, and nothing moves."""
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

JOINTS = ['joint%d' % i for i in range(1, 7)]
ZERO = [0.0] * 6
THERE = [0.1] * 6

SIZE_MISMATCH = 'Size mismatch in trajectory point position, velocity or acceleration data.'
NOT_INCREASING = 'Trajectory message contains waypoints that are not strictly increasing in time.'


def with_third(values, value):
    """A copy in which the third joint has another value."""
    changed = list(values)
    changed[2] = value
    return changed


class BadGoals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver('/driver')

    def setUp(self):
        self.before = self.driver.positions()
        self.sent_before = self.driver.records_sent()

    def expect_rejected(self, bad, code, *texts):
        status, result = self.driver.action.execute(bad)
        self.assertEqual(status, GoalStatus.REJECTED, result)
        self.assertEqual(result.error_code, code, result)
        for text in texts:
            self.assertIn(text, result.error_string)
        self.expect_nothing_moved()

    def expect_nothing_moved(self):
        self.assertEqual(self.driver.records_sent(), self.sent_before)
        for before, after in zip(self.before, self.driver.positions()):
            self.assertAlmostEqual(before, after, delta=1e-3)

    # Numbers

    def test_nan_position(self):
        self.expect_rejected(goal(JOINTS, [point(1, with_third(THERE, float('nan')))]), Result.INVALID_GOAL, 'joint3', 'nan')

    def test_infinite_velocity(self):
        self.expect_rejected(goal(JOINTS, [point(1, THERE, with_third(ZERO, float('inf')))]), Result.INVALID_GOAL,
                             'joint3', 'inf')

    def test_nan_acceleration(self):
        self.expect_rejected(goal(JOINTS, [point(1, THERE, ZERO, with_third(ZERO, float('nan')))]), Result.INVALID_GOAL,
                             'joint3', 'nan')

    # Joints

    def test_no_joint_names(self):
        self.expect_rejected(goal([], []), Result.INVALID_JOINTS)

    def test_unknown_joint(self):
        self.expect_rejected(goal(JOINTS[:5] + ['elbow'], [point(1, THERE)]), Result.INVALID_JOINTS, 'elbow')

    def test_duplicate_joint(self):
        self.expect_rejected(goal(JOINTS[:5] + ['joint1'], [point(1, THERE)]), Result.INVALID_JOINTS, 'joint1')

    def test_missing_joint(self):
        self.expect_rejected(goal(JOINTS[:5], [point(1, THERE[:5])]), Result.INVALID_JOINTS, 'joint6')

    def test_tolerance_for_an_unknown_joint(self):
        bad = goal(JOINTS, [point(1, THERE)])
        bad.goal_tolerance = [JointTolerance(name='elbow', position=0.1)]
        self.expect_rejected(bad, Result.INVALID_JOINTS, 'elbow')

    # Shapes

    def test_positions_too_short(self):
        self.expect_rejected(goal(JOINTS, [point(1, THERE[:5])]), Result.INVALID_GOAL, SIZE_MISMATCH)

    def test_velocities_too_long(self):
        self.expect_rejected(goal(JOINTS, [point(1, THERE, ZERO + [0.0])]), Result.INVALID_GOAL, SIZE_MISMATCH)

    def test_accelerations_too_short(self):
        self.expect_rejected(goal(JOINTS, [point(1, THERE, ZERO, ZERO[:2])]), Result.INVALID_GOAL, SIZE_MISMATCH)

    def test_no_positions(self):
        self.expect_rejected(goal(JOINTS, [point(1, [], ZERO)]), Result.INVALID_GOAL, SIZE_MISMATCH)

    # Times

    def test_times_equal(self):
        self.expect_rejected(goal(JOINTS, [point(1, THERE), point(1, THERE)]), Result.INVALID_GOAL, NOT_INCREASING)

    def test_times_decreasing(self):
        self.expect_rejected(goal(JOINTS, [point(2, THERE), point(1, ZERO)]), Result.INVALID_GOAL, NOT_INCREASING)

    def test_negative_time(self):
        self.expect_rejected(goal(JOINTS, [point(-1, ZERO), point(1, THERE)]), Result.INVALID_GOAL)

    def test_all_points_in_the_past(self):
        long_ago = rospy.Time.now() - rospy.Duration(100)
        self.expect_rejected(goal(JOINTS, [point(1, THERE), point(2, ZERO)], long_ago), Result.INVALID_GOAL,
                             'Dropping all 2 trajectory point(s), as they occur before the current time.')

    # Limits

    def test_start_too_far(self):
        far = with_third(ZERO, 0.5)
        self.expect_rejected(goal(JOINTS, [point(0, far), point(2, far)]), Result.INVALID_GOAL, 'joint3', '0.05')

    def test_position_limit(self):
        self.expect_rejected(goal(JOINTS, [point(10, with_third(ZERO, 3.2), ZERO)]), Result.INVALID_GOAL, 'joint3', '3.1')

    def test_position_limit_between_points(self):
        # The cubic from 3.0 rad at 2 rad/s back to rest at 3.0 rad rises to 3.3 rad in between.
        bad = goal(JOINTS, [point(4, with_third(ZERO, 3.0), with_third(ZERO, 2.0)), point(5, with_third(ZERO, 3.0), ZERO)])
        self.expect_rejected(bad, Result.INVALID_GOAL, 'joint3', '3.1')

    def test_velocity_limit_between_points(self):
        # Rest to rest over 2 rad in 0.8 s has its peak of 1.5 * 2 / 0.8 = 3.75 rad/s in the middle.
        self.expect_rejected(goal(JOINTS, [point(0.8, with_third(ZERO, 2.0), ZERO)]), Result.INVALID_GOAL, 'joint3', '3.5')

    def test_fifty_radians_in_half_a_second(self):
        self.expect_rejected(goal(JOINTS, [point(0.5, with_third(ZERO, 50.0))]), Result.INVALID_GOAL, 'joint3')

    def test_acceleration_limit(self):
        # Rest to rest over 0.2 rad in 0.2 s: 6 * 0.2 / 0.2^2 = 30 rad/s^2 at both ends, at 1.5 rad/s in the middle.
        self.expect_rejected(goal(JOINTS, [point(0.2, with_third(ZERO, 0.2), ZERO)]), Result.INVALID_GOAL, 'joint3', '20')

    # State of the drives

    def test_disabled(self):
        self.assertTrue(self.driver.enable(False).success)
        try:
            self.expect_rejected(goal(JOINTS, [point(1, THERE, ZERO)]), Result.INVALID_GOAL, 'enable')
        finally:
            self.assertTrue(self.driver.enable(True).success)

    # Topic

    def test_bad_command_is_ignored(self):
        import trajectory_msgs.msg
        publisher = rospy.Publisher('/driver/command', trajectory_msgs.msg.JointTrajectory, queue_size=1, latch=True)
        publisher.publish(goal(JOINTS, [point(1, with_third(THERE, float('nan')))]).trajectory)
        # Latched, so it arrives; the goal after it is handled by the same thread of the driver.
        while publisher.get_num_connections() == 0:
            rospy.rostime.wallsleep(0.01)
        self.expect_rejected(goal([], []), Result.INVALID_JOINTS)

    def test_zz_a_good_goal_is_still_taken(self):
        # unittest runs tests in the order of their names: this one is the last.
        self.driver.go(JOINTS, THERE, 1.0)


if __name__ == '__main__':
    rospy.init_node('bad_goals')
    rostest.rosrun('interpolated_motion_driver', 'bad_goals', BadGoals)
