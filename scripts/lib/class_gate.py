"""The gate on the size of classes: none in include/ and src/ may be larger than it, but for those of large_classes.txt."""

import sys
from pathlib import Path

from class_sizes import sizes_of_text
from cpp_tokens import Unreadable

MOST_FUNCTIONS = 40
MOST_MEMBERS = 20
PROJECT_NAMESPACE = "interpolated_motion::"
SHOWN = 15


def is_within_gate(size):
    return size.functions <= MOST_FUNCTIONS and size.members <= MOST_MEMBERS


def share_of_gate(size):
    return max(size.functions / MOST_FUNCTIONS, size.members / MOST_MEMBERS)


def sizes_of_tree(root):
    """(sizes of all classes in include/ and src/, complaints about files that cannot be read)"""
    sizes, complaints = [], []
    for folder in ("include", "src"):
        for path in sorted(path for path in (root / folder).rglob("*") if path.suffix in (".h", ".hpp", ".cpp")):
            name = path.relative_to(root)
            try:
                found = sizes_of_text(path.read_text())
            except Unreadable as error:
                complaints.append(f"{name}:{error.line}: not understood: {error}")
                continue
            for size in found:
                size.name = size.name.replace(PROJECT_NAMESPACE, "", 1)
                size.path = str(name)
            sizes += found
    return sizes, complaints


def read_exceptions(text):
    """{class: (functions, members)} from lines CLASS FUNCTIONS MEMBERS; `#` begins a comment."""
    exceptions = {}
    for line in text.splitlines():
        words = line.split("#", 1)[0].split()
        if words:
            name, functions, members = words
            exceptions[name] = (int(functions), int(members))
    return exceptions


def complaints_about(sizes, exceptions):
    """One sentence for each class beyond the gate or its exception, and for each exception that is larger than its class."""
    complaints = []
    largest = {}
    for size in sizes:
        allowed = exceptions.get(size.name, (0, 0))
        if size.functions > max(allowed[0], MOST_FUNCTIONS) or size.members > max(allowed[1], MOST_MEMBERS):
            complaints.append(
                f"{size.path}:{size.line}: {size.name} has {size.functions} functions and {size.members} data members; at most "
                f"{max(allowed[0], MOST_FUNCTIONS)} and {max(allowed[1], MOST_MEMBERS)} are allowed: cut it")
        known = largest.get(size.name)
        if known is None or share_of_gate(size) > share_of_gate(known):
            largest[size.name] = size
    for name, allowed in exceptions.items():
        complaints += stale_exception(name, allowed, largest.get(name))
    return complaints


def stale_exception(name, allowed, size):
    if size is None:
        return [f"large_classes.txt: {name} is gone: remove its line"]
    if is_within_gate(size):
        return [f"large_classes.txt: {name} is within the gate now ({size.functions} {size.members}): remove its line"]
    if size.functions < allowed[0] or size.members < allowed[1]:
        now = f"{min(size.functions, allowed[0])} {min(size.members, allowed[1])}"
        return [f"large_classes.txt: {name} is smaller now: lower {allowed[0]} {allowed[1]} to {now}"]
    return []


def print_largest(sizes, out):
    ranked = sorted(sizes, key=lambda size: (-share_of_gate(size), size.name))
    print(f"{'functions':>9} {'members':>7}  class", file=out)
    for size in ranked[:SHOWN]:
        print(f"{size.functions:9} {size.members:7}  {size.name}  ({size.path}:{size.line})", file=out)


def check(root, out=sys.stdout):
    """Prints the largest classes of the tree at `root` and what is wrong; returns whether nothing is."""
    sizes, complaints = sizes_of_tree(root)
    complaints += complaints_about(sizes, read_exceptions((root / "scripts" / "lib" / "large_classes.txt").read_text()))
    print_largest(sizes, out)
    for complaint in complaints:
        print(complaint, file=out)
    print(f"classes: {len(sizes)}, at most {MOST_FUNCTIONS} functions and {MOST_MEMBERS} data members each", file=out)
    return bool(sizes) and not complaints


if __name__ == "__main__":
    sys.exit(0 if check(Path(sys.argv[1])) else 1)
