#!/usr/bin/python3
"""The driver as a process: configurations it refuses, and how it ends."""
import copy
import os
import re
import signal
import subprocess
import sys
import tempfile
import unittest
import xmlrpc.client

import rosgraph
import roslib.packages
import rospkg
import rospy
import rostest
import yaml
from actionlib_msgs.msg import GoalStatus
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from driver_client import PATIENCE, Driver, goal, point  # noqa: E402

PACKAGE = 'interpolated_motion_driver'
JOINTS = ['joint1', 'joint2']
CANDUMP_LINE = re.compile(r'\(\d+\.\d{6}\) can0 [0-9A-F]{3}#(R\d?|([0-9A-F]{2}){0,8})$')


def configuration():
    with open(os.path.join(rospkg.RosPack().get_path(PACKAGE), 'config', 'rrbot_epos.yaml')) as file:
        return yaml.safe_load(file)


class Process:
    """A driver_node of its own, under a name of its own."""

    def __init__(self, name, parameters, namespace=''):
        place = namespace + '/' + name
        if rospy.has_param(place):
            rospy.delete_param(place)
        if parameters:
            rospy.set_param(place, parameters)
        program = roslib.packages.find_node(PACKAGE, 'driver_node')[0]
        self._output = tempfile.TemporaryFile(mode='w+')
        command = [program, '__name:=' + name, '__ns:=' + (namespace or '/')]
        self._process = subprocess.Popen(command, stdout=self._output, stderr=subprocess.STDOUT)

    def send(self, number):
        self._process.send_signal(number)

    def running(self):
        return self._process.poll() is None

    def wait(self, patience=PATIENCE):
        """Its exit code."""
        try:
            return self._process.wait(patience)
        finally:
            self.kill()

    def output(self):
        self._output.seek(0)
        return self._output.read()

    def kill(self):
        if self.running():
            self._process.kill()
            self._process.wait()


class InANamespace(unittest.TestCase):
    def test_joint_states_are_in_the_namespace_of_the_node(self):
        process = Process('arm', configuration(), '/left')
        try:
            self.assertEqual(rospy.wait_for_message('/left/joint_states', JointState, PATIENCE).name, JOINTS)
            self.assertNotIn('/joint_states', [topic for topic, _ in rospy.get_published_topics()])
        finally:
            process.send(signal.SIGTERM)
            self.assertEqual(process.wait(), 0, process.output())


class BadConfigurations(unittest.TestCase):
    def expect_refused(self, parameters, *texts):
        process = Process('bad_configuration', parameters)
        self.assertEqual(process.wait(), 1, process.output())
        self.assertIn('FATAL', process.output())
        for text in texts:
            self.assertIn(text, process.output())

    def expect_refused_with(self, path, value, *texts):
        parameters = copy.deepcopy(configuration())
        place = parameters
        for key in path[:-1]:
            place = place.setdefault(key, {})
        place[path[-1]] = value
        self.expect_refused(parameters, *texts)

    def test_no_configuration(self):
        self.expect_refused({}, '/bad_configuration', 'driver.launch')

    def test_unknown_key(self):
        self.expect_refused_with(['comit_horizon'], 2.0, 'comit_horizon', 'commit_horizon')

    def test_unknown_key_of_a_drive(self):
        self.expect_refused_with(['drives', 'joint2', 'gear'], 2.0, 'drives/joint2/gear', 'gear_ratio')

    def test_wrong_type(self):
        self.expect_refused_with(['state_publish_rate'], 'fast', 'state_publish_rate', 'fast', '1000')

    def test_wrong_type_of_a_drive(self):
        self.expect_refused_with(['drives', 'joint1', 'gear_ratio'], 'high', 'drives/joint1/gear_ratio', 'high')

    def test_out_of_range(self):
        self.expect_refused_with(['action_monitor_rate'], 0, 'action_monitor_rate', '0.1', '1000')

    def test_out_of_range_node_id(self):
        self.expect_refused_with(['drives', 'joint1', 'node_id'], 200, 'drives/joint1/node_id', '200', '127')

    def test_two_joints_on_one_node_id(self):
        self.expect_refused_with(['drives', 'joint2', 'node_id'], 1, 'joint1', 'joint2', 'node_id', 'can0')

    def test_no_joints(self):
        parameters = configuration()
        del parameters['joints']
        self.expect_refused(parameters, 'joints')

    def test_joint_without_drive(self):
        parameters = configuration()
        del parameters['drives']['joint2']
        self.expect_refused(parameters, 'drives/joint2')

    def test_unknown_bus(self):
        self.expect_refused_with(['drives', 'joint1', 'bus'], 'can7', 'drives/joint1/bus', 'can7')

    def test_limit_wider_than_the_urdf(self):
        self.expect_refused_with(['drives', 'joint1', 'limits', 'max_velocity'], 11.0, 'max_velocity', '11', '10')

    def test_joint_not_in_the_urdf(self):
        parameters = configuration()
        parameters['joints'] = ['joint1', 'elbow']
        parameters['drives']['elbow'] = parameters['drives'].pop('joint2')
        self.expect_refused(parameters, 'elbow', 'rrbot.urdf')

    def test_fixed_joint(self):
        parameters = configuration()
        parameters['joints'] = ['joint1', 'fixed']
        parameters['drives']['fixed'] = parameters['drives'].pop('joint2')
        self.expect_refused(parameters, 'fixed', 'rrbot.urdf')

    def test_no_robot_description(self):
        parameters = configuration()
        del parameters['robot_description_file']
        self.expect_refused(parameters, 'robot_description')

    def test_unreadable_robot_description(self):
        self.expect_refused_with(['robot_description_file'], '/nowhere/robot.urdf', 'robot_description_file', '/nowhere')

    def test_unwritable_wire_log(self):
        self.expect_refused_with(['wire_log'], '/nowhere/wire.log', 'wire_log', '/nowhere')


