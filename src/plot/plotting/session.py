"""What the files tell of one motion, whatever kind of file it comes from. Times are s on one clock, that of the file."""
from dataclasses import dataclass, field

STANDSTILL = 1e-3  # rad/s or m/s


@dataclass
class Joint:
    """One joint over time; the lists are parallel. Positions are in `unit`."""
    unit: str = "rad"
    times: list = field(default_factory=list)
    desired: list = field(default_factory=list)
    desired_velocity: list = field(default_factory=list)
    actual: list = field(default_factory=list)
    actual_velocity: list = field(default_factory=list)
    buffer_times: list = field(default_factory=list)
    buffer: list = field(default_factory=list)   # s of motion in the drive
    states: list = field(default_factory=list)   # (time, text), at each change; "offline" if it does not answer
    deviation_bound: float = None                # counts
    worst_deviation: float = None                # counts; None: no report
    final_deviation: float = None
    latest: tuple = None

    def note_motion(self, time, desired, desired_velocity, actual, actual_velocity):
        """What a drive that is asked now and then has said before is no news while it moves: between two answers there is a line, no stair."""
        now = (desired, desired_velocity, actual, actual_velocity)
        if self.times and abs(actual_velocity) > STANDSTILL and now == self.latest:
            return
        self.latest = now
        self.times.append(time)
        self.desired.append(desired)
        self.desired_velocity.append(desired_velocity)
        self.actual.append(actual)
        self.actual_velocity.append(actual_velocity)

    def note_state(self, time, state):
        if not self.states or self.states[-1][1] != state:
            self.states.append((time, state))


@dataclass
class Goal:
    number: int
    time: float                # when it was answered
    refusal: str               # empty: accepted
    joint_names: list
    points: list               # (time_from_start, positions)
    end: float = None
    outcome: str = ""          # succeeded, preempted, aborted; empty: still under way
    text: str = ""
    start: float = None        # of goal time 0, where the file tells


@dataclass
class Setpoint:
    time: float                # when it came
    stamp: float               # of the message
    positions: dict            # by joint
    refusal: str               # empty: accepted


@dataclass
class Load:
    """Share of the time in which a bus carries bits, 0..1, by kind of traffic."""
    times: list = field(default_factory=list)    # centres of the bins
    by_kind: dict = field(default_factory=dict)  # kind: list, parallel to times
    limit: float = None                          # max_load of the configuration

    def total(self):
        return [sum(values) for values in zip(*self.by_kind.values())]


@dataclass
class Session:
    source: str = ""                             # the file, for the title
    joints: dict = field(default_factory=dict)
    goals: list = field(default_factory=list)
    setpoints: list = field(default_factory=list)
    groups: list = field(default_factory=list)   # (time, state, fault)
    log: list = field(default_factory=list)      # (time, severity, text)
    orders: list = field(default_factory=list)   # (time, text): what else was asked of the driver
    loads: dict = field(default_factory=dict)    # by bus
    horizon: float = None                        # s, commit_horizon

    def faults(self):
        return [(time, fault) for time, state, fault in self.groups if state == "fault"]

    def begin_of_motion(self):
        """Of the first goal or stream, or None. A group tells when it moves; a bag, that a desired velocity is not 0."""
        begins = [time for time, state, _ in self.groups if state in ("moving", "streaming")]
        for joint in () if begins else self.joints.values():
            begins += [time for time, velocity in zip(joint.times, joint.desired_velocity) if abs(velocity) > 1e-6][:1]
        return min(begins, default=None)

    def end_of_motion(self):
        ends = [goal.end for goal in self.goals if goal.end is not None]
        for joint in self.joints.values():
            ends += [time for time, velocity in zip(joint.times, joint.actual_velocity) if abs(velocity) > STANDSTILL][-1:]
        return max(ends, default=None)

    def span(self):
        times = [joint.times for joint in self.joints.values() if joint.times] + [load.times for load in self.loads.values() if load.times]
        return (min(each[0] for each in times), max(each[-1] for each in times)) if times else (0.0, 1.0)
