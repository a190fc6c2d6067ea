"""The programs as a user calls them. IMD_PROGRAMS is the folder they are in."""
import os
import socket
import subprocess
import sys
import time

import pytest

PROGRAMS = os.environ["IMD_PROGRAMS"]
# Far longer than anything takes on a loaded machine; no test waits for it to pass.
PATIENCE = 60.0


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class Result:
    def __init__(self, code, out, error, seconds):
        self.code, self.out, self.error, self.seconds = code, out, error, seconds


@pytest.fixture
def master_uri():
    """Of a master that does not run."""
    return f"http://127.0.0.1:{free_port()}"


@pytest.fixture
def run(tmp_path, master_uri):
    """Runs a program to its end, without a master of ROS."""

    def call(program, *arguments):
        environment = {**os.environ, "ROS_MASTER_URI": master_uri, "ROS_HOSTNAME": "localhost", "ROS_HOME": str(tmp_path)}
        environment.pop("ROS_IP", None)
        begin = time.monotonic()
        done = subprocess.run([os.path.join(PROGRAMS, program), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=PATIENCE, env=environment)
        return Result(done.returncode, done.stdout, done.stderr, time.monotonic() - begin)

    return call


class FakeDriver:
    """A node of the driver's name that serves its action, as of `delay` seconds from now, and succeeds at once."""

    def __init__(self, folder, master_uri, delay):
        self.log = folder / "goals"
        packages = os.path.join(PROGRAMS, os.pardir, "python3", "dist-packages")
        environment = {**os.environ, "ROS_MASTER_URI": master_uri, "ROS_HOSTNAME": "localhost", "ROS_HOME": str(folder),
                       "PYTHONPATH": packages + os.pathsep + os.environ.get("PYTHONPATH", "")}
        script = os.path.join(os.path.dirname(__file__), "fake_driver.py")
        self.process = subprocess.Popen([sys.executable, "-B", script, str(delay), str(self.log)], env=environment)

    def goals(self):
        return len(self.log.read_text().splitlines()) if self.log.exists() else 0

    def stop(self):
        self.process.terminate()
        self.process.wait()


@pytest.fixture
def fake_driver(tmp_path, master_uri):
    drivers = []

    def start(delay):
        drivers.append(FakeDriver(tmp_path, master_uri, delay))
        return drivers[-1]

    yield start
    for driver in drivers:
        driver.stop()


@pytest.fixture
def master(master_uri):
    """A master of ROS for the programs that `run` runs."""
    port = master_uri.rsplit(":", 1)[1]
    process = subprocess.Popen(["rosmaster", "--core", "-p", port], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               env={**os.environ, "ROS_MASTER_URI": master_uri, "ROS_HOSTNAME": "localhost"})
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            socket.create_connection(("127.0.0.1", int(port))).close()
            break
        except OSError:
            time.sleep(0.05)
    yield
    process.terminate()
    process.wait()
