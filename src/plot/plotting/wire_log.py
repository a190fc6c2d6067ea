"""Wire logs, `(seconds.microseconds) BUS ID#DATA` or `(seconds.microseconds) BUS > TEXT`: what candump -L writes too."""
import re

import wire
from problems import BadInput

LINE = re.compile(r"\((\d+\.\d+)\) (\S+) (?:([<>]) (.*)|([0-9A-Fa-f]{3,8}#(?:(?:[0-9A-Fa-f]{2})*|R\d?)))( [RT])?$")


def is_one(head):
    return LINE.match(head.split(b"\n")[0].decode("ascii", "replace").rstrip("\r")) is not None


def read(path, session, rates):
    counter = wire.LoadCounter()
    with open(path, encoding="ascii", errors="replace") as file:
        for number, line in enumerate(file, 1):
            match = LINE.match(line.rstrip("\r\n"))
            if not match:
                raise BadInput(f"{path}: line {number} is not as a wire log has it: {line[:80].rstrip()}")
            time, bus, direction, text, frame, _ = match.groups()
            if bus not in counter.rates:
                counter.add_bus(bus, rates["silverlode" if frame is None else "canopen"])
            counter.add(float(time), bus, text if frame is None else frame, direction == "<")
    for bus, load in counter.loads().items():
        session.loads.setdefault(bus, load)  # a recording of the same buses knows more
