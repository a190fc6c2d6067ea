"""What the launch files start, as roslaunch tells it without starting anything."""
import os
import subprocess
from pathlib import Path

import pytest
import yaml

LAUNCH = Path(__file__).resolve().parents[2] / "launch"
CONFIG = LAUNCH.parent / "config"


def roslaunch(tmp_path, *arguments):
    environment = {**os.environ, "ROS_HOME": str(tmp_path), "ROS_LOG_DIR": str(tmp_path)}
    done = subprocess.run(["roslaunch", *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=120, env=environment)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("file, arguments, nodes", [
    ("driver.launch", [f"config:={CONFIG}/rrbot_epos.yaml", "node_name:=arm"], ["/arm"]),
    ("emulated.launch", [], ["/driver"]),
    ("demo.launch", [], ["/driver"]),
    ("demo.launch", ["rviz:=true"], ["/driver", "/rviz"]),
    ("diagnostics.launch", [], ["/diagnostic_aggregator"]),
])
def test_nodes(tmp_path, file, arguments, nodes):
    assert roslaunch(tmp_path, "--nodes", LAUNCH / file, *arguments).split() == nodes


def test_every_launch_file_is_looked_at():
    assert sorted(path.name for path in LAUNCH.glob("*.launch")) == ["demo.launch", "diagnostics.launch", "driver.launch", "emulated.launch"]


def test_the_arm_is_shown_with_its_frames_and_leaves_no_limits_behind(tmp_path):
    shown = yaml.safe_load(roslaunch(tmp_path, "--dump-params", LAUNCH / "demo.launch", "rviz:=true"))
    assert shown["/driver/publish_tf"] is True
    assert "<robot " in shown["/demo_description"]
    assert "/robot_description" not in shown
    plain = yaml.safe_load(roslaunch(tmp_path, "--dump-params", LAUNCH / "demo.launch"))
    assert "/driver/publish_tf" not in plain and "/demo_description" not in plain


def test_rviz_shows_both_arms_of_that_description():
    displays = yaml.safe_load((CONFIG / "demo.rviz").read_text())["Visualization Manager"]["Displays"]
    arms = {display["Name"]: display for display in displays if display["Class"] == "rviz/RobotModel"}
    assert {arm["Robot Description"] for arm in arms.values()} == {"demo_description"}
    # configuration.md: tf_demand_prefix is demand/ by default; RViz puts the slash behind its prefix.
    assert {name: arm["TF Prefix"] for name, arm in arms.items()} == {"Actual": "", "Demanded": "demand"}
