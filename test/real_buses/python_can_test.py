"""A CANopen client on python-can, with nothing of this project, against an emulated EPOS2 on vcan0: run by scripts/with_vcan.

Services as CiA 301 has them, objects as in the EPOS2's object dictionary, records as in "EPOS3 Interpolated Position Mode"
(interpolation data record: position s32, velocity s24 in rpm, time u8 in ms). IMD_EMULATED_DRIVES is the program under test.
"""
import os
import struct
import time

import can
import pytest
from programs import PATIENCE, Drives

NODE = 5
HOST = 100

START, STOP, PRE_OPERATIONAL, RESET_NODE = 1, 2, 128, 129
BOOT_UP, STOPPED, OPERATIONAL, IS_PRE_OPERATIONAL = 0, 4, 5, 127

VENDOR = (0x1018, 1)
SERIAL_NUMBER = (0x1018, 4)
DEVICE_NAME = (0x1008, 0)
PRODUCER_HEARTBEAT = (0x1017, 0)
MODE, MODE_DISPLAY = (0x6060, 0), (0x6061, 0)
CONTROLWORD, STATUSWORD = (0x6040, 0), (0x6041, 0)
POSITION_DEMAND, POSITION_ACTUAL = (0x6062, 0), (0x6064, 0)
RECORD = (0x20C1, 0)
BUFFER_STATUS = (0x20C4, 1)
USED_RECORDS, BUFFER_CLEAR = (0x60C4, 4), (0x60C4, 6)


class Aborted(Exception):
    pass


def crc(data):
    """CRC-16 of block transfers: polynomial x^16 + x^12 + x^5 + 1, start value 0, bit by bit."""
    register = 0
    for byte in data:
        for bit in range(7, -1, -1):
            feedback = (register >> 15) ^ (byte >> bit & 1)
            register = (register << 1 & 0xFFFF) ^ (0x1021 if feedback else 0)
    return register


