"""fake_driver.py DELAY LOG: after DELAY seconds a node /driver that takes each goal, adds a line to LOG and succeeds."""
import sys
import time

import actionlib
import rospy
from control_msgs.msg import FollowJointTrajectoryAction


def main():
    time.sleep(float(sys.argv[1]))
    rospy.init_node("driver", disable_signals=True)

    def execute(_goal):
        with open(sys.argv[2], "a", encoding="utf-8") as log:
            log.write("goal\n")
        server.set_succeeded()

    server = actionlib.SimpleActionServer("/driver/follow_joint_trajectory", FollowJointTrajectoryAction, execute, auto_start=False)
    server.start()
    rospy.spin()


main()
