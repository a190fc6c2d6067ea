"""Six cyclic drives of another program on vcan0, which follow one target position a SYNC: run by scripts/with_vcan."""
import math

import pytest
import real_arm
from actionlib_msgs.msg import GoalStatus
from goal_files import JOINTS, goal_from_file

OVERTEMPERATURE = 0x4210  # CiA 301 error code 42xxh: device temperature
COUNTS = 2000 * 100 / (2.0 * math.pi)  # per rad, of these drives
# While the host is kept from sending, a drive goes on as it went: on a loaded machine a slow goal leads less astray.
SLOWER = 3
# rad: half a second of that, and an arm that has arrived
PATH_TOLERANCE = 0.2
GOAL_TOLERANCE = 0.01


def slowed(planned):
    """The same path, in so many times the time."""
    for one in planned.trajectory.points:
        one.time_from_start *= SLOWER
        one.velocities = [velocity / SLOWER for velocity in one.velocities]
        one.accelerations = [acceleration / SLOWER ** 2 for acceleration in one.accelerations]
    return planned


@pytest.mark.usefixtures('ros')
class CyclicArm(real_arm.RealArm):
    configuration_file = 'six_axis_cyclic_socketcan.yaml'
    node = 'cyclic_arm'

    @classmethod
    def adapt(cls, configuration):
        """Drives that ride through what a loaded machine leaves out, and that go straight on meanwhile: a cubic of rounded targets leads
        far astray in so long a time."""
        for drive in configuration['drives'].values():
            drive['interpolation_order'] = 1
            drive['emulation']['ride_through'] = 50
        for name in JOINTS:
            configuration['constraints'][name] = {'trajectory': PATH_TOLERANCE, 'goal': GOAL_TOLERANCE}
        return super().adapt(configuration)

    def test_a_planner_goal_is_followed(self):
        """Within the tolerances: how near, if SYNC is in time, is the matter of the tests in virtual time."""
        status, result = self.driver.action.execute(slowed(goal_from_file('six_axis_toppra_100ms_pva.yaml')))
        self.assertEqual(status, GoalStatus.SUCCEEDED, result)
        report = self.driver.report()
        for i, name in enumerate(JOINTS):
            self.assertGreater(report.samples[i], 1000, name)
            self.assertLessEqual(report.worst_deviation[i], PATH_TOLERANCE * COUNTS, name)
            self.assertLessEqual(report.final_deviation[i], GOAL_TOLERANCE * COUNTS, name)

    def test_d_a_fault_is_reported_and_reset(self):
        self.expect_emergency('joint3', OVERTEMPERATURE)

    def test_e_a_silent_drive_stops_the_others_and_comes_back(self):
        self.expect_recovery(lambda: self.inject('joint2', 'silence 1'), lambda: self.inject('joint2', 'silence 0'), 'joint2')
