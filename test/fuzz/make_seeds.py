#!/usr/bin/python3
"""Writes the seeds of the fuzzers whose inputs are bytes: test/fuzz/make_seeds.py

Each is called after what happens in it; the fuzzers say how they read their input. Seeds that are text, and inputs that were found, lie
beside them and are left alone.
"""

from pathlib import Path

SEEDS = Path(__file__).resolve().parent / "seeds"


def word(value):
    return bytes([value & 0xFF, value >> 8 & 0xFF])


def frame(identifier, *data):
    return word(identifier) + bytes([len(data), *data])


# ---- can_to_driver, serial_to_driver: what a step begins with

WAIT, ORDER, SPOIL, FRAME = 0, 1, 2, 3
ENABLE, DISABLE, RESET, HALT, CLEAR, CANCEL, MOVE_100_MS, MOVE_200_MS, MOVE_300_MS = range(9)
EPOS, CYCLIC, BOTH = range(3)
AT_ONCE, WHEN_UP = 0, 1


def wait(milliseconds):
    return bytes([WAIT, int(2 * milliseconds) - 1])


def order(which):
    return bytes([ORDER, which])


def spoil(position, mask):
    return bytes([SPOIL, position, mask])


def say(identifier, *data):
    return bytes([FRAME]) + frame(identifier, *data)


def in_motion(*steps):
    return order(MOVE_300_MS) + wait(30) + wait(30) + b"".join(steps) + wait(30)


CAN_TO_DRIVER = {
    "goal_to_epos": bytes([EPOS, WHEN_UP]) + order(MOVE_200_MS) + wait(32) * 12,
    "goal_to_cyclic": bytes([CYCLIC, WHEN_UP]) + order(MOVE_200_MS) + wait(32) * 12,
    "orders": bytes([BOTH, WHEN_UP]) + b"".join(order(which) + wait(20) for which in
                                                 (MOVE_300_MS, CANCEL, MOVE_100_MS, HALT, DISABLE, ENABLE, CLEAR, RESET)),
    "boot_up_in_bring_up": bytes([BOTH, AT_ONCE]) + wait(32) * 3 + say(0x701, 0x00) + wait(5) + say(0x702, 0x00),
    "forged_sdo_answers_in_bring_up": bytes([EPOS, AT_ONCE]) + wait(32) + wait(32) + wait(32) + (
        say(0x581, 0x43, 0x00, 0x10, 0x00, 0x92, 0x01, 0x02, 0x00) + say(0x581, 0x80, 0x00, 0x10, 0x00, 0, 0, 0x02, 0x06)
        + say(0x582, 0x41, 0x08, 0x10, 0x00, 0xFF, 0xFF, 0xFF, 0xFF)) * 4,
    "emergency_in_motion": bytes([EPOS, WHEN_UP]) + in_motion(say(0x081, 0x10, 0x32, 0x05, 0, 0, 0, 0, 0)),
    "nmt_stop_in_motion": bytes([BOTH, WHEN_UP]) + in_motion(say(0x000, 0x02, 0x01), wait(10), say(0x000, 0x82, 0x00)),
    "false_heartbeats": bytes([CYCLIC, WHEN_UP]) + in_motion(say(0x701, 0x7F), say(0x702, 0x04), say(0x77F, 0x05)),
    "short_pdos": bytes([BOTH, WHEN_UP]) + in_motion(*(say(base + node) for base in (0x180, 0x280, 0x380, 0x480) for node in (1, 2))),
    "false_positions": bytes([CYCLIC, WHEN_UP]) + in_motion(say(0x181, 0x37, 0x16, 0xFF, 0xFF, 0xFF, 0x7F, 0, 0),
                                                             say(0x281, 0xFF, 0xFF, 0xFF, 0xFF, 0x08, 0, 0, 0x80)),
    "foreign_sync_and_time": bytes([BOTH, WHEN_UP]) + in_motion(say(0x080), say(0x100, 1, 2, 3, 4, 5, 6), say(0x080, 1)),
    "foreign_master_commands": bytes([EPOS, WHEN_UP]) + in_motion(say(0x601, 0x2B, 0x40, 0x60, 0, 0x06, 0, 0, 0),
                                                                   say(0x601, 0x23, 0x00, 0x14, 1, 0x01, 2, 0, 0x80)),
    "remote_and_extended": bytes([BOTH, WHEN_UP]) + say(0x8000 | 0x181) + say(0x8000 | 0x701)
    + bytes([FRAME]) + word(0x1000 | 0x181) + word(0x0123) + bytes([2, 0xAA, 0x55]) + wait(10),
    "spoilt_frames": bytes([BOTH, WHEN_UP]) + in_motion(spoil(0, 0xFF), wait(10), spoil(3, 0x80), wait(10), spoil(7, 0x01)),
}


