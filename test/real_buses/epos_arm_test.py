"""Six EPOS2 drives of another program on vcan0, and programs that nobody here wrote as witnesses: run by scripts/with_vcan."""
import os
import re
import subprocess
import time

import pytest
import real_arm
from can_log import Candump, frames, tshark, wait_for_socket
from diagnostic_msgs.msg import DiagnosticArray
from driver_client import PATIENCE, Latest
from goal_files import JOINTS

FLOOD = 20000
FLOOD_ID = '781'  # node 1, so it passes the driver's filters, and below everything of CANopen
OVERTEMPERATURE = 0x4210  # CiA 301 error code 42xxh: device temperature


@pytest.mark.usefixtures('ros')
class EposArm(real_arm.RealArm):
    configuration_file = 'six_axis_epos_socketcan.yaml'
    node = 'epos_arm'

    @classmethod
    def start(cls):
        cls.candump = Candump('vcan0', os.path.join(cls.folder, 'candump.log'))
        wait_for_socket('vcan0', 1)
        super().start()
        cls.diagnostics = Latest('/diagnostics', DiagnosticArray)

    @classmethod
    def tearDownClass(cls):
        try:
            super().tearDownClass()
        finally:
            cls.candump.kill()

    def bus(self):
        """What the driver publishes of its bus: {key: value}."""
        def status(message):
            return next((s for s in message.status if s.name.endswith('bus can0')), None)

        message = self.diagnostics.wait_for(lambda m: status(m) is not None, 'diagnostics of can0')
        return {entry.key: entry.value for entry in status(message).values}

    def heard(self):
        """Frames of others: (received, lost)."""
        bus = self.bus()
        return int(bus['frames received']), int(bus['lost frames'])

    def test_d_a_fault_is_reported_and_reset(self):
        self.expect_emergency('joint3', OVERTEMPERATURE)

    def test_e_no_frame_of_a_flood_is_lost_unnoticed(self):
        received, lost_before = self.heard()
        target = received + lost_before + FLOOD
        subprocess.run(['cangen', 'vcan0', '-g', '0', '-p', '100', '-I', FLOOD_ID, '-L', '2', '-D', 'i', '-n', str(FLOOD)], check=True)
        end = time.monotonic() + PATIENCE
        while sum(self.heard()) < target:
            self.assertLess(time.monotonic(), end, self.bus())
        self.driver.go(JOINTS, [0.1] * 6, 2.0)
        lost = self.heard()[1] - lost_before
        numbers = self.flood_numbers()
        self.assertEqual(numbers, sorted(set(numbers)))
        self.assertLessEqual(FLOOD - len(numbers), lost)

    def flood_numbers(self):
        """The numbers in the frames of the flood, as far as the driver has written them."""
        data = [frame[4:] for frame in frames(self.wire_log) if frame.startswith(FLOOD_ID + '#')]
        return [int.from_bytes(bytes.fromhex(text), 'little') for text in data]

    def test_f_candump_has_seen_what_the_wire_log_says(self):
        self.assertEqual(self.end_driver(), 0, self.driver_program.output())
        type(self).driver_program = None
        complaints = self.candump.end()
        self.assertNotIn('DROPCOUNT', complaints)
        witness = frames(self.candump.path)
        log = frames(self.wire_log)
        self.assertGreater(len(log), FLOOD)
        # Before the driver listens there is nothing but the drives' boot-up messages.
        first = next(i for i, frame in enumerate(witness) if not re.match('70[1-6]#00$', frame))
        begin = next(i for i in range(first + 1) if witness[i:i + 100] == log[:100])
        for number, (seen, written) in enumerate(zip(witness[begin:], log)):
            self.assertEqual(seen, written, 'frame %d' % number)
        self.assertGreaterEqual(len(witness) - begin, len(log))

    def test_g_wireshark_finds_no_malformed_frame(self):
        log = self.candump.path
        with open(log) as file:
            lines = len(file.readlines())
        seen = tshark(log, '-T', 'fields', '-E', 'separator=;', '-e', '_ws.col.Protocol', '-e', '_ws.malformed', '-e', '_ws.expert.message')
        self.assertEqual(len(seen.splitlines()), lines)
        self.assertEqual(set(seen.splitlines()), {'CANopen;;'})
