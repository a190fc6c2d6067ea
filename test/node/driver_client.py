"""What the rostests of the driver share: a client of one driver node, and goals."""
import threading
import time

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import FollowJointTrajectoryAction, FollowJointTrajectoryGoal, JointTrajectoryControllerState
from interpolated_motion_driver.msg import BufferStatus, DriveState
from interpolated_motion_driver.srv import GetMotionReport, InjectFault
from std_srvs.srv import SetBool, Trigger
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

# Far longer than anything takes on a loaded machine; no test waits for it to pass.
PATIENCE = 60.0


class Latest:
    """The latest message of a topic, and waiting for one that fits."""

    def __init__(self, topic, message_type):
        self._condition = threading.Condition()
        self._message = None
        self.count = 0
        self._subscriber = rospy.Subscriber(topic, message_type, self._take, queue_size=100)

    def _take(self, message):
        with self._condition:
            self._message = message
            self.count += 1
            self._condition.notify_all()

    def wait_for(self, fits, what, patience=PATIENCE):
        """The first message, from now on, for which fits(message) holds."""
        with self._condition:
            before = self.count
            if not self._condition.wait_for(lambda: self.count > before and fits(self._message), patience):
                raise AssertionError('waited %g s for %s; latest: %s' % (patience, what, self._message))
            return self._message

    def next(self):
        return self.wait_for(lambda message: True, 'a message')


def point(seconds, positions, velocities=(), accelerations=()):
    return JointTrajectoryPoint(positions=list(positions), velocities=list(velocities),
                                accelerations=list(accelerations),
                                time_from_start=rospy.Duration.from_sec(seconds))


def trajectory(joints, points, stamp=None):
    message = JointTrajectory(joint_names=list(joints), points=list(points))
    if stamp is not None:
        message.header.stamp = stamp
    return message


def goal(joints, points, stamp=None):
    return FollowJointTrajectoryGoal(trajectory=trajectory(joints, points, stamp))


class Sender:
    """An action client, one of possibly several. Unlike actionlib's SimpleActionClient it loses no result that arrives before
    its send_goal() has returned."""

    def __init__(self, action):
        self._client = actionlib.ActionClient(action, FollowJointTrajectoryAction)
        if not self._client.wait_for_server(rospy.Duration(PATIENCE)):
            raise AssertionError('no action server %s within %g s' % (action, PATIENCE))
        self._handle = None
        self._known = None
        self._ended = None

    def send(self, sent, feedback=None):
        known = threading.Event()
        ended = threading.Event()
        self._known = known
        self._ended = ended

        def transition(handle):
            known.set()
            if handle.get_comm_state() == actionlib.CommState.DONE:
                ended.set()

        self._handle = self._client.send_goal(sent, transition, lambda _, message: feedback(message) if feedback else None)

    def cancel(self):
        """Cancels the goal once the server knows it: actionlib's client takes a goal that it cancelled earlier for lost when a
        status message from before the goal arrives."""
        self.wait_known()
        self._handle.cancel()

    def wait_known(self):
        """Waits until the server has the goal."""
        if not self._known.wait(PATIENCE):
            raise AssertionError('the goal was not acknowledged within %g s' % PATIENCE)

    def is_active(self):
        return self._handle.get_comm_state() == actionlib.CommState.ACTIVE

    def ending(self, patience=PATIENCE):
        """Waits for the goal's end: (status, result)."""
        if not self._ended.wait(patience):
            raise AssertionError('no result within %g s' % patience)
        return self._handle.get_goal_status(), self._handle.get_result()

    def execute(self, sent, patience=PATIENCE):
        self.send(sent)
        return self.ending(patience)


class Driver:
    """A client of the driver that runs as `node`, once it takes goals."""

    def __init__(self, node):
        self.node = node
        self.state = Latest(node + '/state', JointTrajectoryControllerState)
        self.buffers = Latest(node + '/buffer_status', BufferStatus)
        self.drives = Latest(node + '/drive_states', DriveState)
        self.action = self.client()

    def client(self):
        """A further action client, as another program would have it."""
        return Sender(self.node + '/follow_joint_trajectory')

    def service(self, name, service_type):
        rospy.wait_for_service(self.node + '/' + name, PATIENCE)
        return rospy.ServiceProxy(self.node + '/' + name, service_type)

    def trigger(self, name):
        return self.service(name, Trigger)()

    def enable(self, on):
        return self.service('enable', SetBool)(on)

    def inject(self, joint, command):
        return self.service('inject_fault', InjectFault)(joint, command)

    def report(self):
        return self.service('motion_report', GetMotionReport)()

    def positions(self):
        return list(self.state.next().actual.positions)

    def records_sent(self):
        return list(self.buffers.next().records_sent)

    def wait_moving(self):
        """Until a joint moves by itself."""
        return self.state.wait_for(lambda m: max(abs(v) for v in m.actual.velocities) > 0.02, 'motion')

    def wait_standstill(self, joints=None, patience=PATIENCE):
        """Until no joint (of the numbers given, or of all) has moved for some messages, then the positions of all."""
        deadline = time.monotonic() + patience
        still = 0
        while still < 10:
            message = self.state.next()
            numbers = range(len(message.joint_names)) if joints is None else joints
            velocities = [v for i in numbers for v in (message.actual.velocities[i], message.desired.velocities[i])]
            slow = max(abs(v) for v in velocities) < 0.01
            still = still + 1 if slow else 0
            if time.monotonic() > deadline:
                raise AssertionError('no standstill within %g s: %s' % (patience, message))
        return list(message.actual.positions)

    def go(self, joints, positions, seconds):
        """Moves there from rest to rest and expects it to succeed."""
        zero = [0.0] * len(joints)
        status, result = self.action.execute(goal(joints, [point(seconds, positions, zero)]))
        if status != GoalStatus.SUCCEEDED:
            raise AssertionError('status %d, %d: %s' % (status, result.error_code, result.error_string))
