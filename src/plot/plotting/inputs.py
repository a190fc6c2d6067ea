"""Files of every kind, told apart by what is in them, to one Session."""
import os

import bag
import recording
import report
import wire_log
from problems import BadInput
from session import Session

__all__ = ["BadInput", "read_all"]

LONGEST = 512 * 1024 * 1024  # bytes; a recording of 1024 MiB of memory is longer, and nobody looks at it at once


def kind_of(path):
    if not os.path.isfile(path):
        raise BadInput(f"{path} is no file" if os.path.exists(path) else f"{path} is not there")
    if os.path.getsize(path) > LONGEST:
        raise BadInput(f"{path} has {os.path.getsize(path) >> 20} MiB; {LONGEST >> 20} MiB are allowed")
    with open(path, "rb") as file:
        head = file.read(4096)
    for kind in (bag, recording, wire_log, report):
        if kind.is_one(head):
            return kind
    raise BadInput(f"{path} is neither a flight recording nor a bag, a wire log or a motion report; plot --help tells what these are")


def read_all(paths, rates):
    """`rates`: bit/s by type of bus, for files that do not tell."""
    session = Session()
    kinds = sorted(((kind_of(path), path) for path in paths), key=lambda pair: pair[0] is report)
    for kind, path in kinds:
        kind.read(path, session, rates)
        session.source = session.source or os.path.basename(path)
    if not session.joints and not session.loads:
        raise BadInput(f"{', '.join(paths)}: nothing to draw in it")
    return session
