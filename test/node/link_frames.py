#!/usr/bin/python3
"""With publish_tf a client of tf2 finds every link where the joints are, and where the trajectory has them."""
import os
import sys
import unittest

import rospy
import rostest
import tf2_ros

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import PATIENCE, Driver  # noqa: E402
from goal_files import JOINTS  # noqa: E402

# m: the sum of the heights of config/urdf/six_axis.urdf from the base to link6, whose joints all have z or y as axis.
REACH = 0.1 + 0.25 + 0.45 + 0.20 + 0.25 + 0.12


class LinkFrames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)
        cls.driver = Driver('/driver')

    def origin(self, link, stamp):
        """Of the link in the base, at a time."""
        transform = self.buffer.lookup_transform('base_link', link, stamp, rospy.Duration(PATIENCE)).transform
        return transform.translation

    def expect_at(self, link, stamp, x, z):
        origin = self.origin(link, stamp)
        self.assertAlmostEqual(origin.x, x, delta=1e-3)
        self.assertAlmostEqual(origin.y, 0.0, delta=1e-3)
        self.assertAlmostEqual(origin.z, z, delta=1e-3)

    def test_links_are_where_the_joints_are(self):
        self.driver.go(JOINTS, [0.0] * 6, 1.0)
        for link in ('link6', 'demand/link6'):
            self.expect_at(link, self.driver.state.next().header.stamp, 0.0, REACH)
        # joint2 is at the shoulder, 0.35 m up: a quarter of a turn lays the rest of the arm down along x.
        self.driver.go(JOINTS, [0.0, 1.5707963, 0.0, 0.0, 0.0, 0.0], 2.0)
        for link in ('link6', 'demand/link6'):
            self.expect_at(link, self.driver.state.next().header.stamp, REACH - 0.35, 0.35)


if __name__ == '__main__':
    rospy.init_node('link_frames')
    rostest.rosrun('interpolated_motion_driver', 'link_frames', LinkFrames)
