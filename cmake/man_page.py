"""A man page from what a program says with --help: man_page.py PROGRAM... > PAGE. One source for both, so that they cannot differ.

The help begins with the synopsis, whose further lines are indented or begin with the program's name as well; what follows up to "Options:" tells what the program does."""
import os
import subprocess
import sys

# What stands behind the name, in apropos.
PURPOSE = {"driver_node": "moves servo drives that interpolate by themselves along ROS trajectories",
           "trajectory_client": "sends a trajectory, or a stream of setpoints, to the driver",
           "emulated_drives": "servo drives for any master, on a CAN interface or a pseudo-terminal",
           "drive_tool": "sees and sets the drives of a bus, without ROS",
           "plot": "pictures of a motion, from recordings, bags, wire logs and reports"}
LAST = "\n".join([".SH SEE ALSO", "README.md and docs/ of the package interpolated_motion_driver.", ""])


def escaped(line):
    """As text, for troff: a backslash, a minus that may be copied, a dot or an apostrophe at the begin of a line."""
    text = line.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def verbatim(lines):
    return [".nf", *map(escaped, lines), ".fi"]


def page(name, text):
    lines = text.rstrip("\n").split("\n")
    end = next((i for i in range(1, len(lines)) if not lines[i].startswith((" ", name + " "))), len(lines))
    options = next((i for i in range(end, len(lines)) if lines[i].lower() in ("options:", "positional arguments:")), len(lines))
    out = [f'.TH {name.upper()} 1 "" interpolated_motion_driver "User Commands"', ".SH NAME", escaped(f"{name} - {PURPOSE[name]}"),
           ".SH SYNOPSIS", *verbatim(lines[:end]), ".SH DESCRIPTION", *verbatim(lines[end:options])]
    if options < len(lines):
        out += [".SH OPTIONS", *verbatim(lines[options:])]
    return "\n".join(out) + "\n" + LAST


def main(command):
    environment = {**os.environ, "COLUMNS": "90"}
    help_text = subprocess.run([*command, "--help"], stdout=subprocess.PIPE, text=True, check=True, env=environment).stdout
    sys.stdout.write(page(os.path.basename(command[-1]), help_text))


if __name__ == "__main__":
    main(sys.argv[1:])
