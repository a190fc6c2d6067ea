#!/usr/bin/python3
"""How long a call of ~halt takes until its frames are on the wire, whatever else the node is doing:

    scripts/build driver_node emulated_drives
    scripts/with_vcan --timeout 3600 bench/halt_latency.py [--calls N] [--realtime-priority N] [--config FILE] [LOAD ...]

Six EPOS2 drives of the program emulated_drives on vcan0, the driver as it is started by anybody, and a client that keeps its connection
to ~halt (which asks the ROS master once). Each call is made in motion. Measured is from just before the call to the controlword with the
halt bit of the last of the six drives, and to the SYNC with which they obey; the kernel has stamped both. Wall time: figures of a machine
that does nothing else are better than others.
"""
import argparse
import ctypes
import os
import random
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..')
sys.path[:0] = [os.path.join(ROOT, 'test', folder) for folder in ('real_buses', 'node')]
sys.dont_write_bytecode = True

PACKAGE = 'interpolated_motion_driver'
NODE = '/halt_arm'
INTERFACE = 'vcan0'
TARGET = 0.020  # s, from the call to the frames
LOADS = {
    'none': 'nothing else',
    'large_goals': 'goals of 20000 points, one after the other',
    'commands': '2000 commands a second that are refused',
    'services': 'four clients that call ~query_state, ~reset_faults, ~enable, ~motion_report without pause',
    'master': 'the ROS master hangs (SIGSTOP)',
    'full_disk': 'output, log folder and wire log on a full disk, 2000 refused commands a second',
    'together': 'commands, services, master and full_disk together',
}


# ---- the wire

class StopWatch:
    """The frames of a stop, with the times at which the kernel took them."""

    SYNC = 0x080
    CONTROLWORD = 0x300  # RPDO 2, plus the node id
    HALT = 0x0100  # bit 8
    SO_TIMESTAMPNS = 35

    def __init__(self, nodes):
        self.nodes = nodes
        self._socket = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        wanted = [self.SYNC] + [self.CONTROLWORD + node for node in nodes]
        self._socket.setsockopt(socket.SOL_CAN_RAW, socket.CAN_RAW_FILTER, b''.join(struct.pack('=II', i, 0xC00007FF) for i in wanted))
        self._socket.setsockopt(socket.SOL_SOCKET, self.SO_TIMESTAMPNS, 1)
        self._socket.bind((INTERFACE,))
        self._socket.setblocking(False)

    def frames(self):
        """(time, id, data) of all that have come since."""
        while True:
            try:
                frame, ancillary, _, _ = self._socket.recvmsg(16, 64)
            except BlockingIOError:
                return
            seconds, nanoseconds = struct.unpack('qq', ancillary[0][2][:16])
            identifier, length, data = struct.unpack('=IB3x8s', frame)
            yield seconds + 1e-9 * nanoseconds, identifier & 0x7FF, data[:length]

    def forget(self):
        for _ in self.frames():
            pass

    def stop(self, since):
        """(time of the last drive's halt, time of the SYNC after it), or None where not all drives have been told since."""
        told = {}
        for when, identifier, data in self.frames():
            node = identifier - self.CONTROLWORD
            if when < since:
                continue
            if node in self.nodes and struct.unpack_from('<H', data)[0] & self.HALT:
                told.setdefault(node, when)
            elif identifier == self.SYNC and len(told) == len(self.nodes):
                return max(told.values()), when
        return None


# ---- the loads; each runs in a process of its own

def seconds(value):
    import rospy
    return rospy.Duration.from_sec(value)


def trajectory(points):
    """Of (time, position of all joints)."""
    from goal_files import JOINTS
    from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint
    return JointTrajectory(joint_names=list(JOINTS), points=[
        JointTrajectoryPoint(positions=[position] * len(JOINTS), velocities=[velocity] * len(JOINTS), time_from_start=seconds(when))
        for when, position, velocity in points])


def large_goal():
    """20000 points over 200 s, ten times from rest at 0 to 0.2 rad and back."""
    import math
    count, swing = 20000, 0.1
    rate = 2.0 * math.pi * 10 / (count - 1)  # rad per point
    return trajectory([(1.0 + 0.01 * k, swing * (1.0 - math.cos(rate * k)), swing * rate / 0.01 * math.sin(rate * k))
                       for k in range(count)])


