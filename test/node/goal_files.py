"""Goals of config/goals."""
import os

import rospkg
import yaml
from driver_client import goal, point

JOINTS = ['joint%d' % i for i in range(1, 7)]


def goal_from_file(name):
    path = os.path.join(rospkg.RosPack().get_path('interpolated_motion_driver'), 'config', 'goals', name)
    with open(path) as file:
        data = yaml.safe_load(file)
    points = [point(p['time_from_start']['secs'] + 1e-9 * p['time_from_start']['nsecs'], p['positions'],
                    p.get('velocities', []), p.get('accelerations', [])) for p in data['points']]
    return goal(data['joint_names'], points)
