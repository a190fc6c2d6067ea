#!/usr/bin/python3
"""A stream of setpoints as a bad network delivers it, over ~setpoints: 50 a second, a fifth of them lost, late by up to 10 ms."""
import math
import os
import random
import sys
import threading
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import Driver, goal, point  # noqa: E402
from goal_files import JOINTS  # noqa: E402

PERIOD = 0.02
AMPLITUDE = 0.2
HELD = 25  # setpoints at the end, all of one position: the rest is known whichever of them come too late
REST = 1e-3


def sine(seconds):
    return AMPLITUDE * (1.0 - math.cos(2.0 * math.pi * seconds))


class Setpoints(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver('/driver')
        cls.publisher = rospy.Publisher('/driver/setpoints', JointTrajectory, queue_size=50)

    def send(self, stamp, positions):
        message = JointTrajectory(joint_names=list(JOINTS), points=[JointTrajectoryPoint(positions=list(positions))])
        message.header.stamp = stamp
        self.publisher.publish(message)

    def stream(self, seconds, rest):
        """The setpoints of `seconds`, and the last position held. Returns that."""
        chance = random.Random(4)
        begin = rospy.Time.now()
        last = int(seconds / PERIOD)
        for k in range(last + HELD):
            lost = chance.random() < 0.2
            due = begin + rospy.Duration(k * PERIOD + chance.random() * PERIOD / 2)
            rospy.sleep(due - rospy.Time.now())
            end = [p + sine(min(k, last) * PERIOD) for p in rest]
            if not lost:
                self.send(begin + rospy.Duration(k * PERIOD), end)
        return end

    def wait_rest_at(self, goal_positions):
        self.driver.wait_standstill()
        for name, expected, actual in zip(JOINTS, goal_positions, self.driver.positions()):
            self.assertAlmostEqual(expected, actual, delta=REST, msg=name)

    def test_a_stream_is_followed_and_ends_at_rest(self):
        rest = self.driver.positions()
        end = self.stream(3.0, rest)
        self.wait_rest_at(end)
        report = self.driver.report()
        for i, name in enumerate(JOINTS):
            self.assertGreater(report.samples[i], 1000, name)
            self.assertEqual(report.underruns[i], 0, name)

    def test_b_a_goal_takes_over_from_a_stream(self):
        threading.Timer(1.3, self.driver.action.send, [goal(JOINTS, [point(2.0, [0.1] * 6)])]).start()
        self.stream(2.0, self.driver.positions())
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        self.wait_rest_at([0.1] * 6)

    def test_c_a_jump_is_refused(self):
        rest = self.driver.positions()
        self.send(rospy.Time.now(), [p + 2.0 for p in rest])
        rospy.sleep(1.0)
        for before, now in zip(rest, self.driver.positions()):
            self.assertAlmostEqual(before, now, delta=1e-3)


if __name__ == '__main__':
    rospy.init_node('setpoints')
    rostest.rosrun('interpolated_motion_driver', 'setpoints', Setpoints)
