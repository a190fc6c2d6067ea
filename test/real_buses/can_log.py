"""Frames as candump -L and the driver's wire log write them."""
import os
import re
import signal
import subprocess
import time

LINE = re.compile(r'\((\d+\.\d{6})\) (\S+) ([0-9A-F]{3}#\S*)$')
RECEIVE_BUFFER = 100000000  # bytes; a witness that loses frames is none


def frames(path):
    """ID#DATA of each line."""
    with open(path) as file:
        lines = [line for line in file.read().splitlines() if line]
    matches = [LINE.match(line) for line in lines]
    assert all(matches), [line for line, match in zip(lines, matches) if not match]
    return [match.group(3) for match in matches]


class Candump:
    """can-utils' candump, which sees what every socket of the interface sees."""

    def __init__(self, interface, path):
        self.path = path
        self._file = open(path, 'w')
        self._process = subprocess.Popen(['candump', '-L', '-r', str(RECEIVE_BUFFER), interface], stdout=self._file,
                                         stderr=subprocess.PIPE, text=True)

    def end(self):
        """Once it has taken all frames there were; returns what it has to say about errors."""
        while not self._waits() and self._process.poll() is None:
            time.sleep(0.05)
        self._process.send_signal(signal.SIGTERM)
        complaints = self._process.communicate(timeout=60)[1]
        self._file.close()
        return complaints

    def _waits(self):
        """Whether it sleeps: with a frame to read it would run, or be about to."""
        with open('/proc/%d/stat' % self._process.pid) as file:
            return file.read().rsplit(')', 1)[1].split()[0] == 'S'

    def kill(self):
        if self._process.poll() is None:
            self._process.kill()
            self._process.communicate()


def wait_for_socket(interface, count, patience=60.0):
    """Until so many sockets receive all frames of the interface."""
    path = '/proc/net/can/rcvlist_all'
    deadline = time.monotonic() + patience
    while True:
        with open(path) as file:
            seen = sum(line.split()[0] == interface for line in file.read().splitlines() if line.split())
        if seen >= count:
            return
        assert time.monotonic() < deadline, 'no socket on %s' % interface
        time.sleep(0.05)


def tshark(path, *arguments):
    environment = {**os.environ, 'HOME': os.path.dirname(path)}
    return subprocess.run(['tshark', '-n', '-r', path, '-d', 'can.subdissector,canopen', *arguments], env=environment, check=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True).stdout
