"""ROS for the tests of this folder: a master on a free port and this process as a node."""
import os
import socket
import sys
import time

import pytest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from programs import PATIENCE, Program  # noqa: E402


def free_port():
    with socket.socket() as probe:
        probe.bind(('localhost', 0))
        return probe.getsockname()[1]


@pytest.fixture(scope='session')
def ros(tmp_path_factory):
    import rosgraph
    import rospy
    port = free_port()
    os.environ['ROS_MASTER_URI'] = 'http://localhost:%d' % port
    os.environ['ROS_HOSTNAME'] = 'localhost'
    os.environ['ROS_HOME'] = os.environ['ROS_LOG_DIR'] = str(tmp_path_factory.mktemp('ros'))
    master = Program(['rosmaster', '--core', '-p', str(port)])
    try:
        deadline = time.monotonic() + PATIENCE
        while not rosgraph.is_master_online():
            assert master.running() and time.monotonic() < deadline, master.output()
            time.sleep(0.1)
        rospy.init_node('real_buses', disable_signals=True)
        yield
        rospy.signal_shutdown('end of the tests')
    finally:
        master.kill()
