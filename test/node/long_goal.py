#!/usr/bin/python3
"""A goal of many points is planned while everything else goes on."""
import math
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticArray
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import Driver, Latest, goal, point  # noqa: E402

JOINTS = ['joint%d' % i for i in range(1, 7)]
ZERO = [0.0] * 6
POINTS = 30000
STEP = 0.02  # s between two points


def long_goal(begin=0.0):
    """All joints along a slow sine from 0 to 0, `begin` seconds after the start."""
    turn = 2.0 * math.pi / (POINTS * STEP)
    points = []
    for i in range(1, POINTS + 1):
        angle = turn * STEP * i
        points.append(point(begin + STEP * i, [0.5 * (1.0 - math.cos(angle))] * 6, [0.5 * turn * math.sin(angle)] * 6))
    points[-1].velocities = ZERO
    return goal(JOINTS, points)


class LongGoal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver('/driver')
        cls.other = cls.driver.client()
        cls.halt = rospy.ServiceProxy('/driver/halt', Trigger)

    def setUp(self):
        self.driver.wait_standstill()
        if max(abs(p) for p in self.driver.positions()) > 1e-3:
            self.driver.go(JOINTS, ZERO, 2.0)

    def test_halt_counts_while_it_is_planned(self):
        self.driver.action.send(long_goal())
        self.driver.action.wait_known()
        self.assertTrue(self.halt().success)
        status, result = self.driver.action.ending()
        # Still being planned by then, or accepted.
        self.assertIn(status, (GoalStatus.REJECTED, GoalStatus.ABORTED), result)
        for position in self.driver.wait_standstill():
            self.assertAlmostEqual(position, 0.0, delta=0.01)

    def test_a_goal_under_way_goes_on(self):
        replacement = long_goal(begin=10.0)  # time for the way from wherever the joints are by then
        self.driver.action.send(goal(JOINTS, [point(60.0, [1.0] * 6, ZERO)]))
        self.driver.wait_moving()
        self.other.send(replacement)
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.PREEMPTED, result)
        self.assertIn('newer goal', result.error_string)
        self.other.cancel()
        status, result = self.other.ending()
        self.assertEqual(status, GoalStatus.PREEMPTED, result)

    def test_the_longest_turn_is_told(self):
        diagnostics = Latest('/diagnostics', DiagnosticArray)
        status = diagnostics.wait_for(lambda message: any('group' in s.name for s in message.status), 'the group').status
        values = [v for s in status for v in s.values if v.key == 'longest turn of the bus thread']
        self.assertEqual(len(values), 1)
        self.assertRegex(values[0].value, r'^[0-9.]+ ms$')
        print('longest turn of the bus thread: %s' % values[0].value)


if __name__ == '__main__':
    rospy.init_node('long_goal')
    rostest.rosrun('interpolated_motion_driver', 'long_goal', LongGoal)
