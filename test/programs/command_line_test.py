"""Command lines: what the programs say to a user who does not know them, or errs."""
import os
import xmlrpc.client
from pathlib import Path

import pytest

GOALS = Path(__file__).resolve().parents[2] / "config" / "goals"
GOAL = str(GOALS / "six_axis_positions_only.yaml")
ALL = ("driver_node", "trajectory_client", "emulated_drives", "drive_tool")


@pytest.mark.parametrize("program", ALL)
@pytest.mark.parametrize("flag", ["--help", "-h"])
def test_help_needs_neither_ros_nor_a_configuration(run, program, flag):
    result = run(program, flag)
    assert (result.code, result.error) == (0, "")
    assert result.out.startswith(program + " ")
    assert "--help" in result.out


OPTIONS = {
    "trajectory_client": {"--goal FILE": "YAML", "--setpoints SECONDS": "0.1..3600 s", "--lost PART": "0..0.9 (default: 0)",
                          "--node NAME": "/driver", "--wait SECONDS": "1e6 s (default: 0", "--timeout SECONDS": "1e6 s (default"},
    "emulated_drives": {"--config FILE": "", "--can INTERFACE": "", "--epos NODES": "1..127", "--serial LINK": "", "--bus NAME": "default",
                        "--silverlode ADDRESSES": "1..254", "--clock-error-ppm PPM": "ppm (default", "--bitrate BIT/S": "bit/s (default",
                        "--baud BIT/S": "57600", "--samples FOLDER": "default"},
    "drive_tool": {"drive_tool scan PLACE": "", "read PLACE OBJECT...": "", "write PLACE OBJECT VALUE": "", "save PLACE": "", "dump PLACE FILE": "",
                   "diff PLACE FILE": "", "restore PLACE FILE": "", "monitor PLACE": "", "PLACE is": "can0"},
    "driver_node": {"__name:=NAME": "default: driver", "_PARAMETER:=VALUE": "wire_log"},
}


@pytest.mark.parametrize("program", ALL)
def test_help_lists_every_option_with_unit_and_default(run, program):
    words = " ".join(run(program, "--help").out.split())
    for option, meaning in OPTIONS[program].items():
        assert option in words
        assert meaning in words, option


@pytest.mark.parametrize("program, argument, meant", [
    ("driver_node", "--hlep", "--help"),
    ("trajectory_client", "--setpoint=3", "--setpoints"),
    ("trajectory_client", "--tiemout", "--timeout"),
    ("emulated_drives", "--samlpes", "--samples"),
    ("emulated_drives", "--clock-error-pmm=3", "--clock-error-ppm"),
])
def test_an_unknown_option_is_refused_with_the_one_that_may_be_meant(run, program, argument, meant):
    result = run(program, argument)
    assert result.code == 2
    assert result.error == f"{program}: unknown argument {argument.split('=')[0]}; did you mean {meant}?\n"


@pytest.mark.parametrize("program", ALL)
def test_a_word_that_is_no_option_is_refused(run, program):
    result = run(program, "drives.yaml")
    assert result.code == 2
    assert "drives.yaml" in result.error


@pytest.mark.parametrize("arguments, reason", [
    (["--can", "vcan0", "--epos=128"], '--epos: "128" is not a number within 1..127'),
    (["--can", "vcan0", "--epos", "1,2,3", "--clock-error-ppm", "-1,-2"], "2 values for 3 drives"),
    (["--can", "vcan0", "--epos", "1", "--clock-error-ppm=-200000"], "-100000..100000"),
    (["--config", "/nowhere/drives.yaml"], "/nowhere/drives.yaml cannot be read: No such file or directory"),
    (["--config", "/"], "/ cannot be read: Is a directory"),
    (["--serial", "link", "--silverlode", "16,17,16"], "--silverlode names 16 twice"),
    (["--can", "vcan0", "--epos", "2,2"], "--epos names 2 twice"),
    (["--serial", "link", "--silverlode", "16", "--baud", "12345"], "--baud is 12345; allowed: 300, 1200"),
    (["--can", "vcan0", "--epos", "1", "--bitrate", "12345"], "--bitrate is 12345; allowed: 1000000, 800000"),
])
def test_emulated_drives_says_what_is_wrong(run, arguments, reason):
    result = run("emulated_drives", *arguments)
    assert result.code == 2
    assert reason in result.error