def publish(messages, rate):
    """In turn, `rate` a second, in pieces of a few milliseconds."""
    import rospy
    publisher = rospy.Publisher(NODE + '/command', messages[0].__class__, queue_size=10)
    begin, sent = time.monotonic(), 0
    while True:
        due = int((time.monotonic() - begin) * rate)
        while sent < due:
            publisher.publish(messages[sent % len(messages)])
            sent += 1
        time.sleep(max(0.002, 1.0 / rate))


def publish_refused_commands():
    refused = trajectory([(1.0, 0.1, 0.0)])
    refused.joint_names[0] = 'no_such_joint'
    publish([refused], 2000.0)


def call_services():
    import rospy
    from control_msgs.srv import QueryTrajectoryState
    from interpolated_motion_driver.srv import GetMotionReport
    from std_srvs.srv import SetBool, Trigger

    def call(name, kind, *arguments):
        service = rospy.ServiceProxy(NODE + '/' + name, kind, persistent=True)
        while True:
            try:
                service(*arguments)
            except rospy.ServiceException:
                time.sleep(0.001)

    for arguments in (('query_state', QueryTrajectoryState, rospy.Time()), ('reset_faults', Trigger), ('enable', SetBool, True),
                      ('motion_report', GetMotionReport)):
        threading.Thread(target=call, args=arguments, daemon=True).start()
    rospy.spin()


GENERATORS = {
    'large_goals': lambda: publish([large_goal()], 0.2),  # each is taken up at once, and is fast enough after 3.2 s
    'commands': publish_refused_commands,
    'services': call_services,
}
OF_LOAD = {'full_disk': ['commands'], 'together': ['commands', 'services']}
FULL_DISK = ('full_disk', 'together')
DEAD_MASTER = ('master', 'together')
MOVES = ('large_goals',)  # loads whose goals move the arm


def generate(name):
    import rospy
    # Ends with the program that measures.
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)
    rospy.init_node('load_' + name)
    GENERATORS[name]()


# ---- one load, measured

class Arm:
    """ROS master, drives and driver, as programs of their own."""

    def __init__(self, options, full_disk):
        from conftest import free_port
        from programs import Drives, Program, load, save
        self.folder = tempfile.mkdtemp(prefix='halt_latency_')
        self.disk = os.path.join(self.folder, 'disk')
        os.mkdir(self.disk)
        if full_disk:
            subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=512k', 'tmpfs', self.disk], check=True)
        os.environ['ROS_MASTER_URI'] = 'http://localhost:%d' % free_port()
        os.environ['ROS_HOSTNAME'] = 'localhost'
        os.environ['ROS_HOME'] = os.environ['ROS_LOG_DIR'] = self.disk
        self.master = Program(['rosmaster', '--core', '-p', os.environ['ROS_MASTER_URI'].rsplit(':', 1)[1]])
        self.wait_for_master()
        configuration = load(options.config)
        configuration['bring_up_timeout'] = 60.0
        for bus in configuration['buses'].values():
            bus.update(heartbeat_timeout=5.0, sdo_timeout=1.0)
        file = save(configuration, os.path.join(self.folder, 'arm.yaml'))
        self.drives = Drives(program('emulated_drives'), ['--config', file])
        self.start_driver(configuration, options, full_disk)

    def wait_for_master(self):
        import rosgraph
        end = time.monotonic() + 90.0
        while not rosgraph.is_master_online():
            assert self.master.running() and time.monotonic() < end, self.master.output()
            time.sleep(0.1)

    def start_driver(self, configuration, options, full_disk):
        import rospy
        rospy.init_node('halt_latency', disable_signals=True)
        if full_disk:
            configuration['wire_log'] = os.path.join(self.disk, 'wire.log')
        if options.realtime_priority:
            configuration['realtime_priority'] = options.realtime_priority
        rospy.set_param(NODE, configuration)
        with open(os.path.join(self.disk, 'driver.log'), 'w') as output:
            self.driver = subprocess.Popen([program('driver_node'), '__name:=' + NODE[1:]], stdout=output, stderr=output)

    def fill_disk(self):
        with open(os.path.join(self.disk, 'filler'), 'wb', buffering=0) as file:
            try:
                while True:
                    file.write(bytes(4096))
            except OSError:
                pass

    def output(self):
        with open(os.path.join(self.disk, 'driver.log'), errors='replace') as file:
            return file.read()

    def end(self):
        self.driver.kill()
        self.driver.wait()
        self.drives.kill()
        self.master.kill()
        subprocess.run(['umount', self.disk], stderr=subprocess.DEVNULL, check=False)
        shutil.rmtree(self.folder, ignore_errors=True)


def program(name):
    import roslib.packages
    return roslib.packages.find_node(PACKAGE, name)[0]


