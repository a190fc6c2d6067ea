"""The program emulated_drives on a real SocketCAN interface, spoken to in bytes: run by scripts/with_vcan.

IMD_EMULATED_DRIVES is the program. Frames are those of CiA 301 and of the EPOS2 object dictionary.
"""

import os
import signal
import socket
import struct
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["IMD_EMULATED_DRIVES"]
PATIENCE = 20.0


class Can:
    def __init__(self):
        self.socket = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.socket.bind(("vcan0",))

    def send(self, identifier, data):
        self.socket.send(struct.pack("<IB3x8s", identifier, len(data), bytes(data)))

    def wait_for(self, identifier, timeout=PATIENCE):
        """Data of the next frame with that identifier."""
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            self.socket.settimeout(max(0.001, end - time.monotonic()))
            try:
                found, length, data = struct.unpack("<IB3x8s", self.socket.recv(16))
            except socket.timeout:
                break
            if found == identifier:
                return data[:length]
        raise AssertionError(f"no frame {identifier:#x} within {timeout} s")

    def read_object(self, node, index, subindex):
        """Expedited SDO upload."""
        self.send(0x600 + node, struct.pack("<BHB4x", 0x40, index, subindex))
        answer = self.wait_for(0x580 + node)
        assert answer[1:4] == struct.pack("<HB", index, subindex)
        return answer[0], struct.unpack("<I", answer[4:])[0]


class Drives:
    def __init__(self, *arguments):
        self.process = subprocess.Popen([PROGRAM, "--can", "vcan0", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, bufsize=1)

    def line(self):
        return self.process.stdout.readline().rstrip("\n")

    def command(self, text):
        self.process.stdin.write(text + "\n")
        return self.line()

    def end(self, signal_number=signal.SIGTERM):
        self.process.send_signal(signal_number)
        return self.process.wait(timeout=PATIENCE)


@pytest.fixture
def can():
    return Can()


@pytest.fixture
def start():
    started = []

    def begin(*arguments):
        started.append(Drives(*arguments))
        return started[-1]

    yield begin
    for drives in started:
        if drives.process.poll() is None:
            drives.process.kill()
            drives.process.wait()


def test_drives_boot_and_answer(can, start):
    drives = start("--epos", "1,2")
    assert drives.line() == "ready: EPOS2 drives with node ids 1, 2 on vcan0 with the bit times of 1000000 bit/s"
    assert can.wait_for(0x701) == b"\0"
    command, vendor = can.read_object(1, 0x1018, 1)
    assert (command, vendor) == (0x43, 0xFB)  # four bytes, maxon motor
    assert can.read_object(2, 0x1018, 4) == (0x43, 2)
    command, code = can.read_object(1, 0x7FFF, 0)
    assert (command, code) == (0x80, 0x06020000)  # aborted: no such object


def test_faults_come_from_the_standard_input(can, start):
    drives = start("--epos", "1,2")
    drives.line()
    can.wait_for(0x702)
    assert drives.command("1 emcy 0x2310") == "done: 1 emcy 0x2310"
    assert can.wait_for(0x081)[:2] == b"\x10\x23"
    assert drives.command("2 power_cycle 0.1") == "done: 2 power_cycle 0.1"
    assert can.wait_for(0x702) == b"\0"
    assert drives.command("7 stall 1").startswith('refused: "7" is neither a drive nor an interface')
    assert drives.command("1 explode").startswith('refused: "explode" is no fault')
    assert drives.command("vcan0 drop_id 0x581 1") == "done: vcan0 drop_id 0x581 1"
    can.send(0x601, struct.pack("<BHB4x", 0x40, 0x1018, 1))
    with pytest.raises(AssertionError, match="no frame 0x581"):
        can.wait_for(0x581, timeout=1.0)
    assert can.read_object(1, 0x1018, 1) == (0x43, 0xFB)


def test_the_drives_of_a_configuration(can, start):
    drives = start("--config", str(ROOT / "config" / "rrbot_epos.yaml"), "--clock-error-ppm", "50")
    assert "node ids 1, 2 on vcan0" in drives.line()
    can.wait_for(0x702)
    assert drives.command("joint2 power_cycle 0.1") == "done: joint2 power_cycle 0.1"
    assert can.wait_for(0x702) == b"\0"


def test_the_interface_may_go_down_and_come_back(can, start):
    drives = start("--epos", "1")
    drives.line()
    can.wait_for(0x701)
    subprocess.check_call(["/sbin/ip", "link", "set", "dev", "vcan0", "down"])
    assert drives.line() == "CAN interface vcan0 is down: sudo ip link set dev vcan0 up"
    subprocess.check_call(["/sbin/ip", "link", "set", "dev", "vcan0", "up"])
    assert drives.line().startswith("ready: ")
    assert Can().read_object(1, 0x1018, 1) == (0x43, 0xFB)


@pytest.mark.parametrize("signal_number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_it_cleanly(start, signal_number):
    drives = start("--epos", "1")
    drives.line()
    assert drives.end(signal_number) == 0
    assert drives.process.stderr.read() == ""


def test_wrong_arguments_are_explained(start):
    for arguments, reason in ((["--epos", "128"], '--epos: "128" is not a number within 1..127'),
                              (["--epos", "1,1"], "node_id 1 is taken"),
                              ([], "either --epos 1,2,3 or --config FILE"),
                              (["--epos", "1,2,3", "--clock-error-ppm", "1,2"], "2 values for 3 drives"),
                              (["--fast"], "unknown argument --fast")):
        drives = start(*arguments)
        assert drives.process.wait(timeout=PATIENCE) == 2
        assert reason in drives.process.stderr.read()
