#!/usr/bin/python3
"""What the node takes of the machine with six joints, their emulated drives included: processor time at rest and in motion, memory,
and no growth from goal to goal. Run with GOALS=1000 in the environment for the long one."""
import os
import sys
import time
import unittest
import xmlrpc.client

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import Driver, goal, point  # noqa: E402
from goal_files import JOINTS, goal_from_file  # noqa: E402

GOALS = int(os.environ.get('GOALS', '30'))


def process_id(node):
    _, _, uri = xmlrpc.client.ServerProxy(os.environ['ROS_MASTER_URI']).lookupNode('/resources', node)
    return xmlrpc.client.ServerProxy(uri).getPid('/resources')[2]


class Resources(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = Driver('/driver')
        cls.pid = process_id('/driver')

    def cpu_seconds(self):
        with open('/proc/%d/stat' % self.pid) as file:
            fields = file.read().rsplit(')', 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')

    def resident_mib(self):
        with open('/proc/%d/statm' % self.pid) as file:
            return int(file.read().split()[1]) * os.sysconf('SC_PAGE_SIZE') / 2.0 ** 20

    def share_of_a_core(self, act):
        cpu, wall = self.cpu_seconds(), time.monotonic()
        act()
        return (self.cpu_seconds() - cpu) / (time.monotonic() - wall)

    def test_at_rest(self):
        share = self.share_of_a_core(lambda: time.sleep(10.0))
        print('at rest: %.1f %% of a core, %.1f MiB' % (100 * share, self.resident_mib()))
        self.assertLess(share, 0.05)
        self.assertLess(self.resident_mib(), 64)

    def test_in_motion(self):
        def move():
            status, result = self.driver.action.execute(goal_from_file('six_axis_toppra_100ms_pva.yaml'))
            self.assertEqual(status, GoalStatus.SUCCEEDED, result)

        share = self.share_of_a_core(move)
        print('in motion: %.1f %% of a core, %.1f MiB' % (100 * share, self.resident_mib()))
        self.assertLess(share, 0.15)
        self.assertLess(self.resident_mib(), 64)

    def test_many_goals(self):
        start = self.driver.positions()
        after = []
        for i in range(GOALS):
            target = [p + (0.01 if i % 2 == 0 else 0.0) for p in start]
            status, result = self.driver.action.execute(goal(JOINTS, [point(0.1, target, [0.0] * 6)]))
            self.assertEqual(status, GoalStatus.SUCCEEDED, result)
            after.append(self.resident_mib())
        print('%d goals: %.2f MiB after a third of them, %.2f MiB after all' % (GOALS, after[GOALS // 3], after[-1]))
        self.assertLess(after[-1], after[GOALS // 3] + 2.0)
        self.assertLess(after[-1], 64)


if __name__ == '__main__':
    rospy.init_node('resources')
    rostest.rosrun('interpolated_motion_driver', 'resources', Resources)