def test_emulated_drives_says_where_a_file_is_no_yaml(run, tmp_path):
    (tmp_path / "drives.yaml").write_text("joints: [a\nbuses:\n")
    result = run("emulated_drives", "--config", str(tmp_path / "drives.yaml"))
    assert result.code == 2
    assert result.error.startswith(f"emulated_drives: {tmp_path}/drives.yaml:2:")


@pytest.mark.parametrize("arguments, reason", [
    ([], "either --goal FILE or --setpoints SECONDS"),
    (["--goal", "a", "--setpoints", "3"], "either --goal FILE or --setpoints SECONDS"),
    (["--goal"], "--goal"),
    (["--goal", "--node", "/driver"], "--goal needs a value, and --node is none"),
    (["--setpoints=-1"], '"-1" is not a number within 0.1..3600'),
    (["--setpoints", "-1"], '"-1" is not a number within 0.1..3600'),
    (["--goal", "/nowhere/goal.yaml"], "/nowhere/goal.yaml cannot be read: No such file or directory"),
])
def test_trajectory_client_says_what_is_wrong(run, arguments, reason):
    result = run("trajectory_client", *arguments)
    assert result.code == 2
    assert reason in result.error


TRAJECTORY = """
header: {seq: 0, stamp: {secs: 0, nsecs: 0}, frame_id: ''}
joint_names: [joint1]
points:
  - {positions: [0.1], velocities: [], accelerations: [], effort: [], time_from_start: {secs: 1, nsecs: 500000000}}
"""


def nested(text, *names):
    """`text`, a map in YAML, below keys from the outermost to the innermost; a key that ends in - holds a list."""
    for name in reversed(names):
        lines = text.strip("\n").splitlines()
        first, others = ("  - ", "    ") if name.endswith("-") else ("  ", "  ")
        text = name.rstrip("-") + ":\n" + "\n".join((first if i == 0 else others) + line for i, line in enumerate(lines)) + "\n"
    return text


@pytest.mark.parametrize("text", [
    TRAJECTORY,
    nested(TRAJECTORY, "trajectory"),                                       # FollowJointTrajectoryGoal
    "header: {seq: 1}\ngoal_id: {id: x}\n" + nested(TRAJECTORY, "goal", "trajectory") + "---\n",  # rostopic echo .../goal
    nested(TRAJECTORY, "joint_trajectory"),                                 # RobotTrajectory
    "model_id: arm\n" + nested(TRAJECTORY, "trajectory-", "joint_trajectory"),  # DisplayTrajectory
    TRAJECTORY.replace("{secs: 1, nsecs: 500000000}", "{sec: 1, nanosec: 500000000}"),
])
def test_goals_are_read_as_messages_are_printed(run, tmp_path, text):
    (tmp_path / "goal.yaml").write_text(text)
    result = run("trajectory_client", "--goal", str(tmp_path / "goal.yaml"), "--wait", "0.5")
    assert result.code == 5, result.error  # the file is good, and there is no master


@pytest.mark.parametrize("text, reason", [
    ("position: [1]\nname: [a]\n", "joint_names is missing; there are position, name. A trajectory_msgs/JointTrajectory is wanted"),
    ("[1, 2]\n", "no map with joint_names and points"),
    (TRAJECTORY + "points: []\n", 'key "points" is given twice'),
    (TRAJECTORY.replace("secs: 1", "seconds: 1"), "time_from_start: secs is missing"),
])
def test_goal_files_that_are_none_are_told_for_what_they_are(run, tmp_path, text, reason):
    (tmp_path / "goal.yaml").write_text(text)
    result = run("trajectory_client", "--goal", str(tmp_path / "goal.yaml"), "--wait", "0.5")
    assert result.code == 2
    assert reason in result.error