class BadDrives(unittest.TestCase):
    """Drives that are not there or cannot do it: the driver stays, so that they can be switched on, but drives nothing."""

    def expect_fault(self, emulation, *texts):
        parameters = configuration()
        parameters['bring_up_timeout'] = 2.0
        parameters['drives']['joint2']['emulation'] = emulation
        process = Process('bad_drives', parameters)
        try:
            driver = Driver('/bad_drives')
            status, result = driver.action.execute(goal(JOINTS, [point(1.0, [0.1, 0.1], [0.0, 0.0])]))
            self.assertEqual(status, GoalStatus.REJECTED)
            self.assertEqual(result.error_code, result.INVALID_GOAL)
            for text in texts:
                self.assertIn(text, result.error_string)
            self.assertEqual(driver.records_sent(), [0, 0])
            process.send(signal.SIGINT)
            self.assertEqual(process.wait(), 0, process.output())
            for text in texts:
                self.assertIn(text, process.output())
        finally:
            process.kill()

    def test_drive_missing(self):
        self.expect_fault({'missing': True}, 'joint2')

    def test_drive_without_interpolated_position_mode(self):
        self.expect_fault({'variant': 'epos4'}, 'joint2', 'EPOS4')


class Life(unittest.TestCase):
    def run_until(self, name, stop):
        """Has a driver move, calls stop(process, driver), and returns exit code, output and the action's ending."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        log = os.path.join(folder.name, 'wire.log')
        parameters = configuration()
        parameters['wire_log'] = log
        parameters['type'] = 'position_controllers/JointTrajectoryController'
        process = Process(name, parameters)
        try:
            driver = Driver('/' + name)
            driver.action.send(goal(JOINTS, [point(20.0, [3.0, 3.0], [0.0, 0.0])]))
            driver.wait_moving()
            stop(process, driver)
            code = process.wait(10.0)
            with open(log) as file:
                return code, process.output(), file.read().splitlines(), driver
        finally:
            process.kill()

    def expect_clean_end(self, name, stop):
        code, output, lines, driver = self.run_until(name, stop)
        self.assertEqual(code, 0, output)
        status, result = driver.action.ending()
        self.assertEqual(status, GoalStatus.ABORTED)
        self.assertIn('shutting down', result.error_string)
        self.assertIn('Parameter type is ignored', output)
        self.assertGreater(len(lines), 100)
        for line in lines:
            self.assertRegex(line, CANDUMP_LINE)

    def test_interrupt(self):
        self.expect_clean_end('interrupted', lambda process, _: process.send(signal.SIGINT))

    def test_terminate(self):
        self.expect_clean_end('terminated', lambda process, _: process.send(signal.SIGTERM))

    def test_killed_by_name(self):
        """As `rosnode kill` does it."""

        def kill(_process, _driver):
            node = rosgraph.Master(rospy.get_name()).lookupNode('/killed')
            xmlrpc.client.ServerProxy(node).shutdown(rospy.get_name(), 'a test')

        self.expect_clean_end('killed', kill)

    def test_halt_waits_for_no_other_service(self):
        """A reset in motion is answered at once, and so is a halt beside it."""
        process = Process('halted', configuration())
        try:
            driver = Driver('/halted')
            driver.action.send(goal(JOINTS, [point(20.0, [3.0, 3.0], [0.0, 0.0])]))
            driver.wait_moving()
            reset = rospy.ServiceProxy('/halted/reset_faults', Trigger)()
            self.assertFalse(reset.success)
            self.assertIn('moving', reset.message)
            self.assertTrue(rospy.ServiceProxy('/halted/halt', Trigger)().success)
            status, result = driver.action.ending()
            self.assertEqual(status, GoalStatus.ABORTED)
            self.assertIn('~halt', result.error_string)
        finally:
            process.kill()


if __name__ == '__main__':
    rospy.init_node('process')
    rostest.rosrun(PACKAGE, 'process', '__main__')
