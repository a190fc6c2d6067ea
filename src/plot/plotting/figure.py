"""Puts the panels of a view into one picture."""
import io
import textwrap
from dataclasses import dataclass

import headline
import matplotlib.pyplot as plt
import panels
import style
from problems import BadInput
from view import view_of

WIDTH = 9.0            # inches, as all below
LEFT, RIGHT = 0.78, 0.12
HEAD, FOOT = 0.74, 0.42
STRIP = 0.16           # for the states of the group
TITLE_LENGTH = 110     # characters in a line
GAP = 0.16             # between panels that share their axis of time
PNG_RESOLUTION = 110   # dots an inch


@dataclass
class Row:
    height: float
    paint: callable
    timed: bool = True   # shares the axis of time
    above: float = GAP   # room above


def rows_of(session, view):
    """From top to bottom."""
    rows = motion_rows(session, view) if view.what != "bus" else []
    for name in session.loads:
        rows.append(Row(1.2 if view.what != "bus" else 2.4, lambda axes, name=name: panels.bus(axes, session, view, name), above=GAP + 0.12))
    if view.what == "motion" and any(session.joints[name].worst_deviation is not None for name in view.joints):
        rows.append(Row(0.17 * len(view.joints) + 0.1, lambda axes: panels.deviation(axes, session, view), timed=False, above=0.52))
    log = panels.log_lines(session, view) if view.what == "fault" else []
    if log:
        rows.append(Row(0.17 * len(log), lambda axes: panels.log(axes, log), timed=False, above=0.5))
    return rows


def motion_rows(session, view):
    shown = [session.joints[name] for name in view.joints]
    rows = []
    if any(joint.times for joint in shown):
        above = GAP + (STRIP if session.groups else 0.0)
        rows += [Row(2.3, lambda axes: panels.position(axes, session, view), above=above), Row(1.3, lambda axes: panels.velocity(axes, session, view)),
                 Row(1.1, lambda axes: panels.error(axes, session, view))]
    if any(value > 0.0 for joint in shown for value in joint.buffer):
        rows.append(Row(1.1, lambda axes: panels.buffer(axes, session, view)))
    if view.what == "fault" and any(joint.states for joint in shown):
        rows.append(Row(0.19 * len(view.joints) + 0.1, lambda axes: panels.states(axes, session, view)))
    return rows


def draw(session, options):
    style.apply()
    view = view_of(session, options)
    for name in view.joints:
        if name not in session.joints:
            raise BadInput(f"--joints {name}: there are {', '.join(session.joints) or 'none'}")
    rows = rows_of(session, view)
    if not rows:
        raise BadInput(f"there is nothing to --show {view.what} in these files")
    figure = plt.figure(figsize=(WIDTH, sum(row.height + row.above for row in rows) + HEAD + FOOT))
    paint(figure, rows, session, view)
    write_head(figure, session, view, options)
    figure.align_ylabels()
    save(figure, options)


def paint(figure, rows, session, view):
    height = figure.get_size_inches()[1]
    top = height - HEAD
    first = last = None
    for row in rows:
        top -= row.above + row.height
        box = (LEFT / WIDTH, top / height, 1.0 - (LEFT + RIGHT) / WIDTH, row.height / height)
        axes = figure.add_axes(box, sharex=first if row.timed else None)
        row.paint(axes)
        if row.timed:
            panels.events(axes, session, view, labels=first is None)
            axes.set_xlim(view.begin, view.end)
            axes.tick_params(labelbottom=False)
            first, last = first or axes, axes
    if last:
        last.tick_params(labelbottom=True)
        last.set_xlabel("s after the fault" if view.what == "fault" else "s")


def write_head(figure, session, view, options):
    height = figure.get_size_inches()[1]
    left = 0.1 / WIDTH
    title = textwrap.shorten(options.title or headline.headline(session, view), 2 * TITLE_LENGTH, placeholder=" …")
    lines = textwrap.wrap(title, TITLE_LENGTH)
    figure.text(left, 1.0 - 0.12 / height, "\n".join(lines), fontsize=12 if len(lines) < 2 else 8.5, fontweight="bold", va="top",
                linespacing=1.1)
    figure.text(left, 1.0 - 0.38 / height, headline.figures(session, view), fontsize=9, color=style.FAINT, va="top")
    if view.what != "bus":
        panels.legend(figure, session, view, (0.02 / WIDTH, 1.0 - 0.58 / height))


def save(figure, options):
    if not options.output:
        plt.show()
    elif options.output.endswith(".png"):
        save_png(figure, options.output)
    else:
        figure.savefig(options.output, metadata={"Date": None} if options.output.endswith(".svg") else {"CreationDate": None})


def save_png(figure, path):
    """With a palette, in a third of the bytes; octrees keep rare colours, as of a line that is nearly covered."""
    from PIL import Image  # matplotlib needs it too
    whole = io.BytesIO()
    figure.savefig(whole, format="png", dpi=PNG_RESOLUTION)
    whole.seek(0)
    Image.open(whole).convert("RGB").quantize(256, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(path, optimize=True)
