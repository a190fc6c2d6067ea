#!/usr/bin/python3
"""Six SilverLode drives of another program on pseudo-terminals."""
import os
import sys

import rospy
import rostest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'real_buses'))
import real_arm  # noqa: E402


class SerialArm(real_arm.RealArm):
    configuration_file = 'six_axis_silverlode_serial.yaml'
    node = 'driver'

    def test_d_an_unplugged_adapter_comes_back(self):
        line = os.path.join(self.folder, 'line0')
        before = self.drives.mark()
        self.expect_recovery(lambda: self.inject(line, 'unplug 3'), lambda: self.drives.wait_for('^ready', before), 'line0')


if __name__ == '__main__':
    rospy.init_node('serial_arm')
    rostest.rosrun('interpolated_motion_driver', 'serial_arm', SerialArm)