def serial_text(text, to_host=True):
    return bytes([5 if to_host else 6, len(text)]) + text


def garble(count, mask, to_host=True):
    return bytes([3 if to_host else 2, count, mask])


SERIAL_TO_DRIVER = {
    "goal": bytes([WHEN_UP]) + order(MOVE_200_MS) + wait(64) * 8,
    "orders": bytes([WHEN_UP]) + b"".join(order(which) + wait(60) for which in
                                           (MOVE_300_MS, CANCEL, MOVE_100_MS, HALT, DISABLE, ENABLE, CLEAR, RESET)),
    "noise_in_bring_up": bytes([AT_ONCE]) + serial_text(b"\x00\xff\x80*\r") + wait(20) + serial_text(b"# 10 0000 0000 0000 0000\r"),
    "false_answers": bytes([WHEN_UP]) + in_motion(serial_text(b"* 10\r"), wait(3), serial_text(b"! 11 0019 0006\r"), wait(3),
                                                  serial_text(b"# 10 000C FFFF FFFF\r"), wait(3), serial_text(b"# FF\r")),
    "foreign_host": bytes([WHEN_UP]) + in_motion(serial_text(b"@16 2\r", False), wait(10), serial_text(b"@255 3\r", False)),
    "lost_characters": bytes([WHEN_UP]) + in_motion(bytes([4, 3]), wait(10), bytes([4, 200])),
    "garbled_characters": bytes([WHEN_UP]) + in_motion(garble(5, 0x01), wait(10), garble(5, 0x80, False), wait(10), garble(100, 0x55)),
    "long_line_without_end": bytes([WHEN_UP]) + in_motion(*[serial_text(b"0123456789ABCDEF " * 3)] * 6),
}


# ---- can_to_epos, can_to_cyclic: how many 0.1 ms to wait after the frame, the frame

def later(ticks, sent):
    return bytes([ticks]) + sent


def read(index, sub):
    return later(10, frame(0x601, 0x40, index & 0xFF, index >> 8, sub, 0, 0, 0, 0))


def write(index, sub, value, size):
    return later(10, frame(0x601, 0x23 | 4 - size << 2, index & 0xFF, index >> 8, sub, *value.to_bytes(4, "little")))


OPERATIONAL = later(5, frame(0x000, 0x01, 0x01))


def switch_on(mode):
    return write(0x6060, 0, mode, 1) + b"".join(write(0x6040, 0, control, 2) for control in (0x06, 0x07, 0x0F))


CAN_TO_BOTH = {
    "reads": read(0x1000, 0) + read(0x1018, 1) + read(0x6041, 0) + read(0x6064, 0) + read(0x1234, 5),
    "segmented_upload": read(0x1008, 0) + later(10, frame(0x601, 0x60, 0, 0, 0, 0, 0, 0, 0))
    + later(10, frame(0x601, 0x70, 0, 0, 0, 0, 0, 0, 0)),
    "segmented_download": later(10, frame(0x601, 0x21, 0x60, 0x60, 0, 9, 0, 0, 0)) + later(10, frame(0x601, 0x00, 1, 2, 3, 4, 5, 6, 7))
    + later(10, frame(0x601, 0x15, 8, 9, 0, 0, 0, 0, 0)) + later(10, frame(0x601, 0x80, 0, 0, 0, 0, 0, 0, 0)),
    "block_and_unknown_services": b"".join(later(5, frame(0x601, command, 0x08, 0x10, 0, 4, 0, 0, 0)) for command in (0xA0, 0xC6, 0xE0,
            0xFF)),
    "nmt": b"".join(later(20, frame(0x000, command, 0x01)) for command in (1, 2, 128, 130, 129, 77)) + later(20, frame(0x000, 1, 0)),
    "heartbeats_and_guarding": write(0x1017, 0, 5, 2) + write(0x1016, 1, 0x7F000A, 4) + later(50, frame(0x77F, 5))
    + later(255, frame(0x8000 | 0x701)),
    "mapping": write(0x1A00, 0, 0, 1) + write(0x1A00, 1, 0x60640020, 4) + write(0x1A00, 2, 0x60410010, 4) + write(0x1A00, 0, 2, 1)
    + write(0x1800, 2, 1, 1) + OPERATIONAL + later(10, frame(0x080)) * 3,
    "short_frames": b"".join(later(2, frame(identifier)) for identifier in (0x000, 0x080, 0x100, 0x201, 0x301, 0x401, 0x501, 0x601)),
    "sync_storm": OPERATIONAL + later(0, frame(0x080)) * 60,
}

