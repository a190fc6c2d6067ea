"""Goals of config/goals."""
import os

import rospkg
import yaml
from driver_client import goal, point

JOINTS = ['joint%d' % i for i in range(1, 7)]


def goal_from_file(name, slower=1.0):
    """A goal of config/goals, in `slower` times the time it takes there."""
    path = os.path.join(rospkg.RosPack().get_path('interpolated_motion_driver'), 'config', 'goals', name)
    with open(path) as file:
        data = yaml.safe_load(file)
    points = [point(slower * (p['time_from_start']['secs'] + 1e-9 * p['time_from_start']['nsecs']), p['positions'],
                    [v / slower for v in p.get('velocities', [])],
                    [a / slower ** 2 for a in p.get('accelerations', [])]) for p in data['points']]
    return goal(data['joint_names'], points)
