"""What of a session is shown: which joints, from when to when, and where 0 s is."""
from dataclasses import dataclass

import style

BEFORE, AFTER = 0.3, 0.5            # s around a motion
FAULT_BEFORE, FAULT_AFTER = 1.5, 0.8  # s around a fault, where the file has them


@dataclass
class View:
    what: str      # motion, fault or bus
    origin: float  # of the session's clock, s, where the picture says 0
    begin: float   # s, in the picture's time, as all below
    end: float
    joints: list   # names
    colours: dict  # of all joints, so that each keeps its own in every picture

    def at(self, time):
        return time - self.origin

    def clip(self, times, *columns):
        """What of parallel lists is shown: times as the picture has them, and a sample on each side."""
        first = next((i for i, time in enumerate(times) if self.at(time) >= self.begin), len(times))
        last = next((i for i in range(len(times), 0, -1) if self.at(times[i - 1]) <= self.end), 0)
        part = slice(max(first - 1, 0), last + 1)
        return ([self.at(time) for time in times[part]], *(column[part] for column in columns))

    def has(self, time):
        return self.begin <= self.at(time) <= self.end


def what_of(session, wanted):
    if wanted != "auto":
        return wanted
    if session.faults():
        return "fault"
    return "motion" if any(joint.times or joint.worst_deviation is not None for joint in session.joints.values()) else "bus"


def view_of(session, options):
    what = what_of(session, options.show)
    first, last = session.span()
    begin = session.begin_of_motion()
    origin = begin if begin is not None else first
    low, high = first - origin, last - origin
    if what == "fault" and session.faults():
        origin = session.faults()[0][0]
        low, high = max(first - origin, -FAULT_BEFORE), min(last - origin, FAULT_AFTER)
    elif what == "motion" and begin is not None:
        end = session.end_of_motion()
        low, high = max(low, -BEFORE), min(high, (last if end is None else end) - origin + AFTER)
    joints = options.joints.split(",") if options.joints else list(session.joints)
    return View(what, origin, low if options.begin is None else options.begin, high if options.end is None else options.end, joints,
                style.colour_of(session.joints))
