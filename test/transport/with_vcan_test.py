"""scripts/with_vcan: the command sees vcan0 and its own surroundings, the caller sees the command's output and status, and nothing
stays behind."""

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
WITH_VCAN = str(ROOT / "scripts" / "with_vcan")

# Sends a frame over vcan0 from one socket to another, without any other program.
EXCHANGE = """
import os, socket, sys
def can():
    s = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
    s.settimeout(10)
    s.bind(("vcan0",))
    return s
a, b = can(), can()
frame = (0x181).to_bytes(4, "little") + bytes([2, 0, 0, 0, 0xCA, 0xFE]) + bytes(6)
a.send(frame)
assert b.recv(16) == frame
print(os.getcwd(), sys.argv[1:], os.environ["GREETING"])
sys.stderr.write("to the error output\\n")
sys.stdout.buffer.write(b"no end of line, CR \\r and NUL \\0 as they are")
sys.exit(7)
"""


def environment(folder):
    return {**os.environ, "TMPDIR": str(folder), "GREETING": 'two words, "quotes", $HOME\nand a second line'}


def run(folder, *arguments):
    return subprocess.run([WITH_VCAN, *arguments], cwd=folder, env=environment(folder), stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=400)


@pytest.mark.parametrize("nested", [False, True], ids=["user_mode_linux", "network_namespace"])
def test_a_command_runs_in_its_surroundings_with_vcan0(tmp_path, nested):
    """Inside user-mode Linux the kernel has CAN, so the other way is tried there."""
    command = ["python3", "-c", EXCHANGE, "an argument", "", "*"]
    result = run(tmp_path, "--uml", *([WITH_VCAN] if nested else []), *command)
    expected = f"{tmp_path} ['an argument', '', '*'] {environment(tmp_path)['GREETING']}\n"
    assert result.stderr.decode() == "to the error output\n"
    assert result.stdout == expected.encode() + b"no end of line, CR \r and NUL \0 as they are"
    assert result.returncode == 7
    assert list(tmp_path.iterdir()) == []


def test_much_output_arrives_whole(tmp_path):
    result = run(tmp_path, "--uml", "seq", "100000")
    assert result.stdout.decode().split() == [str(i) for i in range(1, 100001)]
    assert result.returncode == 0


def test_the_time_limit_ends_the_command(tmp_path):
    result = run(tmp_path, "--uml", "--timeout", "15", "sleep", "1000")
    assert result.returncode == 124
    assert "sleep was ended after 15 s" in result.stderr.decode()
    assert list(tmp_path.iterdir()) == []


def test_an_interrupt_ends_the_command(tmp_path):
    process = subprocess.Popen([WITH_VCAN, "--uml", "sh", "-c", "echo started; sleep 1000"], cwd=tmp_path, env=environment(tmp_path),
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)
    assert process.stdout.readline() == b"started\n"
    begin = time.monotonic()
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=60) == 130
    assert time.monotonic() - begin < 60
    assert process.stdout.read() == b""
    assert list(tmp_path.iterdir()) == []


def test_a_wrong_call_is_explained(tmp_path):
    for arguments, reason in ((["--timeout", "soon", "true"], 'not "soon"'), (["--fast"], "unknown option --fast"), ([], "no command")):
        result = run(tmp_path, *arguments)
        assert result.returncode == 125
        assert reason in result.stderr.decode()
