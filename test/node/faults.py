#!/usr/bin/python3
"""A fault of one drive stops all of them and ends the goal; after reset and enable everything works again."""
import os
import sys
import time
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import FollowJointTrajectoryResult as Result

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import PATIENCE, Driver, goal, point  # noqa: E402

JOINTS = ['joint%d' % i for i in range(1, 7)]
ZERO = [0.0] * 6
OVERTEMPERATURE = 0x4210  # CiA 301 error code 42xxh: device temperature


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver('/driver')

    def start_long_goal(self):
        self.driver.action.send(goal(JOINTS, [point(10.0, [2.0] * 6, ZERO)]))
        self.driver.wait_moving()

    def expect_aborted(self, *texts):
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.ABORTED, result)
        self.assertEqual(result.error_code, Result.INVALID_GOAL)
        for text in texts:
            self.assertIn(text, result.error_string)

    def expect_rejected(self):
        status, result = self.driver.action.execute(goal(JOINTS, [point(2.0, ZERO, ZERO)]))
        self.assertEqual(status, GoalStatus.REJECTED, result)
        self.assertEqual(result.error_code, Result.INVALID_GOAL)
        return result.error_string

    def expect_same(self, before, joints):
        now = self.driver.positions()
        for i in joints:
            self.assertAlmostEqual(before[i], now[i], delta=2e-3, msg=JOINTS[i])

    def recover_without_motion(self, before):
        answer = self.driver.trigger('reset_faults')
        self.assertTrue(answer.success, answer.message)
        self.expect_same(before, range(6))
        answer = self.driver.enable(True)
        self.assertTrue(answer.success, answer.message)
        self.expect_same(before, range(6))

    def test_recordings(self):
        """~dump_recording answers with a file; a fault makes another one by itself, and none is written over."""
        answer = self.driver.trigger('dump_recording')
        self.assertTrue(answer.success, answer.message)
        with open(answer.message) as file:
            first = file.read()
        self.assertIn('version: 1', first)
        self.assertIn(' wire can0 > ', first)
        number = int(answer.message[-10:-4])
        of_the_fault = '%s%06d.txt' % (answer.message[:-10], number + 1)
        self.assertFalse(os.path.exists(of_the_fault))
        self.start_long_goal()
        self.driver.inject('joint3', 'emcy 0x%04X' % OVERTEMPERATURE)
        self.expect_aborted('joint3')
        standing = self.driver.wait_standstill()
        deadline = time.monotonic() + PATIENCE
        while not os.path.exists(of_the_fault) and time.monotonic() < deadline:
            time.sleep(0.05)
        time.sleep(1.0)
        with open(of_the_fault) as file:
            text = file.read()
        self.assertIn('cause: "fault: ', text)
        self.assertIn(' -> fault: ', text)
        self.assertIn(' order goal {', text)
        self.assertIn('"emcy 0x%04X"' % OVERTEMPERATURE, text)
        with open(answer.message) as file:
            self.assertEqual(file.read(), first)
        self.recover_without_motion(standing)
        self.driver.go(JOINTS, ZERO, 3.0)

    def test_emergency(self):
        self.start_long_goal()
        answer = self.driver.inject('joint3', 'emcy 0x%04X' % OVERTEMPERATURE)
        self.assertTrue(answer.success, answer.message)
        self.expect_aborted('joint3', '%04X' % OVERTEMPERATURE)
        standing = self.driver.wait_standstill()
        for position in standing:
            self.assertLess(position, 1.9)
        drives = self.driver.drives.wait_for(lambda m: m.error_code[2] == OVERTEMPERATURE, 'the error code')
        self.assertNotEqual(drives.error_text[2], '')
        self.assertEqual([drives.error_code[i] for i in (0, 1, 3, 4, 5)], [0] * 5)
        self.assertIn('joint3', self.expect_rejected())
        self.recover_without_motion(standing)
        self.driver.go(JOINTS, ZERO, 3.0)

    def test_power_cycle(self):
        self.start_long_goal()
        answer = self.driver.inject('joint2', 'power_cycle 1')
        self.assertTrue(answer.success, answer.message)
        self.expect_aborted('joint2')
        # Nothing is known of joint2 while it is off.
        others = [0, 2, 3, 4, 5]
        standing = self.driver.wait_standstill(others)
        self.expect_rejected()
        deadline = time.monotonic() + PATIENCE
        while not self.driver.trigger('reset_faults').success:  # until it has power again
            self.assertLess(time.monotonic(), deadline)
            rospy.rostime.wallsleep(0.1)
        self.expect_same(standing, others)
        self.assertTrue(self.driver.drives.next().online[1])
        self.recover_without_motion(self.driver.positions())
        self.driver.go(JOINTS, ZERO, 3.0)

    def test_unknown_fault_or_joint(self):
        self.assertFalse(self.driver.inject('elbow', 'stall 1').success)
        answer = self.driver.inject('joint1', 'explode')
        self.assertFalse(answer.success)
        self.assertNotEqual(answer.message, '')


if __name__ == '__main__':
    rospy.init_node('faults')
    rostest.rosrun('interpolated_motion_driver', 'faults', Faults)