RECORD = later(10, frame(0x201, 0x64, 0x00, 0x00, 0x00, 0x0A, 0x00, 0x00, 0x0A))

CAN_TO_EPOS = {
    "interpolated_motion": write(0x1400, 1, 0x201, 4) + write(0x1600, 0, 0, 1) + write(0x1600, 1, 0x20C10040, 4) + write(0x1600, 0, 1, 1)
    + OPERATIONAL + switch_on(7) + write(0x60C4, 6, 1, 1) + RECORD * 5 + write(0x6040, 0, 0x1F, 2) + later(255, frame(0x080)) * 3,
    "buffer_overflow": write(0x1400, 1, 0x201, 4) + write(0x1600, 0, 0, 1) + write(0x1600, 1, 0x20C10040, 4) + write(0x1600, 0, 1, 1)
    + OPERATIONAL + switch_on(7) + write(0x60C4, 6, 1, 1) + RECORD * 70,
    "store_and_restore": write(0x1010, 1, 0x65766173, 4) + write(0x1011, 1, 0x64616F6C, 4) + write(0x1011, 5, 0x64616F6C, 4),
}

CAN_TO_CYCLIC = {
    "cyclic_motion": write(0x60C2, 1, 10, 1) + OPERATIONAL + switch_on(8)
    + b"".join(write(0x607A, 0, 20 * step, 4) + later(60, frame(0x080)) for step in range(8)),
    "far_targets": OPERATIONAL + switch_on(8) + b"".join(write(0x607A, 0, target, 4) + later(60, frame(0x080)) for target in
                                                         (0x7FFFFFFF, 0x80000000, 0)),
}


# ---- serial_to_silverdust: whether it is observed, then lines, each behind the number of 0.5 ms to wait after it

def lines(*texts, ticks=60, observed=1):
    return bytes([observed]) + b"".join(bytes([ticks]) + text + b"\n" for text in texts)


SERIAL_TO_SILVERDUST = {
    "status": lines(b"@16 0", b"@16 20", b"@16 21", b"@16 27", b"@16 5", b"@16 105", b"@16 12 1", b"@16 12 1 2 3 4"),
    "worked_example": lines(b"@16 11 17 0", b"@16 11 19 1073742", b"@16 254", b"@16 25 4000 1073741824 1073742 536870912",
                            b"@16 25 3000 1073741824 1073742 1073741824", b"@16 25 0 92000 536871 536870912", b"@16 252", ticks=200),
    "moves": lines(b"@16 134 1000 100000 1000000 0 0", b"@16 135 -1000 100000 1000000 0 0", b"@16 3 0", b"@16 2", ticks=200),
    "wrong_numbers": lines(b"@16 11 1", b"@16 11 99999 1", b"@16 11 1 99999999999999999999", b"@16 12 -1", b"@16 -1", b"@16 1e5",
            b"@16 0x10"),
    "not_for_it": lines(b"@17 0", b"@255 0", b"@0 0", b"@", b"16 0", b"", b"@16", b"@ 16 0"),
    "long_line": lines(b"@16 " + b"1 " * 40),
    "unobserved": lines(b"@16 4", b"@16 163", b"@16 155 17", b"@16 0", observed=0),
}


# ---- goals, setpoints: numbers

E, C, S, ES = range(4)
(ZERO, MINUS_ZERO, ONE, MINUS_ONE, E_300, E_9, E9, E12, E18, E19, MINUS_E19, E150, E308, MOST, LEAST, DENORMAL, INFINITY, MINUS_INFINITY,
 NAN) = (bytes([38 + which]) for which in range(19))


def number(value):
    return bytes([64]) + int(round(1000 * value)).to_bytes(2, "little", signed=True)


POSITIONS, VELOCITIES, ACCELERATIONS = 0, 1, 2


def point(time, *values, what=POSITIONS):
    return number(time) + bytes([what]) + b"".join(values)


def goal(*points, what=0, besides=b""):
    return bytes([what]) + besides + bytes([len(points)]) + b"".join(points)


FAR = point(0.4, number(0.1))

KINDS = (("epos", E), ("cyclic", C), ("silverdust", S))

