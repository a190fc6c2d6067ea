"""A CiA 402 master on python-can, with nothing of this project, against the emulated cyclic drives of a configuration on vcan0: run by
scripts/with_vcan.

The drive's own description is config/eds/cyclic_emulated.eds. IMD_EMULATED_DRIVES is the program under test.
"""
import math
import os
import struct
import time

import pytest
from canopen_client import (CONTROLWORD, MODE, MODE_DISPLAY, POSITION_ACTUAL, POSITION_DEMAND, START, STATUSWORD, TO_OPERATION_ENABLED,
                            booted)
from programs import Drives

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..')
NODE = 3
DEVICE_TYPE, SUPPORTED_MODES = (0x1000, 0), (0x6502, 0)
PERIOD_OF_TARGETS = (0x60C2, 1)
RIDE_THROUGH = (0x2100, 2)
CYCLIC_SYNCHRONOUS_POSITION = 8
SYNC = 0x080
PERIOD = 0.010  # s
FOLLOWS = 1 << 12
WAY, DURATION = 20000, 1.5  # counts, s


@pytest.fixture(scope='module')
def drives():
    running = Drives(os.environ['IMD_EMULATED_DRIVES'], ['--config', os.path.join(ROOT, 'config', 'six_axis_cyclic_socketcan.yaml')])
    yield running
    assert running.end() == 0


@pytest.fixture
def client(drives):
    with booted(NODE) as one:
        yield one


def test_the_program_says_what_it_serves(drives):
    drives.wait_for('^ready: cyclic drives with node ids 1, 2, 3, 4, 5, 6 on vcan0 ')


def test_it_is_a_servo_drive_with_mode_8(client):
    assert client.number(DEVICE_TYPE) & 0xFFFF == 402
    assert client.number(SUPPORTED_MODES) == 1 << 7


def minimum_jerk(share):
    """From 0 to 1, at rest at both ends."""
    return share ** 3 * (10.0 + share * (6.0 * share - 15.0))


def send_targets(client, targets):
    """Controlword and target position by RPDO1, as mapped by default, one in front of each SYNC."""
    due = time.monotonic()
    for target in targets:
        client.send(0x200 + NODE, struct.pack('<Hi', 0x0F, target))
        client.send(SYNC, [])
        due += PERIOD
        time.sleep(max(0.0, due - time.monotonic()))


def test_it_follows_one_target_position_a_sync(client):
    client.download(PERIOD_OF_TARGETS, bytes([round(PERIOD * 1e3)]))
    client.download(RIDE_THROUGH, bytes([100]))  # a loaded machine is no fault of the drive
    client.download(MODE, bytes([CYCLIC_SYNCHRONOUS_POSITION]))
    client.until(MODE_DISPLAY, '<b', lambda mode: mode == CYCLIC_SYNCHRONOUS_POSITION)
    client.nmt(START)
    client.walk(TO_OPERATION_ENABLED)
    start = client.number(POSITION_ACTUAL, '<i')
    count = round(DURATION / PERIOD)
    client.drain()
    send_targets(client, [start] * 5 + [start + round(WAY * minimum_jerk((i + 1) / count)) for i in range(count)] + [start + WAY] * 20)
    # TPDO1, as mapped by default: statusword and actual position, an answer to each SYNC.
    reports = []
    while True:
        message = client.bus.recv(timeout=0)
        if message is None:
            break
        if message.arbitration_id == 0x180 + NODE:
            reports.append(struct.unpack('<Hi', bytes(message.data)))
    assert len(reports) == count + 25
    assert all(status & 0x6F == 0x27 for status, _ in reports)
    assert all(status & FOLLOWS for status, _ in reports[5:])
    positions = [position for _, position in reports]
    # This master is late now and then, as the machine has time for it. Then the drive goes on along its polynomial, and comes back by
    # less than the way of one target position.
    fastest = 1.875 * WAY / count
    backward = max(before - after for before, after in zip(positions, positions[1:]))
    assert backward < fastest, 'it goes back by no more than it went too far'
    assert any(math.isclose(position - start, WAY / 2, abs_tol=WAY / 20) for position in positions), 'it has been on the way'
    assert client.number(POSITION_DEMAND, '<i') == start + WAY
    assert abs(positions[-1] - start - WAY) <= 2
    client.download(CONTROLWORD, struct.pack('<H', 0x06))
    client.until(STATUSWORD, '<H', lambda status: status & 0x6F == 0x21)
