"""Three EPOS2 drives on vcan0 and three SilverLode drives on a pseudo-terminal, one group: run by scripts/with_vcan."""
import os
import subprocess

import pytest
import real_arm


def ip_link(*arguments):
    subprocess.run(['ip', 'link', *arguments], check=True)


@pytest.mark.usefixtures('ros')
class MixedArm(real_arm.RealArm):
    configuration_file = 'six_axis_mixed_real.yaml'
    node = 'mixed_arm'

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
