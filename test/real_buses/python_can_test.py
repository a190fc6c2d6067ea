"""A CANopen client on python-can, with nothing of this project, against an emulated EPOS2 on vcan0: run by scripts/with_vcan.

Services as CiA 301 has them, objects as in the EPOS2's object dictionary, records as in "EPOS3 Interpolated Position Mode"
(interpolation data record: position s32, velocity s24 in rpm, time u8 in ms). IMD_EMULATED_DRIVES is the program under test.
"""
import os
import struct

import pytest
from canopen_client import (BOOT_UP, CONTROLWORD, IS_PRE_OPERATIONAL, MODE, MODE_DISPLAY, OPERATIONAL, POSITION_ACTUAL, POSITION_DEMAND,
                            PRE_OPERATIONAL, RESET_NODE, START, STATUSWORD, STOP, STOPPED, TO_OPERATION_ENABLED, Aborted, booted, crc)
from programs import Drives

NODE = 5
HOST = 100

VENDOR = (0x1018, 1)
SERIAL_NUMBER = (0x1018, 4)
DEVICE_NAME = (0x1008, 0)
PRODUCER_HEARTBEAT = (0x1017, 0)
RECORD = (0x20C1, 0)
BUFFER_STATUS = (0x20C4, 1)
USED_RECORDS, BUFFER_CLEAR = (0x60C4, 4), (0x60C4, 6)


@pytest.fixture(scope='module')
def drives():
    running = Drives(os.environ['IMD_EMULATED_DRIVES'], ['--can', 'vcan0', '--epos', str(NODE)])
    yield running
    assert running.end() == 0


@pytest.fixture
def client(drives):
    with booted(NODE) as one:
        yield one


def record(position, velocity, milliseconds):
    return struct.pack('<i', position) + struct.pack('<i', velocity)[:3] + bytes([milliseconds])


def test_expedited(client):
    assert client.number(VENDOR) == 0xFB  # maxon motor
    assert client.number(SERIAL_NUMBER) == NODE
    client.download(PRODUCER_HEARTBEAT, struct.pack('<H', 1234))
    assert client.number(PRODUCER_HEARTBEAT, '<H') == 1234
    with pytest.raises(Aborted, match='0x06020000'):  # no such object
        client.upload((0x60C1, 1))
    with pytest.raises(Aborted, match='0x06010002'):  # read only
        client.download(VENDOR, b'\1\0\0\0')


def test_segmented(client):
    assert client.upload(DEVICE_NAME).startswith(b'EPOS')
    enter_mode(client)
    client.download_segmented(RECORD, record(1000, 20, 100))
    assert client.number(USED_RECORDS, '<H') == 1


def test_block(client):
    assert crc(b'123456789') == 0x31C3  # the check value of this CRC
    assert client.upload_block(DEVICE_NAME) == client.upload(DEVICE_NAME)
    enter_mode(client)
    client.download_block(RECORD, record(1000, 20, 100))
    assert client.number(USED_RECORDS, '<H') == 1
    data = record(2000, 20, 100)
    with pytest.raises(Aborted, match='0x05040004'):  # CRC error
        client.download_block(RECORD, data, checksum=crc(data) ^ 1)
    assert client.number(USED_RECORDS, '<H') == 1


def test_nmt_and_heartbeat(client):
    client.download(PRODUCER_HEARTBEAT, struct.pack('<H', 20))
    for command, state in ((START, OPERATIONAL), (STOP, STOPPED), (PRE_OPERATIONAL, IS_PRE_OPERATIONAL)):
        client.nmt(command)
        client.wait_state(state)
    client.nmt(STOP)
    client.wait_state(STOPPED)
    client.request(struct.pack('<BHB', 0x40, *VENDOR))
    with pytest.raises(AssertionError, match='no such frame 0x585'):  # no SDO in this state
        client.wait_for(0x580 + NODE, patience=1.0)
    client.nmt(RESET_NODE)
    client.wait_state(BOOT_UP)
    assert client.number(PRODUCER_HEARTBEAT, '<H') == 0


def test_the_drive_misses_the_heartbeat_of_a_host(client):
    client.download((0x1016, 1), struct.pack('<I', HOST << 16 | 200))
    client.nmt(START)
    client.send(0x700 + HOST, [OPERATIONAL])
    code, register = struct.unpack('<HB', client.wait_for(0x080 + NODE)[:3])
    assert code == 0x8130  # life guard or heartbeat error
    assert register & 0x10


def enter_mode(client):
    """Interpolated position mode, FIFO open and empty."""
    client.download(MODE, b'\7')
    client.until(MODE_DISPLAY, '<b', lambda mode: mode == 7)
    client.download(BUFFER_CLEAR, b'\0')
    client.download(BUFFER_CLEAR, b'\1')


def test_pvt_motion(client):
    """20 records by PDO: 10 revolutions to and 3.5 back, from rest to rest; an encoder of 500 lines, so 2000 qc per revolution."""
    for item, data in (((0x1403, 1), struct.pack('<I', 0x80000500 + NODE)), ((0x1603, 0), b'\0'),
                       ((0x1603, 1), struct.pack('<I', 0x20C10040)), ((0x1603, 0), b'\1'),
                       ((0x1403, 1), struct.pack('<I', 0x500 + NODE)), ((0x6065, 0), struct.pack('<I', 20000))):
        client.download(item, data)
    client.nmt(START)
    enter_mode(client)
    client.walk(TO_OPERATION_ENABLED)
    start = client.number(POSITION_DEMAND, '<i')
    # Speed in rpm at the end of each record of 100 ms, the demand moving on by the trapezoid between two of them: 2000 qc/rev, so
    # v rpm are v / 0.3 qc in 0.1 s.
    speeds = [300, 600, 600, 600, 600, 600, 600, 600, 600, 600, 300, 0, -300, -300, -300, -300, -300, -300, -300, 0]
    position = float(start)
    before = 0
    records = []
    for speed in speeds:
        position += 0.5 * (before + speed) / 0.03 * 0.1
        records.append(record(round(position), speed, 100))
        before = speed
    for data in records + [record(round(position), 0, 0)]:
        client.send(0x500 + NODE, data)
    client.until(USED_RECORDS, '<H', lambda used: used == len(records) + 1)
    client.download(CONTROLWORD, struct.pack('<H', 0x1F))
    client.until(STATUSWORD, '<H', lambda status: status & 0x1000)  # ip mode active
    highest = start

    def ended(status):
        nonlocal highest
        highest = max(highest, client.number(POSITION_DEMAND, '<i'))
        return not status & 0x1000

    client.until(STATUSWORD, '<H', ended)
    assert client.number(BUFFER_STATUS, '<H') & 0x0F00 == 0  # no error: neither underflow nor overflow, velocity, acceleration
    assert client.number(POSITION_DEMAND, '<i') == round(position)
    assert highest > round(position) + 2000
    client.until(POSITION_ACTUAL, '<i', lambda actual: abs(actual - round(position)) <= 2)
    assert client.number(STATUSWORD, '<H') & 0x6F == 0x27  # still enabled, no fault
