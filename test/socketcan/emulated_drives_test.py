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
        self.process = subprocess.Popen([PROGRAM, *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
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
def run():
    started = []

    def begin(*arguments):
        started.append(Drives(*arguments))
        return started[-1]

    yield begin
    for drives in started:
        if drives.process.poll() is None:
            drives.process.kill()
            drives.process.wait()


@pytest.fixture
def start(run):
    return lambda *arguments: run("--can", "vcan0", *arguments)


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
    for number in ("nan", "1e300", "-1000000"):
        refused = f'refused: "clock {number}": PPM is {number}; it must be a number within -100000..100000'
        assert drives.command(f"1 clock {number}") == refused
    assert drives.command("2 power_cycle nan") == 'refused: "power_cycle nan": SECONDS is nan; it must be a number within 0..3600'
    assert drives.command("vcan0 bus_off 1e300").startswith('refused: "bus_off 1e300": SECONDS is 1e300; it must be')
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


def configuration(folder, drives, buses="can0: {type: canopen, transport: socketcan, interface: vcan0}"):
    file = folder / f"arm{len(list(folder.iterdir()))}.yaml"
    joints = ", ".join(drives)
    lines = "\n".join(f"  {joint}: {{{drive}, counts_per_revolution: 2000}}" for joint, drive in drives.items())
    file.write_text(f"joints: [{joints}]\nbuses:\n  {buses}\ndrives:\n{lines}\n")
    return str(file)


def test_drives_of_several_kinds_share_a_bus(can, run, tmp_path):
    drives = run("--config", configuration(tmp_path, {
        "base": "bus: can0, type: cyclic, node_id: 1", "elbow": "bus: can0, type: epos_ipm, node_id: 2",
        "wrist": "bus: can0, type: cyclic, node_id: 3"}))
    assert drives.line() == ("ready: cyclic drives with node ids 1, 3 and EPOS2 drives with node ids 2 on vcan0 "
                             "with the bit times of 1000000 bit/s")
    can.wait_for(0x703)
    assert can.read_object(1, 0x6502, 0)[1] == 1 << 7  # mode 8, cyclic synchronous position
    assert can.read_object(2, 0x1018, 1)[1] == 0xFB  # maxon motor
    assert can.read_object(3, 0x6502, 0)[1] == 1 << 7
    assert drives.command("wrist emcy 0x2310") == "done: wrist emcy 0x2310"
    assert can.wait_for(0x083)[:2] == b"\x10\x23"


def test_a_configuration_that_cannot_be_served_is_refused_in_a_sentence(run, tmp_path):
    one = {"base": "bus: can0, type: cyclic, node_id: 1"}
    two = "can0: {type: canopen, transport: socketcan, interface: vcan0}\n  can1: {type: canopen, transport: socketcan, interface: vcan1}"
    for file, reason in ((configuration(tmp_path, {**one, "elbow": "bus: can0, type: epos_ipm, node_id: 1"}),
                          "Parameter drives/elbow/node_id is 1, which joint base has on bus can0 already."),
                         (configuration(tmp_path, {"base": "bus: can0, type: hovering, node_id: 1"}),
                          'Parameter drives/base/type is "hovering"; allowed: epos_ipm, silverlode_ims, cyclic.'),
                         (configuration(tmp_path, one, two), "no drive is on bus can1, so there is nothing to serve on vcan1")):
        drives = run("--config", file)
        assert drives.process.wait(timeout=PATIENCE) == 2
        assert reason in drives.process.stderr.read()


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
                              (["--epos", "1,1"], "--epos names 1 twice"),
                              ([], "either --epos 1,2,3 or --config FILE"),
                              (["--epos", "1,2,3", "--clock-error-ppm", "1,2"], "2 values for 3 drives"),
                              (["--fast"], "unknown argument --fast")):
        drives = start(*arguments)
        assert drives.process.wait(timeout=PATIENCE) == 2
        assert reason in drives.process.stderr.read()
