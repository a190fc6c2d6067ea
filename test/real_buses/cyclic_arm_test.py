"""Six cyclic drives of another program on vcan0, which follow one target position a SYNC: run by scripts/with_vcan."""
import math

import pytest
import real_arm
from actionlib_msgs.msg import GoalStatus
from goal_files import JOINTS, goal_from_file

OVERTEMPERATURE = 0x4210  # CiA 301 error code 42xxh: device temperature
COUNTS = 2000 * 100 / (2.0 * math.pi)  # per rad, of these drives
LATE = 5e-3  # s, by which SYNC is late on a loaded machine: as far as that a drive is behind its path, see docs/cyclic.md


def top_speed(trajectory, joint):
    return max(abs(one.velocities[joint]) for one in trajectory.points)


@pytest.mark.usefixtures('ros')
class CyclicArm(real_arm.RealArm):
    configuration_file = 'six_axis_cyclic_socketcan.yaml'
    node = 'cyclic_arm'

    @classmethod
    def adapt(cls, configuration):
        """Drives that ride through what a loaded machine leaves out."""
        for drive in configuration['drives'].values():
            drive['emulation']['ride_through'] = 100
        return super().adapt(configuration)

    def test_a_planner_goal_is_followed(self):
        planned = goal_from_file('six_axis_toppra_100ms_pva.yaml')
        status, result = self.driver.action.execute(planned)
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        report = self.driver.report()
        for i, name in enumerate(JOINTS):
            self.assertGreater(report.samples[i], 1000, name)
            self.assertLessEqual(report.worst_deviation[i], 5.0 + LATE * top_speed(planned.trajectory, i) * COUNTS, name)
            self.assertLessEqual(report.final_deviation[i], 1.0, name)

    def test_d_a_fault_is_reported_and_reset(self):
        self.expect_emergency('joint3', OVERTEMPERATURE)

    def test_e_a_silent_drive_stops_the_others_and_comes_back(self):
        self.expect_recovery(lambda: self.inject('joint2', 'silence 1'), lambda: self.inject('joint2', 'silence 0'), 'joint2')
