"""The program drive_tool against the program emulated_drives, on a real SocketCAN interface and on a pseudo-terminal: run by
scripts/with_vcan.

IMD_DRIVE_TOOL and IMD_EMULATED_DRIVES are the programs.
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
TOOL = os.environ["IMD_DRIVE_TOOL"]
DRIVES = os.environ["IMD_EMULATED_DRIVES"]
EDS = str(ROOT / "config" / "eds" / "epos2_emulated.eds")
# Far longer than anything takes on a loaded machine; no test waits for it to pass.
PATIENCE = 90.0


class Drives:
    def __init__(self, *arguments):
        self.process = subprocess.Popen([DRIVES, *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
        assert self.process.stdout.readline().startswith("ready: ")

    def end(self):
        self.process.terminate()
        self.process.wait(timeout=PATIENCE)


@pytest.fixture
def serve():
    started = []

    def begin(*arguments):
        started.append(Drives(*arguments))
        time.sleep(0.5)  # drives boot
        return started[-1]

    yield begin
    for drives in started:
        drives.end()


def tool(*arguments, answer=""):
    return subprocess.run([TOOL, *arguments], input=answer, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=PATIENCE)


def scan(place, everybody, timeouts):
    """The scan in which `everybody` has answered: a busy machine may need more patience than drives do."""
    for timeout in timeouts:
        found = tool("scan", place, "--timeout", str(timeout))
        if everybody in found.stdout:
            return found
    raise AssertionError(found)


def test_a_bus_from_the_scan_to_the_restored_parameter(serve, tmp_path):
    serve("--can", "vcan0", "--epos", "1,2")
    found = scan("vcan0", "2 of 127 node ids answer", (0.25, 0.5, 1.0))
    assert found.returncode == 0, found
    assert 'node 1: maxon EPOS2 70/10, firmware 0x2126 ("EPOS2")' in found.stdout
    assert "can be used, type: epos_ipm" in found.stdout

    drive = ("--node", "2", "--eds", EDS, "--timeout", "5")
    shown = tool("read", "vcan0", "Max Following Error", "0x1018:4", *drive)
    assert shown.stdout.splitlines() == [
        "0x6065:00 Max Following Error = 2000 (0x000007D0) position units  [UNSIGNED32, rw, default 2000]",
        "0x1018:04 Identity / Serial Number = 2 (0x00000002)  [UNSIGNED32, ro]"]
    file = tmp_path / "drive.txt"
    assert tool("dump", "vcan0", str(file), *drive).returncode == 0
    assert "0x6065:00  UNSIGNED32  2000" in file.read_text()

    # Without an answer nothing is written.
    refused = tool("write", "vcan0", "0x6065", "4000", *drive)
    assert refused.returncode == 1
    assert "0x6065:00 Max Following Error: 2000 -> 4000 position units" in refused.stdout
    assert "nothing is written" in refused.stderr
    assert tool("diff", "vcan0", str(file), *drive).returncode == 0
    assert tool("write", "vcan0", "0x6065", "4000", *drive, answer="y\n").returncode == 0
    different = tool("diff", "vcan0", str(file), *drive)
    assert different.returncode == 1
    assert "0x6065:00 Max Following Error: drive 4000, file 2000" in different.stdout

    other = tool("restore", "vcan0", str(file), "--node", "1", "--timeout", "5", "--yes")
    assert other.returncode == 1
    assert "the file is of another drive: serial is 0x00000002 in the file and 0x00000001 in the drive" in other.stderr
    assert tool("restore", "vcan0", str(file), *drive, "--yes").returncode == 0
    assert tool("diff", "vcan0", str(file), *drive).returncode == 0
    assert tool("save", "vcan0", *drive, "--yes").stdout == "saved\n"

    table = tool("monitor", "vcan0", "--node", "1,2", "--timeout", "5", "--once").stdout
    assert "node 1" in table and "0 of 64" in table and "load of the bus" in table


def test_bad_input_is_a_sentence(serve):
    serve("--can", "vcan0", "--epos", "1")
    for arguments, code, reason in (
            (["read", "vcan0", "0x6064"], 2, "say which drive, one of them: --node 1..127"),
            (["read", "vcan0", "0x7FFF", "--node", "1"], 1, "object does not exist"),
            (["read", "vcan0", "0x6064", "--node", "9"], 1, "node 9 does not answer"),
            (["write", "vcan0", "0x6064", "1", "--node", "1", "--yes"], 1, "SDO abort 0x06010002"),
            (["write", "vcan0", "0x607F", "99999", "--node", "1", "--eds", EDS, "--yes"], 1, "within 0..25000"),
            (["dump", "vcan0", "/tmp/nothing", "--node", "1"], 1, "--eds FILE"),
            (["restore", "vcan0", EDS, "--node", "1"], 2, "no file of drive_tool dump"),
            (["scan", "vcan7"], 1, "there is no CAN interface vcan7"),
            (["scan", "/dev/nothing"], 1, "there is no serial port /dev/nothing")):
        done = tool(*arguments)
        assert done.returncode == code, done
        assert reason in done.stderr
        assert done.stderr.startswith("drive_tool: ")


def test_a_silent_bus_is_told():
    done = tool("scan", "vcan0")
    assert done.returncode == 1
    assert "vcan0: the bus is silent. No program serves drives on it." in done.stdout


def test_another_master_is_told_before_anything_is_sent(serve):
    serve("--can", "vcan0", "--epos", "1")
    sender = subprocess.Popen(["python3", "-c", """