class Measurement:
    """Calls of ~halt in motion, and their latencies in s."""

    def __init__(self, load):
        import rospy
        from driver_client import Driver
        from std_srvs.srv import Trigger
        self.moves_itself = load in MOVES
        self.driver = Driver(NODE)
        self.halt = rospy.ServiceProxy(NODE + '/halt', Trigger, persistent=True)
        self.halt()
        self.watch = StopWatch(range(1, 7))
        self.to_frames, self.to_sync = [], []
        self.refused = 0

    def call(self):
        """False where the arm was about to stop by itself, so nothing was to be told."""
        from control_msgs.msg import FollowJointTrajectoryGoal
        if not self.moves_itself:
            there = self.driver.state.next().actual.positions[0]
            self.driver.action.send(FollowJointTrajectoryGoal(trajectory=trajectory([(1.5, -0.4 if there > 0.0 else 0.4, 0.0)])))
        self.driver.state.wait_for(lambda m: max(abs(v) for v in m.actual.velocities) > 0.02, 'motion')
        time.sleep(random.uniform(0.0, 0.1))
        self.watch.forget()
        begin = time.clock_gettime(time.CLOCK_REALTIME)
        answer = self.halt()
        self.refused += not answer.success
        stop = self.watch.stop(begin)
        if stop is None:
            return False
        self.to_frames.append(stop[0] - begin)
        self.to_sync.append(stop[1] - begin)
        return True

    def row(self, load):
        def at(values, share):
            ordered = sorted(values)
            return 1e3 * ordered[min(len(ordered) - 1, int(share * len(ordered)))]

        figures = [at(self.to_frames, 0.5), at(self.to_frames, 0.99), at(self.to_frames, 0.999), at(self.to_sync, 1.0)]
        over = sum(latency > TARGET for latency in self.to_frames)
        return '| %s | %d | %s | %d |' % (LOADS[load], len(self.to_frames), ' | '.join('%.1f' % f for f in figures), over)


def start_generators(load):
    names = OF_LOAD.get(load, [load] if load in GENERATORS else [])
    environment = {**os.environ, 'ROS_LOG_DIR': tempfile.gettempdir()}  # a disk that is full is the driver's alone
    return [subprocess.Popen([sys.executable, os.path.abspath(__file__), '--generate', name], env=environment) for name in names]


def measure(options, load):
    """Prints the row of one load."""
    arm = Arm(options, load in FULL_DISK)
    generators = []
    try:
        measurement = Measurement(load)
        generators = start_generators(load)
        time.sleep(5.0 if generators else 0.0)
        if load in FULL_DISK:
            arm.fill_disk()
        if load in DEAD_MASTER:
            arm.master.send(signal.SIGSTOP)
        tries = 0
        while len(measurement.to_frames) < options.calls and tries < 3 * options.calls:
            tries += 1
            measurement.call()
        print(measurement.row(load), flush=True)
        if options.verbose:
            print('tried %d, refused %d\n%s' % (tries, measurement.refused, arm.output()[-3000:]), file=sys.stderr)
    except BaseException:
        print(arm.output()[-3000:], file=sys.stderr)
        raise
    finally:
        for generator in generators:
            generator.kill()
        arm.end()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('loads', metavar='LOAD', nargs='*', help='of ' + ', '.join(LOADS) + '; default: all')
    parser.add_argument('--calls', type=int, default=1000, help='of each load (default: 1000)')
    parser.add_argument('--realtime-priority', type=int, default=0, help='of the bus thread (default: 0, none)')
    parser.add_argument('--config', default=os.path.join(ROOT, 'config', 'six_axis_epos_socketcan.yaml'))
    parser.add_argument('--verbose', action='store_true', help='shows the end of the driver\'s output')
    parser.add_argument('--row', choices=LOADS, help=argparse.SUPPRESS)
    parser.add_argument('--generate', choices=GENERATORS, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.generate:
        return generate(options.generate)
    if options.row:
        return measure(options, options.row)
    if not set(options.loads) <= set(LOADS):
        parser.error('a LOAD is one of ' + ', '.join(LOADS))
    print('| load | calls | frames: p50, ms | p99 | p99.9 | SYNC: max | over %.0f ms |\n|---|---|---|---|---|---|---|' % (1e3 * TARGET),
          flush=True)
    passed = [argument for argument in sys.argv[1:] if argument not in LOADS]
    for load in options.loads or LOADS:
        subprocess.run([sys.executable, os.path.abspath(__file__), '--row', load, *passed], check=False)


if __name__ == '__main__':
    main()
