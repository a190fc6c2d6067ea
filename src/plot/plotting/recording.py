"""Flight recordings, docs/recording.md."""
import re

import wire
import yaml
from problems import BadInput
from session import Goal, Joint, Setpoint

LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
BOUNDS = {"epos_ipm": 1.0, "silverlode_ims": 2.0}  # counts, docs/configuration.md: defaults of deviation_bound
CYCLIC_BOUND = 5.0
FAULT = re.compile(r"(\w+) -> (\w+)(?:: (.*))?$")


def is_one(head):
    return b"A recording of interpolated_motion_driver" in head or head.startswith(b"version: ")


def read(path, session, rates):
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = file.read().split("\n")
    if "---" not in lines:
        raise BadInput(f"{path}: the line --- that ends the head of a recording is missing")
    end = lines.index("---")
    head = yaml_of("\n".join(lines[:end]), f"{path}: head")
    if head.get("version") != 1:
        raise BadInput(f"{path}: version {head.get('version')} of recordings; this program reads version 1")
    Reader(head, session, rates).read(path, lines[end + 1:], end + 2)


def yaml_of(text, where):
    try:
        return yaml.load(text, LOADER)
    except yaml.YAMLError as error:
        raise BadInput(f"{where}: {' '.join(str(error).split())}") from error


class Reader:
    def __init__(self, head, session, rates):
        self.session = session
        self.configuration = head.get("configuration") or {}
        self.loads = wire.LoadCounter()
        session.horizon = self.configuration.get("commit_horizon", 0.5)
        drives = self.configuration.get("drives") or {}
        for name in head.get("joints") or []:
            limits = (head.get("limits") or {}).get(name, {})
            drive = drives.get(name, {})
            bound = drive.get("deviation_bound", BOUNDS.get(drive.get("type"), CYCLIC_BOUND))
            session.joints[name] = Joint(unit=limits.get("unit", "rad"), deviation_bound=bound)
        for name, bus in (self.configuration.get("buses") or {}).items():
            kind = bus.get("type", "canopen")
            rate = bus.get("bitrate" if kind == "canopen" else "baud", rates[kind])
            self.loads.add_bus(name, rate, bus.get("max_load", 0.6 if kind == "canopen" else 0.85))

    def read(self, path, lines, first):
        for number, line in enumerate(lines, first):
            if not line:
                continue
            try:
                time, verb, rest = line.split(" ", 2)
                getattr(self, "read_" + verb)(float(time), rest)
            except (ValueError, KeyError, IndexError, AttributeError, TypeError) as error:
                raise BadInput(f"{path}: line {number} is not as docs/recording.md tells: {line[:80]}") from error
        self.session.loads.update(self.loads.loads())

    def read_joint(self, time, text):
        name, *numbers = text.split()
        desired, desired_velocity, actual, actual_velocity, _ = map(float, numbers[:5])
        joint = self.session.joints[name]
        joint.note_motion(time, desired, desired_velocity, actual, actual_velocity)
        if len(numbers) > 5:
            joint.buffer_times.append(time)
            joint.buffer.append(float(numbers[5]))

    def read_wire(self, time, text):
        bus, direction, content = text.split(" ", 2)
        self.loads.add(time, bus, content, direction == "<")

    def read_group(self, time, text):
        _, state, fault = FAULT.match(text).groups()
        self.session.groups.append((time, state, fault or ""))

    def read_drive(self, time, text):
        name, rest = text.split(" ", 1)
        online, state, *_ = rest.split(", ")
        self.session.joints[name].note_state(time, state if online == "online" else "offline")

    def read_bus(self, time, text):
        pass

    def read_log(self, time, text):
        severity, content = text.split(": ", 1)
        self.session.log.append((time, severity, content))

    def read_end(self, time, text):
        what, number, outcome, *reason = text.replace(":", "", 1).split(" ", 3)
        for goal in self.session.goals:
            if what == "goal" and goal.number == int(number) and not goal.outcome:
                goal.end, goal.outcome, goal.text = time, outcome, "".join(reason)

    def read_order(self, time, text):
        verb, arguments = text.split(" ", 1)
        values = yaml_of(arguments, "an order")
        answer = str(values.get("answer", ""))
        refusal = answer[len("refused: "):] if answer.startswith("refused") else ""
        if verb == "goal":
            points = [(point["time_from_start"], point.get("positions") or []) for point in values.get("points") or []]
            self.session.goals.append(Goal(values.get("id", 0), time, refusal, values.get("joint_names") or [], points))
        elif verb == "setpoint":
            positions = dict(zip(values["joint_names"], values["positions"]))
            self.session.setpoints.append(Setpoint(time, values.get("time", time), positions, refusal))
        else:
            self.session.orders.append((time, verb + " " + ", ".join(str(values[key]) for key in ("target", "command") if key in values)))
