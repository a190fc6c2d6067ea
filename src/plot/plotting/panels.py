"""One function for each panel of a picture."""
import math
import textwrap

import style
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

LONGEST_LOG = 16    # lines below a fault
LOG_WIDTH = 140     # characters in each
LEAST_LOAD = 0.002  # of a kind of traffic that is shown


def units(session, view):
    """("rad", "m") as the joints have them, for the labels of axes."""
    return list(dict.fromkeys(session.joints[name].unit for name in view.joints))


def label(axes, quantity, session, view, suffix="", prefix=""):
    axes.set_ylabel(quantity + "\n" + ", ".join(prefix + unit + suffix for unit in units(session, view)))


def trace(axes, view, joint, name, times, *columns, styles):
    times, *columns = view.clip(times, *columns)
    for column, options in zip(columns, styles):
        axes.plot(times, column, color=view.colours[name], **options)
    return times, columns


DESIRED = {"linewidth": 3.0, "alpha": 0.28}
ACTUAL = {"linewidth": 1.1}


def position(axes, session, view):
    for name in view.joints:
        joint = session.joints[name]
        trace(axes, view, joint, name, joint.times, joint.desired, joint.actual, styles=(DESIRED, ACTUAL))
        for refused, options in ((False, {"marker": ".", "markersize": 4}), (True, {"marker": "x", "markersize": 5})):
            points = [(view.at(each.stamp), each.positions[name]) for each in session.setpoints
                      if name in each.positions and bool(each.refusal) == refused and view.has(each.stamp)]
            if points:
                axes.plot(*zip(*points), linestyle="none", color=view.colours[name], alpha=0.8, markeredgewidth=0.8 if refused else 0.0, **options)
    label(axes, "position", session, view)


def velocity(axes, session, view):
    for name in view.joints:
        joint = session.joints[name]
        trace(axes, view, joint, name, joint.times, joint.desired_velocity, joint.actual_velocity, styles=(DESIRED, ACTUAL))
    label(axes, "velocity", session, view, "/s")


def error(axes, session, view):
    for name in view.joints:
        joint = session.joints[name]
        errors = [1e3 * (desired - actual) for desired, actual in zip(joint.desired, joint.actual)]
        trace(axes, view, joint, name, joint.times, errors, styles=(ACTUAL,))
    label(axes, "following error", session, view, prefix="m")


def buffer(axes, session, view):
    for name in view.joints:
        joint = session.joints[name]
        trace(axes, view, joint, name, joint.buffer_times, joint.buffer, styles=(ACTUAL,))
    most = max((fill for name in view.joints for fill in session.joints[name].buffer), default=0.0)
    if session.horizon and view.what == "motion" and most >= session.horizon:  # not in streams, nor of cyclic drives
        rule(axes, session.horizon, "commit_horizon")
    axes.set_ylim(bottom=0.0)
    axes.set_ylabel("motion in\nbuffer  s")


def rule(axes, value, text, colour=style.FAINT):
    axes.axhline(value, color=colour, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.annotate(text, (1.0, value), xycoords=("axes fraction", "data"), xytext=(-3, 2), textcoords="offset points", ha="right", va="bottom",
                  fontsize=7, color=colour)


def bus(axes, session, view, name):
    load = session.loads[name]
    kinds = [kind for kind in sorted(load.by_kind, key=lambda kind: -sum(load.by_kind[kind]))
             if max(view.clip(load.times, load.by_kind[kind])[1], default=0.0) > LEAST_LOAD]
    clipped = view.clip(load.times, *(load.by_kind[kind] for kind in kinds))
    columns = [[100.0 * share for share in column] for column in clipped[1:]]
    if kinds:
        axes.stackplot(clipped[0], *columns, colors=[style.KINDS.get(kind, style.FAINT) for kind in kinds], alpha=0.75, linewidth=0.0,
                       labels=kinds)
    top = max((sum(column) for column in zip(*columns)), default=1.0)
    if load.limit:
        rule(axes, 100.0 * load.limit, "max_load")
        top = max(top, 100.0 * load.limit)
    axes.set_ylim(0.0, 1.15 * top)
    axes.set_ylabel(f"load of\n{name}  %")
    if kinds and kinds != ["all"]:
        axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.98), ncol=len(kinds), fontsize=7, borderaxespad=0.1, columnspacing=1.0,
                    handlelength=0.8)


def states(axes, session, view):
    for row, name in enumerate(view.joints):
        changes = session.joints[name].states
        ends = [time for time, _ in changes[1:]] + [view.origin + view.end]
        for (begin, state), end in zip(changes, ends):
            low, high = max(view.at(begin), view.begin), min(view.at(end), view.end)
            if high <= low:
                continue
            axes.barh(row, high - low, left=low, height=0.72, color=style.DRIVE.get(state, style.OTHER_STATE), linewidth=0)
            if high - low > 0.16 * (view.end - view.begin):
                axes.text(low + 0.006 * (view.end - view.begin), row, state, va="center", fontsize=7,
                          color="white" if state == "offline" else style.INK)
    axes.set_yticks(range(len(view.joints)), view.joints, fontsize=7)
    for tick, name in zip(axes.get_yticklabels(), view.joints):
        tick.set_color(view.colours[name])
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.set_ylabel("drives")