import socket, struct, time
can = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
can.bind(("vcan0",))
while True:
    can.send(struct.pack("<IB3x8s", 0x80, 0, b""))
    time.sleep(0.005)
"""])
    try:
        witness = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        witness.bind(("vcan0",))
        witness.settimeout(PATIENCE)
        witness.recv(16)  # the other master is there
        for arguments in (["scan", "vcan0"], ["write", "vcan0", "0x6065", "1", "--node", "1", "--yes"]):
            done = tool(*arguments)
            assert done.returncode == 1
            assert "another master is on" in done.stdout + done.stderr and "SYNC" in done.stdout + done.stderr
        witness.settimeout(0.0)
        heard = set()
        try:
            while True:
                heard.add(struct.unpack("<IB3x8s", witness.recv(16))[0])
        except BlockingIOError:
            pass
        assert 0x601 not in heard
    finally:
        sender.kill()
        sender.wait()


def test_a_serial_line(serve, tmp_path):
    port = str(tmp_path / "line")
    serve("--serial", port, "--silverlode", "16,17")
    found = scan(port, "2 of 254 addresses answer at 57600 bit/s", (0.02, 0.04, 0.1))
    assert found.returncode == 0, found
    assert "address 16: QuickSilver SilverLode, revision 31" in found.stdout
    drive = ("--address", "17", "--timeout", "5")
    file = tmp_path / "drive.txt"
    assert tool("dump", port, str(file), *drive).returncode == 0
    assert tool("write", port, "100", "-7", *drive, "--yes").returncode == 0
    assert tool("read", port, "100", *drive).stdout.startswith("register 100 = -7 (0xFFFFFFF9)")
    assert "register 100: drive -7, file 0" in tool("diff", port, str(file), *drive).stdout
    assert tool("restore", port, str(file), *drive, "--yes").returncode == 0
    assert tool("diff", port, str(file), *drive).returncode == 0
    table = tool("monitor", port, "--address", "16,17", "--timeout", "5", "--once").stdout
    assert "address 17" in table and "at rest; no fault" in table


def test_a_signal_ends_a_monitor(serve):
    serve("--can", "vcan0", "--epos", "1")
    process = subprocess.Popen([TOOL, "monitor", "vcan0", "--node", "1", "--period", "0.1"], stdout=subprocess.PIPE, text=True)
    while "load of the bus" not in process.stdout.readline():
        pass
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=PATIENCE) == 130