def test_arguments_of_ros_are_left_to_it(run):
    for program in ("driver_node", "trajectory_client"):
        assert run(program, "__name:=other", "a:=b", "_wire_log:=bus.log", "--help").code == 0
    assert run("driver_node", "__name:=other", "--hlep").code == 2


def test_trajectory_client_waits_for_a_master_no_longer_than_it_says(run):
    result = run("trajectory_client", "--goal", GOAL, "--wait", "2")
    assert result.code == 5, result.error
    assert "no answer from ROS's master at http://127.0.0.1:" in result.error
    assert "waiting for ROS's master" in result.out
    assert 2.0 <= result.seconds


def test_trajectory_client_waits_for_the_driver_no_longer_than_it_says(run, master):
    result = run("trajectory_client", "--goal", GOAL, "--wait=2", "--node", "/arm")
    assert result.code == 5, result.error
    assert "there is no node /arm. Start the driver first, or say by --wait" in result.error
    assert "waiting for the driver /arm" in result.out


def test_the_time_for_the_whole_run_covers_the_wait_for_the_driver(run, master):
    result = run("trajectory_client", "--setpoints", "1", "--wait", "50", "--timeout", "1.5")
    assert result.code == 5, result.error
    assert "there is no node /driver" in result.error


def test_without_being_told_to_wait_trajectory_client_is_for_a_driver_that_is_there(run, master):
    for motion in (["--goal", GOAL], ["--setpoints", "1"]):
        result = run("trajectory_client", *motion)
        assert result.code == 5, result.error
        assert "there is no node /driver" in result.error
        assert result.seconds < 20  # it did not wait for one


def test_without_being_told_to_wait_trajectory_client_does_not_wait_for_a_master(run):
    result = run("trajectory_client", "--goal", GOAL)
    assert result.code == 5, result.error
    assert "no answer from ROS's master" in result.error
    assert "waiting" not in result.out


def test_a_driver_that_takes_the_name_while_its_predecessor_comes_up_is_sent_nothing(run, master, master_uri, fake_driver):
    """The first one is there when the client is asked, and never serves its action. The second one does."""
    first = "http://127.0.0.1:1"
    xmlrpc.client.ServerProxy(master_uri).registerService("/driver", "/driver/halt", "rosrpc://127.0.0.1:1", first)
    driver = fake_driver(3.0)
    result = run("trajectory_client", "--goal", GOAL)
    assert result.code == 5, result.error
    assert "has ended and another one has been started; it is sent nothing" in result.error
    assert driver.goals() == 0


def test_a_driver_that_is_waited_for_is_sent_the_goal(run, master, fake_driver):
    driver = fake_driver(3.0)
    result = run("trajectory_client", "--goal", GOAL, "--wait", "50")
    assert result.code == 0, result.error
    assert driver.goals() == 1


def test_a_fifo_for_a_file_is_refused_and_not_waited_for(run, tmp_path):
    os.mkfifo(tmp_path / "fifo")
    for program, option in (("trajectory_client", "--goal"), ("emulated_drives", "--config")):
        result = run(program, option, str(tmp_path / "fifo"))
        assert result.code == 2
        assert f"{tmp_path}/fifo cannot be read: it is a FIFO" in result.error


def test_samples_are_not_written_through_a_link_nor_over_something_else(run, tmp_path):
    (tmp_path / "mine").write_text("what I had to say\n")
    (tmp_path / "linked").mkdir()
    (tmp_path / "linked" / "16").symlink_to(tmp_path / "mine")
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "16").write_text("notes\n")
    for folder, reason in (("linked", "a symbolic link"), ("taken", "something else in it, which is kept")):
        result = run("emulated_drives", "--serial", str(tmp_path / "line"), "--silverlode", "16", "--samples", str(tmp_path / folder))
        assert result.code != 0
        assert "--samples: " in result.error and reason in result.error
    assert (tmp_path / "mine").read_text() == "what I had to say\n"
    assert (tmp_path / "taken" / "16").read_text() == "notes\n"