def deviation(axes, session, view):
    """Bars against the bound: all the drive's samples, not those of the picture alone."""
    names = view.joints
    unknown = []
    for row, name in enumerate(names):
        joint = session.joints[name]
        if joint.worst_deviation is None or math.isnan(joint.worst_deviation):
            unknown.append(row)
            continue
        axes.barh(row, joint.worst_deviation, height=0.55, color=view.colours[name], alpha=0.35)
        axes.plot(joint.final_deviation, row, "|", color=view.colours[name], markersize=8, markeredgewidth=2)
        axes.text(0.0, row, f" {joint.worst_deviation:.2f}", va="center", fontsize=7)
    for row, name in enumerate(names):
        bound = session.joints[name].deviation_bound
        if bound:
            axes.plot([bound, bound], [row - 0.45, row + 0.45], color=style.ALARM, linewidth=1.4)
    for row in unknown:
        axes.text(0.0, row, " not known: a real drive does not tell each sample", va="center", fontsize=7, color=style.FAINT)
    axes.set_yticks(range(len(names)), names, fontsize=7)
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    right = max([session.joints[name].worst_deviation or 0.0 for name in names] + [session.joints[name].deviation_bound or 0.0 for name in names])
    axes.set_xlim(0.0, 1.06 * right if right > 0.0 else 1.0)
    axes.set_xlabel("deviation of the drive's demand from the goal, counts: bar the worst, tick the last, red the bound")


def events(axes, session, view, labels):
    """Where goals come and end, and faults; above the first panel what the group does."""
    right, row = -math.inf, 0  # of the label before: one that has no room beside it goes below
    for time, text, colour in sorted(event_list(session)):
        if not view.has(time):
            continue
        axes.axvline(view.at(time), color=colour, linewidth=0.9, alpha=0.8, zorder=1.5)
        if labels and text:
            row = row + 1 if view.at(time) < right else 0
            right = view.at(time) + 0.01 * len(text) * (view.end - view.begin)
            axes.annotate(text, (view.at(time), 0.985), xycoords=("data", "axes fraction"), xytext=(3, -9 * row), textcoords="offset points",
                          va="top", fontsize=7, color=colour)
    if labels:
        group_strip(axes, session, view)


def event_list(session):
    result = []
    for goal in session.goals:
        if goal.refusal:
            result.append((goal.time, f"goal {goal.number} refused" if goal.number else "goal refused", style.ALARM))
        else:
            result.append((goal.time, f"goal {goal.number}", style.FAINT))
        if goal.end is not None and goal.outcome == "succeeded":
            result.append((goal.end, "", style.FAINT))
    result += [(time, text, style.ALARM if text.startswith("inject") else style.FAINT) for time, text in session.orders
               if not text.startswith("absence")]
    return result + [(time, "fault", style.ALARM) for time, _ in session.faults()]


def group_strip(axes, session, view):
    """States of the group, as a strip above the first panel."""
    changes = session.groups
    ends = [time for time, _, _ in changes[1:]] + [view.origin + view.end]
    transform = axes.get_xaxis_transform()
    for (begin, state, _), end in zip(changes, ends):
        low, high = max(view.at(begin), view.begin), min(view.at(end), view.end)
        if high <= low:
            continue
        axes.add_artist(Rectangle((low, 1.02), high - low, 0.065, transform=transform, color=style.GROUP.get(state, style.OTHER_STATE),
                                  linewidth=0, clip_on=False))
        if high - low > 0.012 * len(state) * (view.end - view.begin):
            axes.text((low + high) / 2.0, 1.05, state, transform=transform, ha="center", va="center", fontsize=7)


def legend(figure, session, view, place):
    handles = [Line2D([], [], color=view.colours[name], label=name, linewidth=2.2) for name in view.joints]
    if any(session.joints[name].times for name in view.joints):
        handles += [Line2D([], [], color=style.INK, label="desired", **DESIRED), Line2D([], [], color=style.INK, label="actual", **ACTUAL)]
    if session.setpoints:
        handles.append(Line2D([], [], color=style.INK, marker=".", linestyle="none", label="setpoint"))
        if any(each.refusal for each in session.setpoints):
            handles.append(Line2D([], [], color=style.INK, marker="x", markersize=5, linestyle="none", label="refused setpoint"))
    figure.legend(handles=handles, loc="upper left", bbox_to_anchor=place, ncol=len(handles), fontsize=8, columnspacing=1.2, handletextpad=0.5,
                  borderaxespad=0.2)


def log_lines(session, view):
    """What was logged and ordered around a fault, in the picture's time: (time or None in a line that goes on, is grave, text)."""
    entries = [(time, severity == "error", text) for time, severity, text in session.log if severity != "debug" and view.has(time)]
    entries += [(time, True, text) for time, text in session.orders if view.has(time)]
    lines = []
    for time, grave, text in sorted(entries):
        for i, part in enumerate(textwrap.wrap(text, LOG_WIDTH)):
            lines.append((view.at(time) if i == 0 else None, grave, part))
    return lines[:LONGEST_LOG]


def log(axes, lines):
    axes.axis("off")
    axes.set_ylim(len(lines), 0)
    axes.set_xlim(0, 1)
    for row, (time, grave, text) in enumerate(lines):
        if time is not None:
            axes.text(0.0, row + 0.5, f"{time:+.3f} s", fontsize=7, family="DejaVu Sans Mono", color=style.FAINT, va="center")
        axes.text(0.085, row + 0.5, text, fontsize=7, color=style.ALARM if grave else style.INK, va="center")
