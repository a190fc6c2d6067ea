"""The command line of `plot`."""
import argparse
import os
import sys

import inputs

BAD_INPUT = 2

DESCRIPTION = """\
Shows what happened to the arm: a goal, a stream of setpoints, a fault, the load of a bus.

FILE is any of these, and several belong to one motion:
  a flight recording (~dump_recording, or written at a fault): all of it
  a bag of ~state, ~buffer_status and ~drive_states: position, velocity, error, buffers, states, load
  a wire log (parameter wire_log): the load of the buses
  a motion report (rosservice call DRIVER/motion_report > FILE): deviation of each joint"""

EPILOG = """\
Times are seconds from the begin of the first goal or stream of the file; of a fault, from the fault on.
Exit code: 0 drawn, 2 bad file or arguments, or python3-matplotlib is not installed."""


class BadArguments(Exception):
    """Told as the other programs tell it."""


class Formatter(argparse.RawDescriptionHelpFormatter):
    """Begins with the program's name, as the help of the other programs does."""

    def add_usage(self, usage, actions, groups, prefix=None):
        super().add_usage(usage, actions, groups, "")


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise BadArguments(message)


def parser():
    result = Parser(prog="plot", description=DESCRIPTION, epilog=EPILOG, formatter_class=Formatter,
                    allow_abbrev=False, usage="plot FILE [FILE ...] [--output PICTURE] [--show WHAT] [--from S] [--to S] [--joints NAME,...]")
    result.add_argument("files", nargs="+", metavar="FILE", help="see above")
    result.add_argument("-o", "--output", metavar="PICTURE", help="ends in .png, .svg or .pdf (default: the screen)")
    result.add_argument("--show", choices=("auto", "motion", "fault", "bus"), default="auto", metavar="WHAT",
                        help="motion, fault or bus (default: a fault if there is one, else the motion, else the buses)")
    result.add_argument("--from", dest="begin", type=float, metavar="S", help="s, first instant shown (default: a little before the motion)")
    result.add_argument("--to", dest="end", type=float, metavar="S", help="s, last instant shown (default: a little after the motion)")
    result.add_argument("--joints", metavar="NAME,...", help="only these (default: all)")
    result.add_argument("--title", metavar="TEXT", help="in place of the one that is made from the file")
    result.add_argument("--bitrate", type=float, default=1e6, metavar="BIT/S",
                        help="of CAN buses in a wire log, 10000..1000000 (default: 1000000); recordings know it")
    result.add_argument("--baud", type=float, default=57600, metavar="BIT/S",
                        help="of serial lines in a wire log, 1200..1000000 (default: 57600); recordings know it")
    return result


def check(options):
    if options.output and os.path.splitext(options.output)[1] not in (".png", ".svg", ".pdf"):
        raise BadArguments(f"--output {options.output}: a name that ends in .png, .svg or .pdf is wanted")
    for name, low in (("bitrate", 1e4), ("baud", 1200.0)):
        if not low <= getattr(options, name) <= 1e6:
            raise BadArguments(f"--{name} {getattr(options, name):g}: {low:.0f}..1000000 bit/s is allowed")
    if options.begin is not None and options.end is not None and options.begin >= options.end:
        raise BadArguments(f"--from {options.begin:g} is not before --to {options.end:g}")


def complain(text):
    print(f"plot: {text}", file=sys.stderr)
    return BAD_INPUT


def main(arguments):
    try:
        options = parser().parse_args(arguments)
        check(options)
    except BadArguments as error:
        return complain(f"{error}; plot --help lists what is allowed")
    try:
        draw(inputs.read_all(options.files, {"canopen": options.bitrate, "silverlode": options.baud}), options)
    except (inputs.BadInput, OSError) as error:
        return complain(error)
    return 0


def draw(session, options):
    try:
        import matplotlib
    except ImportError as error:
        raise inputs.BadInput("matplotlib is missing. On Debian and Ubuntu: apt install python3-matplotlib") from error
    if options.output:
        matplotlib.use("Agg")
    import figure
    figure.draw(session, options)
