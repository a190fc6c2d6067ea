"""The sentence above a picture: what happened, in figures."""


def headline(session, view):
    if view.what == "bus":
        return "Load of " + ", ".join(session.loads)
    if view.what == "fault" and session.faults():
        return session.faults()[0][1].split(". ")[0] or "Fault"
    if session.setpoints:
        return stream(session)
    if session.goals:
        return goals(session)
    return "Motion"


def goals(session):
    words = []
    for goal in session.goals:
        if goal.refusal:
            words.append(f"goal {goal.number} REJECTED")
        elif goal.outcome == "preempted" and "eplaced" in goal.text:
            words.append(f"goal {goal.number} replaced")
        else:
            words.append(f"goal {goal.number} " + (goal.outcome.upper() or "under way"))
    text = ", ".join(words)
    reasons = [goal.refusal or goal.text for goal in session.goals if goal.refusal or goal.outcome == "aborted"]
    if reasons:
        text += ": " + reasons[-1].split(". ")[0]
    return text[0].upper() + text[1:]


def stream(session):
    taken = [each for each in session.setpoints if not each.refusal]
    text = f"Stream of {len(taken)} setpoints"
    refused = len(session.setpoints) - len(taken)
    lost = missing(session.setpoints)
    if lost:
        text += f", {lost} lost on the way"
    return text + (f", {refused} refused" if refused else "")


def missing(setpoints):
    """Stamps that are left out of a row of equal steps."""
    stamps = sorted(each.stamp for each in setpoints)
    steps = [b - a for a, b in zip(stamps, stamps[1:]) if b - a > 1e-6]
    if not steps:
        return 0
    period = min(steps)
    return sum(round(step / period) - 1 for step in steps)


def figures(session, view):
    """What else is to be known, beside the headline."""
    parts = []
    shown = [session.joints[name] for name in view.joints]
    worst = max((joint.worst_deviation for joint in shown if joint.worst_deviation == joint.worst_deviation and joint.worst_deviation is not None),
                default=None)
    if worst is not None:
        bounds = {joint.deviation_bound for joint in shown} - {None}
        parts.append(f"worst deviation {worst:.2f}" + (f" of {bounds.pop():g}" if len(bounds) == 1 else "") + " counts")
    lowest = lowest_buffer(session, view)
    if lowest is not None and view.what == "motion":
        parts.append(f"buffers never below {lowest:.2f} s")
    for bus, load in session.loads.items():
        peak = max((share for time, share in zip(load.times, load.total()) if view.has(time)), default=None)
        if peak is not None:
            parts.append(f"{bus} at most {100 * peak:.0f} %")
    return "   ·   ".join(parts)


def lowest_buffer(session, view):
    """While the arm moves and the end of the motion is not in the drives yet: what follows does not drain them."""
    begin, end = session.begin_of_motion(), session.end_of_motion()
    if begin is None or end is None:
        return None
    margin = (session.horizon or 0.5) + 0.7
    return min((fill for name in view.joints for time, fill in zip(session.joints[name].buffer_times, session.joints[name].buffer)
                if begin + 0.2 <= time <= end - margin), default=None)
