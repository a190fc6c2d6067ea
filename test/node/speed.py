#!/usr/bin/python3
"""Pause, resume and speed override by services and topics of the node."""
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from interpolated_motion_driver.srv import SetSpeedOverride
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import Driver, Latest, goal, point  # noqa: E402

JOINTS = ['joint%d' % i for i in range(1, 7)]
ZERO = [0.0] * 6


class Speed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver('/driver')
        cls.pause = rospy.ServiceProxy('/driver/pause', Trigger)
        cls.resume = rospy.ServiceProxy('/driver/resume', Trigger)
        cls.override = rospy.ServiceProxy('/driver/set_speed_override', SetSpeedOverride)
        cls.input = rospy.Publisher('/driver/speed_scaling_input', Float64, queue_size=1)
        cls.present = Latest('/driver/speed_scaling', Float64)

    def setUp(self):
        self.assertTrue(self.override(1.0).success)
        self.assertTrue(self.resume().success)
        self.driver.wait_standstill()
        self.driver.go(JOINTS, ZERO, 2.0)

    def test_paused_and_resumed(self):
        self.driver.action.send(goal(JOINTS, [point(6.0, [1.0] * 6, ZERO)]))
        self.driver.wait_moving()
        self.assertTrue(self.pause().success)
        self.present.wait_for(lambda message: message.data == 0.0, 'the arm to stand')
        stands = self.driver.wait_standstill()
        self.assertLess(max(stands), 0.9)
        self.assertTrue(self.driver.action.is_active())
        # On its way: all joints have gone as far.
        for position in stands:
            self.assertAlmostEqual(position, stands[0], delta=0.002)
        self.assertTrue(self.resume().success)
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)

    def test_override(self):
        for wrong in (-1.0, 2.1, float('nan')):
            answer = self.override(wrong)
            self.assertFalse(answer.success)
            self.assertIn('allowed is 0', answer.message)
        self.assertTrue(self.override(0.5).success)
        begin = rospy.Time.now()
        self.driver.go(JOINTS, [0.5] * 6, 1.5)
        self.assertGreater((rospy.Time.now() - begin).to_sec(), 2.9)

    def test_override_by_topic(self):
        self.driver.action.send(goal(JOINTS, [point(8.0, [1.0] * 6, ZERO)]))
        self.driver.wait_moving()
        self.input.publish(2.0)
        self.present.wait_for(lambda message: message.data == 2.0, 'the speed of 2')
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)


if __name__ == '__main__':
    rospy.init_node('speed')
    rostest.rosrun('interpolated_motion_driver', 'speed', Speed)
