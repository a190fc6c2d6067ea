"""How long what crosses a bus takes on it: of CAN as ISO 11898-1 has it, stuff bits counted one by one; of serial lines 11 bits a character."""
import math
import re
from functools import lru_cache

from session import Load

BIN = 0.1                # s
FRAME = re.compile(r"(?:[0-9A-Fa-f]{3}|[0-9A-Fa-f]{8})#")
BITS_PER_CHARACTER = 11  # start, 8 data and 2 stop bits, as SilverLode has them

SERVICES = [("NMT", 0x000, 0x000), ("SYNC, TIME", 0x080, 0x080), ("SYNC, TIME", 0x100, 0x100), ("EMCY", 0x081, 0x0FF), ("SDO", 0x580, 0x67F),
            ("heartbeat", 0x700, 0x77F), ("PDO", 0x180, 0x57F)]


def kind_of(identifier):
    """Of CiA 301's predefined connection set."""
    return next((name for name, first, last in SERVICES if first <= identifier <= last), "other")


@lru_cache(maxsize=65536)
def frame_bits(text):
    """Bit times of a frame written as `candump` writes it, ID#DATA or ID#R, interframe space with it."""
    identifier, _, data = text.partition("#")
    remote = data.startswith("R")
    octets = b"" if remote else bytes.fromhex(data)
    length = int(data[1:] or 0) if remote else len(octets)
    bits = "0" + arbitration(identifier, remote) + f"{length:04b}" + "".join(f"{octet:08b}" for octet in octets)
    bits += f"{crc15(bits):015b}"
    return len(bits) + stuff_bits(bits) + 13  # CRC delimiter, acknowledge slot and delimiter, 7 of end of frame, 3 of interframe space


def arbitration(identifier, remote):
    """Up to the reserved bits, r0 alone or r1 and r0."""
    number = int(identifier, 16)
    rtr = "1" if remote else "0"
    if len(identifier) <= 3:
        return f"{number:011b}" + rtr + "00"
    return f"{number >> 18:011b}" + "11" + f"{number & 0x3FFFF:018b}" + rtr + "00"


def crc15(bits):
    crc = 0
    for bit in bits:
        feed = (bit == "1") != bool(crc & 0x4000)
        crc = ((crc << 1) & 0x7FFF) ^ (0x4599 if feed else 0)
    return crc


def stuff_bits(bits):
    """After five bits of one kind comes one of the other, which counts as the first of the next five."""
    stuffed, run, last = 0, 0, ""
    for bit in bits:
        run = run + 1 if bit == last else 1
        last = bit
        if run == 5:
            stuffed += 1
            last, run = ("0" if bit == "1" else "1"), 1
    return stuffed


class LoadCounter:
    """Sums what crosses the buses in bins of 0.1 s."""

    def __init__(self):
        self.rates = {}
        self.limits = {}
        self.bins = {}

    def add_bus(self, name, rate, limit=None):
        self.rates[name] = float(rate)
        self.limits[name] = limit

    def add(self, time, bus, content, from_drive):
        if FRAME.match(content):
            bits, kind = frame_bits(content), kind_of(int(content.partition("#")[0], 16))
        else:  # a line without its CR, what does not print as \xNN
            bits = BITS_PER_CHARACTER * (len(content) - 3 * content.count("\\x") + 1)
            kind = "replies" if from_drive else "requests"
        seconds = bits / self.rates[bus]
        bins = self.bins.setdefault(bus, {}).setdefault(kind, {})
        number = math.floor(time / BIN)
        bins[number] = bins.get(number, 0.0) + seconds

    def loads(self):
        """The first and the last bin are left out: the file has only part of them."""
        result = {}
        for bus, kinds in self.bins.items():
            numbers = [number for bins in kinds.values() for number in bins]
            inner = range(min(numbers) + 1, max(numbers))
            by_kind = {kind: [bins.get(number, 0.0) / BIN for number in inner] for kind, bins in sorted(kinds.items())}
            result[bus] = Load([(number + 0.5) * BIN for number in inner], by_kind, self.limits[bus])
        return result
