#!/usr/bin/python3
"""One goal from a file moves all six joints, and everything that is published while it does."""
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import FollowJointTrajectoryResult
from sensor_msgs.msg import JointState

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import Driver, Latest  # noqa: E402
from goal_files import JOINTS, goal_from_file  # noqa: E402


class SingleGoal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver('/driver')
        cls.sent = goal_from_file('six_axis_toppra_100ms_pva.yaml')
        cls.feedback = []
        cls.joint_states = Latest('/joint_states', JointState)
        cls.driver.action.send(cls.sent, feedback=cls.feedback.append)
        cls.moving_state = cls.driver.wait_moving()
        cls.moving_buffers = cls.driver.buffers.wait_for(lambda m: min(m.fill) > 1, 'filled buffers')
        cls.moving_drives = cls.driver.drives.next()
        cls.status, cls.result = cls.driver.action.ending()

    def test_succeeds(self):
        self.assertEqual(self.status, GoalStatus.SUCCEEDED, self.result)
        self.assertEqual(self.result.error_code, FollowJointTrajectoryResult.SUCCESSFUL)

    def test_joints_stand_at_the_last_point(self):
        wanted = self.sent.trajectory.points[-1].positions
        message = self.joint_states.next()
        self.assertEqual(message.name, JOINTS)
        for name, actual, expected in zip(JOINTS, message.position, wanted):
            self.assertAlmostEqual(actual, expected, delta=0.01, msg=name)
        self.assertEqual(len(message.velocity), 6)
        self.assertEqual(list(message.effort), [])

    def test_every_drive_followed_the_polynomial_within_a_count(self):
        report = self.driver.report()
        self.assertTrue(report.valid)
        self.assertEqual(report.name, JOINTS)
        for i, name in enumerate(JOINTS):
            self.assertGreater(report.samples[i], 6000, name)
            self.assertLessEqual(report.worst_deviation[i], 1.0, name)
            self.assertLessEqual(report.final_deviation[i], 1.0, name)
            self.assertEqual(report.underruns[i], 0, name)
            self.assertGreater(report.records_sent[i], 10, name)
            self.assertGreaterEqual(report.minimum_fill[i], 2, name)
        self.assertEqual(report.bus_name, ['can0'])
        self.assertTrue(0.0 < report.peak_bus_load[0] < 0.6, report.peak_bus_load)

    def test_state_has_the_fields_of_joint_trajectory_controller(self):
        message = self.moving_state
        self.assertEqual(message.joint_names, JOINTS)
        self.assertEqual(message.header.frame_id, '')
        for values in (message.desired.positions, message.desired.velocities, message.desired.accelerations,
                       message.actual.positions, message.actual.velocities, message.error.positions,
                       message.error.velocities):
            self.assertEqual(len(values), 6)
        self.assertEqual(list(message.actual.accelerations), [])
        self.assertEqual(list(message.error.accelerations), [])
        self.assertGreater(message.desired.time_from_start, rospy.Duration(0))
        for desired, actual, error in zip(message.desired.positions, message.actual.positions,
                                          message.error.positions):
            self.assertAlmostEqual(error, desired - actual, delta=1e-9)

    def test_feedback_runs_with_the_goal(self):
        times = [f.desired.time_from_start.to_sec() for f in self.feedback]
        self.assertGreater(len(times), 30)
        self.assertEqual(times, sorted(times))
        self.assertGreater(times[-1], 5.0)
        self.assertEqual(self.feedback[0].joint_names, JOINTS)
        self.assertEqual(list(self.feedback[0].actual.accelerations), [])

    def test_buffer_status_tells_the_fill(self):
        message = self.moving_buffers
        self.assertEqual(message.name, JOINTS)
        self.assertEqual(message.bus, ['can0'] * 6)
        self.assertEqual(list(message.capacity), [64] * 6)
        self.assertGreater(min(message.fill_time), 0.05)
        self.assertEqual(list(message.underruns), [0] * 6)
        self.assertEqual(list(message.refused_writes), [0] * 6)

    def test_drive_states_tell_the_mode(self):
        message = self.moving_drives
        self.assertEqual(message.name, JOINTS)
        self.assertEqual(list(message.mode), [7] * 6)
        self.assertEqual([s.lower() for s in message.state], ['operation enabled'] * 6)
        self.assertTrue(all(message.online))
        for word in message.statusword:
            self.assertEqual(word & 0x6F, 0x27)  # CiA 402: operation enabled
        for demand, actual, error in zip(message.demand_position, message.actual_position, message.following_error):
            self.assertLess(abs(error), 0.05)
            self.assertAlmostEqual(demand, actual, delta=0.5)  # up to 3.2 rad/s


if __name__ == '__main__':
    rospy.init_node('single_goal')
    rostest.rosrun('interpolated_motion_driver', 'single_goal', SingleGoal)