class Client:
    """SDO client, NMT master and PDO producer of one node."""

    def __init__(self, node):
        self.node = node
        self.bus = can.Bus(interface='socketcan', channel='vcan0')
        self.other = []

    def send(self, identifier, data):
        self.bus.send(can.Message(arbitration_id=identifier, data=data, is_extended_id=False))

    def wait_for(self, identifier, fits=lambda data: True, patience=PATIENCE):
        """The next frame with that identifier whose data fits, from now on."""
        end = time.monotonic() + patience
        while time.monotonic() < end:
            message = self.bus.recv(timeout=max(0.001, end - time.monotonic()))
            if message is not None and message.arbitration_id == identifier and fits(bytes(message.data)):
                return bytes(message.data)
        raise AssertionError('no such frame %#x within %g s' % (identifier, patience))

    def drain(self):
        while self.bus.recv(timeout=0) is not None:
            pass

    def nmt(self, command):
        self.send(0, [command, self.node])

    def wait_state(self, state):
        return self.wait_for(0x700 + self.node, lambda data: data == bytes([state]))

    def request(self, data):
        self.send(0x600 + self.node, bytes(data).ljust(8, b'\0'))

    def answer(self):
        data = self.wait_for(0x580 + self.node)
        if data[0] == 0x80:
            raise Aborted('%#010x' % struct.unpack('<I', data[4:])[0])
        return data

    def exchange(self, data):
        self.request(data)
        return self.answer()

    def upload(self, item):
        """Expedited or segmented, as the server has it."""
        first = self.exchange(struct.pack('<BHB', 0x40, *item))
        assert first[1:4] == struct.pack('<HB', *item)
        if first[0] & 2:
            return first[4:8 - (first[0] >> 2 & 3)] if first[0] & 1 else first[4:]
        assert first[0] == 0x41
        data = b''
        toggle = 0
        while True:
            segment = self.exchange([0x60 | toggle])
            assert segment[0] & 0xF0 == toggle
            data += segment[1:8 - (segment[0] >> 1 & 7)]
            if segment[0] & 1:
                break
            toggle ^= 0x10
        assert len(data) == struct.unpack('<I', first[4:])[0]
        return data

    def download(self, item, data):
        """Expedited."""
        answer = self.exchange(struct.pack('<BHB', 0x23 | (4 - len(data)) << 2, *item) + data)
        assert answer[:4] == struct.pack('<BHB', 0x60, *item)

    def download_segmented(self, item, data):
        assert self.exchange(struct.pack('<BHBI', 0x21, *item, len(data)))[0] == 0x60
        toggle = 0
        for begin in range(0, len(data), 7):
            part = data[begin:begin + 7]
            last = begin + 7 >= len(data)
            answer = self.exchange(bytes([toggle | (7 - len(part)) << 1 | last]) + part)
            assert answer[0] == 0x20 | toggle
            toggle ^= 0x10

    def upload_block(self, item, block=127):
        first = self.exchange(struct.pack('<BHBBB', 0xA4, *item, block, 0))
        assert first[0] & 0xE1 == 0xC0
        with_crc = first[0] & 4
        size = struct.unpack('<I', first[4:])[0] if first[0] & 2 else None
        self.request([0xA3])
        data = b''
        while True:
            last = False
            for number in range(1, block + 1):
                segment = self.wait_for(0x580 + self.node)
                assert segment[0] & 0x7F == number
                data += segment[1:]
                last = segment[0] & 0x80
                if last:
                    break
            if last:
                break
            self.request([0xA2, number, block])
        end = self.exchange([0xA2, number, block])
        assert end[0] & 0xE3 == 0xC1
        unused = end[0] >> 2 & 7
        data = data[:len(data) - unused]
        assert size in (None, len(data))
        if with_crc:
            assert struct.unpack('<H', end[1:3])[0] == crc(data)
        self.request([0xA1])
        return data

    def download_block(self, item, data, checksum=None):
        first = self.exchange(struct.pack('<BHBI', 0xC6, *item, len(data)))
        assert first[0] & 0xFB == 0xA0 and first[1:4] == struct.pack('<HB', *item)
        block = first[4]
        parts = [data[begin:begin + 7] for begin in range(0, len(data), 7)]
        assert len(parts) <= block
        for number, part in enumerate(parts, 1):
            self.request(bytes([number | (0x80 if number == len(parts) else 0)]) + part)
        answer = self.answer()
        assert answer[:2] == bytes([0xA2, len(parts)])
        checksum = crc(data) if checksum is None else checksum
        assert self.exchange(struct.pack('<BH', 0xC1 | (7 - len(parts[-1])) << 2, checksum))[0] == 0xA1

    def number(self, item, form='<I'):
        return struct.unpack(form, self.upload(item))[0]

    def until(self, item, form, fits):
        """Reads an object until its value fits."""
        end = time.monotonic() + PATIENCE
        while True:
            value = self.number(item, form)
            if fits(value):
                return value
            assert time.monotonic() < end, '%04X:%02X is %#x' % (*item, value)


@pytest.fixture(scope='module')
def drives():
    running = Drives(os.environ['IMD_EMULATED_DRIVES'], ['--can', 'vcan0', '--epos', str(NODE)])
    yield running
    assert running.end() == 0


@pytest.fixture
def client(drives):
    one = Client(NODE)
    one.nmt(RESET_NODE)
    one.wait_state(BOOT_UP)
    yield one
    one.bus.shutdown()


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


def switch_on(client):
    for word, state in ((0x06, 0x21), (0x07, 0x23), (0x0F, 0x27)):
        client.download(CONTROLWORD, struct.pack('<H', word))
        client.until(STATUSWORD, '<H', lambda status, state=state: status & 0x6F == state)


def test_pvt_motion(client):
    """20 records by PDO: 10 revolutions to and 3.5 back, from rest to rest; an encoder of 500 lines, so 2000 qc per revolution."""
    for item, data in (((0x1403, 1), struct.pack('<I', 0x80000500 + NODE)), ((0x1603, 0), b'\0'),
                       ((0x1603, 1), struct.pack('<I', 0x20C10040)), ((0x1603, 0), b'\1'),
                       ((0x1403, 1), struct.pack('<I', 0x500 + NODE)), ((0x6065, 0), struct.pack('<I', 20000))):
        client.download(item, data)
    client.nmt(START)
    enter_mode(client)
    switch_on(client)
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
