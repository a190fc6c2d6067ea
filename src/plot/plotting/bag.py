"""Bags of the driver's topics."""
import warnings

from problems import BadInput
from session import Joint, Load

STATE = "control_msgs/JointTrajectoryControllerState"
BUFFERS = "interpolated_motion_driver/BufferStatus"
DRIVES = "interpolated_motion_driver/DriveState"


def is_one(head):
    return head.startswith(b"#ROSBAG V")


def read(path, session, _rates):
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            import rosbag
    except ImportError as error:
        raise BadInput(f"{path} is a bag, and rosbag is missing. On Debian and Ubuntu: apt install python3-rosbag") from error
    readers = {STATE: read_state, BUFFERS: read_buffers, DRIVES: read_drives}
    try:
        with rosbag.Bag(path) as bag:
            types = {topic: info.msg_type for topic, info in bag.get_type_and_topic_info().topics.items()}
            topics = [topic for topic, kind in types.items() if kind in readers]
            if not topics:
                raise BadInput(f"{path} has no topics of the driver, of ~state, ~buffer_status and ~drive_states at least ~state is wanted")
            for topic, message, _ in bag.read_messages(topics=topics):
                readers[types[topic]](session, message, message.header.stamp.to_sec())
    except rosbag.ROSBagException as error:
        raise BadInput(f"{path}: {error}; rosbag reindex may help") from error


def read_state(session, message, time):
    for i, name in enumerate(message.joint_names):
        joint = session.joints.setdefault(name, Joint())
        desired, actual = message.desired, message.actual
        joint.note_motion(time, desired.positions[i], desired.velocities[i] if desired.velocities else 0.0, actual.positions[i],
                          actual.velocities[i] if actual.velocities else 0.0)


def read_buffers(session, message, time):
    for i, name in enumerate(message.name):
        joint = session.joints.setdefault(name, Joint())
        joint.buffer_times.append(time)
        joint.buffer.append(message.fill_time[i])
    for bus, share in dict(zip(message.bus, message.bus_load)).items():
        load = session.loads.setdefault(bus, Load(by_kind={"all": []}))
        if load.by_kind.keys() == {"all"}:
            load.times.append(time)
            load.by_kind["all"].append(share)


def read_drives(session, message, time):
    for i, name in enumerate(message.name):
        joint = session.joints.setdefault(name, Joint())
        joint.unit = message.unit[i]
        joint.note_state(time, message.state[i].lower() if message.online[i] else "offline")
