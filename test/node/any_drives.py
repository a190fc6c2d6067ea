#!/usr/bin/python3
"""What a user does with an arm, whatever its drives: a planner's goal, a cancel, a fault, and on again."""
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import Driver, goal, point  # noqa: E402
from goal_files import JOINTS, goal_from_file  # noqa: E402

# Counts, as the configurations bound the deviation of the demand: EPOS2 1, SilverLode 2. At rest none may be off by more than one.
BOUNDS = {'can': 1.0, 'line': 2.0}


def bound(bus):
    return next(value for kind, value in BOUNDS.items() if bus.startswith(kind))


class AnyDrives(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver('/driver')

    def inject(self, joint, command):
        answer = self.driver.inject(joint, command)
        self.assertTrue(answer.success, answer.message)

    def test_a_planner_goal_is_followed(self):
        status, result = self.driver.action.execute(goal_from_file('six_axis_toppra_100ms_pva.yaml'))
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        report = self.driver.report()
        for i, name in enumerate(JOINTS):
            self.assertGreater(report.samples[i], 1000, name)
            self.assertLessEqual(report.worst_deviation[i], bound(report.bus[i]), name)
            self.assertLessEqual(report.final_deviation[i], 1.0, name)
            self.assertEqual(report.underruns[i], 0, name)

    def test_b_cancel_brings_to_rest(self):
        self.driver.action.send(goal(JOINTS, [point(20.0, [0.5] * 6, [0.0] * 6)]))
        self.driver.wait_moving()
        self.driver.action.cancel()
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.PREEMPTED, result)
        rest = self.driver.wait_standstill()
        for _ in range(20):
            for before, now in zip(rest, self.driver.positions()):
                self.assertAlmostEqual(before, now, delta=1e-3)

    def test_c_a_fault_stops_all_and_nothing_moves_without_a_new_goal(self):
        self.driver.action.send(goal(JOINTS, [point(20.0, [-0.5] * 6, [0.0] * 6)]))
        self.driver.wait_moving()
        self.inject('joint5', 'power_cycle 0.2')
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.ABORTED, result)
        self.assertIn('joint5', result.error_string)
        others = [i for i, name in enumerate(JOINTS) if name != 'joint5']
        self.driver.wait_standstill(joints=others)
        rospy.sleep(2.0)
        answer = self.driver.trigger('reset_faults')
        self.assertTrue(answer.success, answer.message)
        answer = self.driver.enable(True)
        self.assertTrue(answer.success, answer.message)
        rest = self.driver.positions()
        for _ in range(20):
            for before, now in zip(rest, self.driver.positions()):
                self.assertAlmostEqual(before, now, delta=1e-3)
        self.driver.go(JOINTS, [position + 0.1 for position in rest], 1.0)


if __name__ == '__main__':
    rospy.init_node('any_drives')
    rostest.rosrun('interpolated_motion_driver', 'any_drives', AnyDrives)
