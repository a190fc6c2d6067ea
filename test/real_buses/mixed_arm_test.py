"""Three EPOS2 drives on vcan0 and three SilverLode drives on a pseudo-terminal, one group. Not among the tests of scripts/test: in
user-mode Linux it is too near to what that can do, and failed there in some runs. By hand, within scripts/with_vcan:
python3 -m pytest test/real_buses/mixed_arm.py, with IMD_EMULATED_DRIVES set to the program."""
import os
import subprocess
import time
import unittest

import pytest
import real_arm

# Seconds. User-mode Linux takes 40e-6 for a system call on a machine that has nothing else to do.
SLOWEST_SYSTEM_CALL = 80e-6


def system_call_time():
    count = 5000
    begin = time.monotonic()
    for _ in range(count):
        os.getppid()
    return (time.monotonic() - begin) / count


def ip_link(*arguments):
    subprocess.run(['ip', 'link', *arguments], check=True)


@pytest.mark.usefixtures('ros')
class MixedArm(real_arm.RealArm):
    configuration_file = 'six_axis_mixed_real.yaml'
    node = 'mixed_arm'
    slower = 3.0

    @classmethod
    def setUpClass(cls):
        measured = system_call_time()
        if measured > SLOWEST_SYSTEM_CALL:
            raise unittest.SkipTest('a system call takes %.0f us here: driver and drives of both buses together would be too slow for '
                                    'their time-outs' % (1e6 * measured))
        super().setUpClass()

    @classmethod
    def adapt(cls, configuration):
        """In user-mode Linux everything that need not be done often is done less often, and a start has more time."""
        configuration = super().adapt(configuration)
        configuration['state_publish_rate'] = configuration['status_publish_rate'] = 10
        configuration['buses']['can0']['sync_period'] = 0.05
        configuration['buses']['line0'].update(turnaround=0.015, status_period=0.2, start_lead=2.0)
        return configuration

    def test_d_an_unplugged_serial_adapter_stops_the_drives_on_both_buses(self):
        line = os.path.join(self.folder, 'line0')
        before = self.drives.mark()
        self.expect_recovery(lambda: self.inject(line, 'unplug 3'), lambda: self.drives.wait_for('^ready.*line0', before), 'line0')

    def test_e_a_can_interface_that_is_removed_stops_the_drives_on_both_buses(self):
        self.expect_recovery(lambda: ip_link('del', 'vcan0'), self.plug_can_in, 'vcan0')

    def plug_can_in(self):
        before = self.drives.mark()
        ip_link('add', 'dev', 'vcan0', 'type', 'vcan')
        ip_link('set', 'dev', 'vcan0', 'up')
        self.drives.wait_for('^ready.*vcan0', before)
