"""A CANopen client on python-can, with nothing of this project. Services as CiA 301 has them, objects of CiA 402."""
import contextlib
import struct
import time

import can
from programs import PATIENCE

START, STOP, PRE_OPERATIONAL, RESET_NODE = 1, 2, 128, 129
BOOT_UP, STOPPED, OPERATIONAL, IS_PRE_OPERATIONAL = 0, 4, 5, 127

MODE, MODE_DISPLAY = (0x6060, 0), (0x6061, 0)
CONTROLWORD, STATUSWORD = (0x6040, 0), (0x6041, 0)
POSITION_DEMAND, POSITION_ACTUAL = (0x6062, 0), (0x6064, 0)


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

    def walk(self, words_and_states, statusword_mask=0x6F):
        """Controlwords by SDO, and the state of CiA 402 that each is to lead to."""
        for word, state in words_and_states:
            self.download(CONTROLWORD, struct.pack('<H', word))
            self.until(STATUSWORD, '<H', lambda status, state=state: status & statusword_mask == state)


@contextlib.contextmanager
def booted(node):
    """A client of a node that has just booted."""
    one = Client(node)
    one.nmt(RESET_NODE)
    one.wait_state(BOOT_UP)
    try:
        yield one
    finally:
        one.bus.shutdown()


# Shutdown, switch on, enable operation: Ready to switch on, Switched on, Operation enabled.
TO_OPERATION_ENABLED = ((0x06, 0x21), (0x07, 0x23), (0x0F, 0x27))
