"""The driver and its drives in two programs with real buses between them, under what test/node/any_drives.py does to an arm."""
import os
import shutil
import sys
import tempfile
import time

import roslib.packages
import rospkg
import rospy
from actionlib_msgs.msg import GoalStatus

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, '..', 'node')]
from any_drives import AnyDrives  # noqa: E402
from driver_client import PATIENCE, Driver, goal, point  # noqa: E402
from goal_files import JOINTS  # noqa: E402
from programs import Drives, Program, buses_outside, load, save  # noqa: E402

PACKAGE = 'interpolated_motion_driver'


def program(name):
    return roslib.packages.find_node(PACKAGE, name)[0]


class RealArm(AnyDrives):
    """`configuration_file` of config/ says which arm. Each class starts its programs once, and ends them."""
    configuration_file = None
    node = None  # name of the driver

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix='real_arm_')
        cls.wire_log = os.path.join(cls.folder, 'wire.log')
        cls.driver_program = cls.drives = None
        try:
            cls.start()
        except BaseException:
            cls.tearDownClass()
            raise

    @classmethod
    def start(cls):
        cls.configuration = cls.adapt(load(os.path.join(rospkg.RosPack().get_path(PACKAGE), 'config', cls.configuration_file)))
        cls.samples = os.path.join(cls.folder, 'samples')
        os.mkdir(cls.samples)
        file = save(cls.configuration, os.path.join(cls.folder, 'arm.yaml'))
        buses = len(buses_outside(cls.configuration))
        cls.drives = Drives(program('emulated_drives'), ['--config', file, '--samples', cls.samples], buses)
        cls.start_driver()

    @classmethod
    def start_driver(cls):
        rospy.set_param('/' + cls.node, {**cls.configuration, 'wire_log': cls.wire_log, 'emulated_samples': cls.samples})
        cls.driver_program = Program([program('driver_node'), '__name:=' + cls.node])
        cls.driver = Driver('/' + cls.node)

    @classmethod
    def adapt(cls, configuration):
        """The configuration of a test: lines in a folder of its own, so that nothing else uses them, and patience with a loaded
        machine."""
        configuration.update(bring_up_timeout=60.0, commit_horizon=2.0)
        for name in buses_outside(configuration):
            bus = configuration['buses'][name]
            if bus['transport'] == 'serial':
                bus.update(device=os.path.join(cls.folder, name), reply_timeout=0.5)
            else:
                bus.update(heartbeat_timeout=2.0, sdo_timeout=1.0)
        return configuration

    @classmethod
    def tearDownClass(cls):
        try:
            code = cls.end_driver()
            assert code == 0, 'the driver ended with %s:\n%s' % (code, cls.driver_program.output())
            if cls.drives is not None:
                code = cls.drives.end()
                assert code == 0, 'emulated_drives ended with %s:\n%s' % (code, cls.drives.output())
        finally:
            for one in (cls.driver_program, cls.drives):
                if one is not None:
                    one.kill()
            shutil.rmtree(cls.folder)

    @classmethod
    def end_driver(cls):
        return 0 if cls.driver_program is None else cls.driver_program.end()

    def inject(self, target, command):
        self.drives.inject(target, command)

    def expect_emergency(self, joint, code):
        """In the middle of a goal a CAN drive reports an error: it is told, nothing moves while it is reset, and the arm can go on."""
        self.driver.action.send(goal(JOINTS, [point(20.0, [-0.5] * 6, [0.0] * 6)]))
        self.driver.wait_moving()
        self.inject(joint, 'emcy 0x%04X' % code)
        status, result = self.driver.action.ending()
        self.assertEqual(status, GoalStatus.ABORTED, result)
        self.assertIn(joint, result.error_string)
        self.assertIn('%04X' % code, result.error_string)
        rest = self.driver.wait_standstill()
        for request in (lambda: self.driver.trigger('reset_faults'), lambda: self.driver.enable(True)):
            answer = request()
            self.assertTrue(answer.success, answer.message)
            for before, now in zip(rest, self.driver.positions()):
                self.assertAlmostEqual(before, now, delta=2e-3)
        self.driver.go(JOINTS, [0.0] * 6, 3.0)

    def expect_recovery(self, unplug, plug, *texts):
        """In the middle of a goal unplug() is called. The goal ends with the texts; after plug(), ~reset_faults and ~enable the arm is
        ready without a restart of anything, and nothing moves without a new goal."""
        self.driver.action.send(goal(JOINTS, [point(20.0, [-0.5] * 6, [0.0] * 6)]))
        self.driver.wait_moving()
        begin = time.monotonic()
        unplug()
        status, result = self.driver.action.ending()
        reported = time.monotonic()
        self.assertEqual(status, GoalStatus.ABORTED, result)
        for text in texts:
            self.assertIn(text, result.error_string)
        plug()
        plugged = time.monotonic()
        while not self.driver.trigger('reset_faults').success:
            self.assertLess(time.monotonic() - plugged, PATIENCE)
        answer = self.driver.enable(True)
        self.assertTrue(answer.success, answer.message)
        print('reported after %.1f s, ready %.1f s after it was over' % (reported - begin, time.monotonic() - plugged))
        rest = self.driver.positions()
        for _ in range(20):
            for before, now in zip(rest, self.driver.positions()):
                self.assertAlmostEqual(before, now, delta=1e-3)
        self.driver.go(JOINTS, [position + 0.1 for position in rest], 2.0)