GOALS = {
    **{f"positions_{name}": bytes([arm]) + goal(FAR) for name, arm in KINDS},
    "two_kinds": bytes([ES]) + goal(point(0.4, number(0.1), number(-0.1))),
    "velocities": bytes([E])
    + goal(point(0.2, number(0.05), number(0.3), what=VELOCITIES), point(0.4, number(0.1), number(0), what=VELOCITIES)),
    "accelerations": bytes([C]) + goal(*(point(0.2 * i, number(0.05 * i), number(0.3 * (i < 2)), number(0), what=VELOCITIES | ACCELERATIONS)
                                        for i in (1, 2))),
    "replaced": bytes([E]) + goal(FAR) + goal(point(0.8, number(-0.1))) + goal(point(0.5, number(0))),
    **{f"years_{name}": bytes([arm]) + goal(E9 + bytes([POSITIONS]) + number(0.4)) for name, arm in KINDS},
    "stop": bytes([E]) + goal(FAR) + goal(),
    "not_numbers": bytes([E]) + goal(point(0.4, NAN)) + goal(point(0.4, INFINITY)) + goal(NAN + bytes([0]) + number(0.1)),
    "huge": bytes([E]) + goal(point(0.4, E308)) + goal(E18 + bytes([0]) + number(0.1))
    + goal(point(0.4, number(0.1), E150, what=VELOCITIES)),
    "tiny_times": bytes([E]) + goal(E_300 + bytes([0]) + number(0.1)) + goal(DENORMAL + bytes([0]) + number(0))
    + goal(E_9 + bytes([0]) + number(0)),
    "times_go_back": bytes([E]) + goal(point(0.4, number(0.1)), point(0.3, number(0.2))) + goal(point(-1, number(0))),
    "starts_later": bytes([E]) + goal(FAR, what=4, besides=number(0.2)),
    "started_before": bytes([E]) + goal(point(0.1, number(0)), point(0.6, number(0.1)), what=4, besides=number(-0.2)),
    "tolerances": bytes([E]) + goal(FAR, what=5, besides=bytes([3]) + number(0.001) + number(0) + number(-1)),
    "unknown_joint": bytes([E]) + goal(FAR, what=3, besides=b"joint\xff9!"),
    "beyond_limits": bytes([E]) + goal(point(0.4, number(5))) + goal(point(0.01, number(1))),
}

ALWAYS, BY_WRITE = b"\x01", b"\x00"


def setpoint(*values, what=0, ticks=9, how=ALWAYS):
    return how + bytes([what]) * (how == ALWAYS) + b"".join(values) + bytes([ticks])


SETPOINTS = {
    **{f"line_{name}": bytes([arm]) + b"".join(setpoint(number(0.002 * i)) for i in range(30))
       for name, arm in KINDS},
    "velocities": bytes([E]) + b"".join(setpoint(number(0.002 * i), number(0.1), what=2) for i in range(20)),
    "by_write": bytes([C]) + b"".join(setpoint(number(0.002 * i), how=BY_WRITE) for i in range(30)),
    "jump": bytes([E]) + setpoint(number(0)) * 5 + setpoint(number(3)) * 5 + setpoint(number(-3)) * 5,
    "not_numbers": bytes([E]) + setpoint(number(0)) * 5 + setpoint(NAN) + setpoint(INFINITY) + setpoint(E150)
    + setpoint(number(0), NAN, what=2),
    "times": bytes([E]) + b"".join(setpoint(number(offset), number(0), what=1) for offset in (0, -0.1, 0.4, -5, 5, 0.1, 0.1)),
    "two_sources": bytes([ES]) + setpoint(number(0), number(0)) * 3 + setpoint(number(0), number(0), what=0xC0),
    "pause": bytes([C]) + setpoint(number(0.01), ticks=63) + setpoint(number(0.02), ticks=63) + setpoint(number(0.03)),
}


def main():
    for name, seeds in {"can_to_driver": CAN_TO_DRIVER, "serial_to_driver": SERIAL_TO_DRIVER, "can_to_epos": {**CAN_TO_BOTH, **CAN_TO_EPOS},
                        "can_to_cyclic": {**CAN_TO_BOTH, **CAN_TO_CYCLIC}, "serial_to_silverdust": SERIAL_TO_SILVERDUST, "goals": GOALS,
                        "setpoints": SETPOINTS}.items():
        folder = SEEDS / name
        folder.mkdir(parents=True, exist_ok=True)
        for seed, content in seeds.items():
            (folder / seed).write_bytes(content)


if __name__ == "__main__":
    main()
