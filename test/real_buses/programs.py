"""Programs that tests start beside each other: emulated drives, the driver, witnesses of a bus. Each has its output watched, so
that a test waits for what it says and not for a time."""
import os
import re
import signal
import subprocess
import threading

import yaml

# Far longer than anything takes on a loaded machine; no test waits for it to pass.
PATIENCE = 90.0


class Program:
    """A program, its output line by line, and its end."""

    def __init__(self, command, environment=None):
        self.name = os.path.basename(command[0])
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                         bufsize=1, env=environment)
        self._condition = threading.Condition()
        self._lines = []
        self._closed = False
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stdout:
            with self._condition:
                self._lines.append(line.rstrip('\n'))
                self._condition.notify_all()
        with self._condition:
            self._closed = True
            self._condition.notify_all()

    def output(self):
        with self._condition:
            return '\n'.join(self._lines)

    def mark(self):
        """Number of lines so far."""
        with self._condition:
            return len(self._lines)

    def wait_for(self, pattern, since=0, patience=PATIENCE):
        """The first line, of those from number `since` on, in which the pattern is found."""
        def find():
            return next((line for line in self._lines[since:] if re.search(pattern, line)), None)

        with self._condition:
            self._condition.wait_for(lambda: find() is not None or self._closed, patience)
            line = find()
        assert line is not None, '%s has not said "%s"; output:\n%s' % (self.name, pattern, self.output())
        return line

    def say(self, line, answer):
        """A line for its standard input; returns the line it answers, by which the pattern is found."""
        before = self.mark()
        self._process.stdin.write(line + '\n')
        self._process.stdin.flush()
        return self.wait_for(answer, before)

    def running(self):
        return self._process.poll() is None

    def send(self, number):
        """A signal."""
        self._process.send_signal(number)

    def end(self, number=signal.SIGTERM):
        """Its exit code."""
        if self.running():
            self.send(number)
        try:
            code = self._process.wait(PATIENCE)
        finally:
            self.kill()
        self._reader.join(PATIENCE)
        return code

    def kill(self):
        if self.running():
            self._process.kill()
            self._process.wait()


class Drives(Program):
    """The program emulated_drives; ready when it returns."""

    def __init__(self, program, arguments, interfaces=1):
        super().__init__([program, *arguments])
        for _ in range(interfaces):
            self.wait_for('^ready')

    def inject(self, target, command):
        answer = self.say(target + ' ' + command, '^(done|refused): ')
        assert answer == 'done: %s %s' % (target, command), answer


def buses_outside(configuration):
    """Names of the buses that lead out of the driver."""
    return [name for name, bus in configuration['buses'].items() if bus['transport'] in ('socketcan', 'serial')]


def load(path):
    with open(path) as file:
        return yaml.safe_load(file)


def save(configuration, path):
    with open(path, 'w') as file:
        yaml.safe_dump(configuration, file)
    return path
