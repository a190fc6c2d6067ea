"""The program `plot`: what it reads, what it draws, and what it says of files that it cannot draw."""
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[2] / "src" / "plot"
sys.path.insert(0, str(SOURCE / "plotting"))
import inputs  # noqa: E402
import wire  # noqa: E402

RATES = {"canopen": 1e6, "silverlode": 57600.0}

HEAD = """# A recording of interpolated_motion_driver, described in docs/recording.md. Times are the host's clock, s.
version: 1
cause: "a test"
begin: 100.000000000
end: 104.000000000
complete: false
joints: ["shoulder", "slide"]
limits: {"shoulder": {unit: rad}, "slide": {unit: m}}
configuration: {commit_horizon: 0.4, buses: {can0: {type: canopen, bitrate: 500000, max_load: 0.5}},
  drives: {shoulder: {type: epos_ipm}, slide: {type: silverlode_ims, deviation_bound: 3}}}
---
"""


def joints(time, position, fill=0.45):
    return (f"{time:.9f} joint shoulder {position} 0.5 {position - 0.002} 0.5 {position} {fill}\n"
            f"{time:.9f} joint slide {0.1 * position} 0.05 {0.1 * position} 0.05 0 {fill}\n")


GOAL = (HEAD + "100.000000000 drive shoulder online, operation enabled, statusword 0x1337, mode 7, error 0x0000\n" + joints(100.0, 0.0)
        + "100.500000000 order goal {id: 4, group: idle, answer: \"accepted\", joint_names: [\"shoulder\", \"slide\"], "
          "points: [{time_from_start: 2, positions: [1, 0.1]}]}\n"
        + "101.000000000 group preparing -> moving\n" + "".join(joints(101.0 + 0.1 * i, 0.05 * i) for i in range(20))
        + "".join(f"{101.0001 + 0.001 * i:.9f} wire can0 > 080#\n" for i in range(1000)))
GOOD = GOAL + "103.000000000 end goal 4 succeeded: \n103.100000000 group settling -> idle\n" + joints(103.2, 1.0, 0.0)
FAULT = (GOAL + "102.900000000 drive shoulder online, fault, statusword 0x0218, mode 7, error 0x4210\n102.950000000 group stopping -> fault: "
         "Joint shoulder: over-temperature. Let it cool.\n103.000000000 log error: Joint shoulder: over-temperature. Let it cool.\n"
         "103.000000000 end goal 4 aborted -1: over-temperature\n" + joints(103.2, 1.0, 0.0))
STREAM = HEAD + joints(100.0, 0.0) + "100.000000000 group idle -> streaming\n" + "".join(
    f"{100.0 + 0.02 * i:.9f} order setpoint {{time: {100.0 + 0.02 * i:.9f}, joint_names: [\"shoulder\"], positions: [{0.01 * i}], "
    f"answer: {'accepted' if i != 30 else chr(34) + 'refused: too old' + chr(34)}}}\n" for i in range(50) if i not in (10, 11, 20)) + joints(101.0, 0.5)
REPORT = """valid: True
message: "motion of 2 s"
name: [shoulder, slide]
bus: [can0, can0]
unit: [rad, m]
worst_deviation: [0.75, nan]
final_deviation: [0.25, nan]
"""


def plot(*arguments, **environment):
    return subprocess.run(["/usr/bin/python3", str(SOURCE / "plot"), *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, timeout=120, env={**os.environ, **environment})


@pytest.fixture
def write(tmp_path):
    def to_file(name, text):
        path = tmp_path / name
        path.write_text(text)
        return str(path)

    return to_file


@pytest.fixture
def svg_of(tmp_path):
    """The picture as SVG, in which texts are texts."""
    def draw(*arguments):
        path = tmp_path / "picture.svg"
        result = plot(*arguments, "--output", path)
        assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
        return path.read_text()

    return draw


def texts(svg):
    return [re.sub(r"<[^>]*>", "", text).strip() for text in re.findall(r"<text.*?</text>", svg, re.DOTALL)]


# ISO 11898-1: 47 bits and the data, interframe space with them, and a stuff bit after five of a kind. SYNC is 0 000 1 0000000 0 0 0 0000 and
# its CRC: after the start of frame and 3 identifier bits come a 1, seven 0 of the identifier, RTR, IDE, r0 and four of the length.
@pytest.mark.parametrize("frame, bits", [("080#", 51), ("201#0000000000000000", 125), ("201#FFFFFFFFFFFFFFFF", 124)])
def test_bits_of_a_frame_are_those_of_the_driver(frame, bits):
    assert wire.frame_bits(frame) == bits


def test_bits_of_any_frame_are_within_the_standard():
    for length in range(9):
        for octet in ("00", "FF", "55", "F8", "1F"):
            bits = wire.frame_bits("7FF#" + octet * length)
            assert 47 + 8 * length <= bits <= 47 + 8 * length + (33 + 8 * length) // 4
            extended = wire.frame_bits("12345678#" + octet * length)
            assert 67 + 8 * length <= extended <= 67 + 8 * length + (53 + 8 * length) // 4


def test_load_is_bits_against_the_bit_rate():
    counter = wire.LoadCounter()
    counter.add_bus("can0", 500000.0)
    counter.add_bus("line0", 57600.0)
    for i in range(400):  # 1000 a second for 0.4 s
        counter.add(7.0 + 0.001 * i + 1e-6, "can0", "080#", False)
        counter.add(7.0 + 0.001 * i + 1e-6, "line0", "@\\x10", True)  # two characters and a CR
    loads = counter.loads()
    assert loads["can0"].by_kind == {"SYNC, TIME": pytest.approx([1000 * 51 / 500000.0] * 2)}
    assert loads["can0"].times == pytest.approx([7.15, 7.25])
    assert loads["line0"].by_kind == {"replies": pytest.approx([1000 * 33 / 57600.0] * 2)}


def test_replies_of_a_serial_line_are_no_frames():
    counter = wire.LoadCounter()
    counter.add_bus("line0", 57600.0)
    for i in range(30):
        counter.add(0.01 * i, "line0", "# 10 000C 1234", True)
    assert list(counter.loads()["line0"].by_kind) == ["replies"]


def test_a_recording_is_read(write):
    session = inputs.read_all([write("r.txt", GOOD), write("report", REPORT)], RATES)
    assert list(session.joints) == ["shoulder", "slide"]
    shoulder, slide = session.joints.values()
    assert (shoulder.unit, slide.unit) == ("rad", "m")
    assert (shoulder.deviation_bound, slide.deviation_bound) == (1.0, 3)
    assert shoulder.desired[:3] == [0.0, 0.05, 0.1]  # the second look found nothing new
    assert shoulder.actual[0] == -0.002
    assert shoulder.buffer[0] == 0.45
    assert (shoulder.worst_deviation, shoulder.final_deviation) == (0.75, 0.25)
    (goal,) = session.goals
    assert (goal.number, goal.outcome, goal.end) == (4, "succeeded", 103.0)
    assert session.begin_of_motion() == 101.0
    assert session.loads["can0"].limit == 0.5
    assert session.loads["can0"].total()[2] == pytest.approx(1000 * 51 / 500000.0)


def test_answers_that_are_repeated_make_no_stairs_in_motion(write):
    text = HEAD + "".join(f"{100.0 + 0.02 * i:.9f} joint shoulder {0.1 * (i // 5)} 1 {0.1 * (i // 5)} {1 if i < 15 else 0} 0 0\n" for i in range(20))
    shoulder = inputs.read_all([write("r.txt", text)], RATES).joints["shoulder"]
    assert shoulder.times == pytest.approx([100.0, 100.1, 100.2, 100.3, 100.32, 100.34, 100.36, 100.38])
    assert shoulder.actual == pytest.approx([0.0, 0.1, 0.2] + 5 * [0.3])
    assert len(shoulder.buffer) == 20


def test_the_commit_horizon_is_shown_where_buffers_come_to_it(write, svg_of):
    assert "commit_horizon" not in texts(svg_of(write("r.txt", GOOD.replace(" 0.45\n", " 0.02\n"))))


def test_recordings_without_buffers_are_read(write, svg_of):
    text = re.sub(r"( joint \S+(?: \S+){5}) \S+\n", r"\1\n", GOOD)
    assert "motion in" not in texts(svg_of(write("r.txt", text)))


def test_a_goal_has_its_panels_with_units(write, svg_of):
    shown = texts(svg_of(write("r.txt", GOOD), write("report", REPORT)))
    for text in ("Goal 4 SUCCEEDED", "shoulder", "slide", "moving", "position", "rad, m", "velocity", "rad/s, m/s", "following error", "mrad, mm",
                 "motion in", "buffer  s", "commit_horizon", "load of", "can0  %", "max_load", "SYNC, TIME", "0.75",
                 "not known: a real drive does not tell each sample"):
        assert text in shown, text


def test_a_fault_is_drawn_around_it(write, svg_of):
    shown = texts(svg_of(write("r.txt", FAULT)))
    for text in ("Joint shoulder: over-temperature", "s after the fault", "operation enabled", "fault", "drives",
                 "Joint shoulder: over-temperature. Let it cool.", "+0.050 s"):
        assert text in shown, text


def test_a_stream_tells_what_is_lost_and_refused(write, svg_of):
    assert "Stream of 46 setpoints, 3 lost on the way, 1 refused" in texts(svg_of(write("r.txt", STREAM)))


def test_a_wire_log_shows_its_buses(write, svg_of):
    log = "".join(f"({5.0 + 0.01 * i:.6f}) can0 182#00\n({5.0 + 0.01 * i:.6f}) line0 > @16 0\n" for i in range(100))
    shown = texts(svg_of(write("w.log", log)))
    for text in ("Load of can0, line0", "PDO", "requests", "can0  %", "line0  %"):
        assert text in shown, text


def test_joints_keep_their_colours(write, svg_of):
    def colour(svg, name):
        legend = svg[svg.index('id="legend_1"'):]
        return re.findall(r"stroke: (#[0-9a-f]{6})", legend[:legend.index(f">{name}</text>")])[-1]

    recording = write("r.txt", GOOD)
    both, one = svg_of(recording), svg_of(recording, "--joints", "slide")
    assert colour(both, "slide") == colour(one, "slide") != colour(both, "shoulder")
    assert "shoulder" not in texts(one)


@pytest.mark.parametrize("suffix, begin", [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")])
def test_every_form_of_picture(write, tmp_path, suffix, begin):
    path = tmp_path / f"picture.{suffix}"
    assert plot(write("r.txt", GOOD), "-o", path).returncode == 0
    assert path.read_bytes().startswith(begin)


def test_a_bag_is_drawn(tmp_path, svg_of):
    import rosbag
    import rospy
    from control_msgs.msg import JointTrajectoryControllerState
    from interpolated_motion_driver.msg import BufferStatus, DriveState
    path = str(tmp_path / "x.bag")
    with rosbag.Bag(path, "w") as bag:
        for i in range(20):
            stamp = rospy.Time.from_sec(50.0 + 0.1 * i)
            state = JointTrajectoryControllerState(joint_names=["shoulder"])
            state.desired.positions, state.desired.velocities = [0.1 * i], [1.0]
            state.actual.positions, state.actual.velocities = [0.1 * i], [1.0]
            buffers = BufferStatus(name=["shoulder"], bus=["can7"], fill_time=[0.5], bus_load=[0.25])
            drives = DriveState(name=["shoulder"], unit=["rad"], state=["Operation enabled"], online=[True])
            for topic, message in (("/arm/state", state), ("/arm/buffer_status", buffers), ("/arm/drive_states", drives)):
                message.header.stamp = stamp
                bag.write(topic, message, stamp)
    shown = texts(svg_of(path))
    for text in ("Motion", "shoulder", "rad/s", "can7  %", "can7 at most 25 %"):
        assert any(text in each for each in shown), text


@pytest.mark.parametrize("content, reason", [
    ("nothing of ours\n", "is neither a flight recording nor a bag, a wire log or a motion report"),
    (HEAD.replace("version: 1", "version: 2"), "version 2 of recordings; this program reads version 1"),
    (HEAD.replace("---\n", ""), "the line --- that ends the head"),
    (HEAD + "100.0 joint shoulder 1 2\n", "line 12 is not as docs/recording.md tells: 100.0 joint shoulder 1 2"),
    (HEAD + "100.0 wire can9 > 080#\n", "line 12"),
    (HEAD + "100.0 order goal {id: [}\n", "an order: "),
    ("(1.000000) can0 080#\nhello\n", "line 2 is not as a wire log has it: hello"),
    ("(1.000000) can0 080#\n(1.000000) can0 080#0\n", "line 2 is not as a wire log has it: (1.000000) can0 080#0"),
    (REPORT.replace("True", "False"), "motion of 2 s"),
    ("worst_deviation: {", "is no motion report"),
], ids=range(10))
def test_a_bad_file_is_told(write, tmp_path, content, reason):
    result = plot(write("bad", content), "-o", tmp_path / "x.png")
    assert (result.returncode, result.stdout) == (2, "")
    assert reason in result.stderr
    assert result.stderr.count("\n") == 1


@pytest.mark.parametrize("arguments, reason", [
    ([], "required: FILE"),
    (["missing.txt"], "missing.txt is not there"),
    (["."], ". is no file"),
    (["x", "--output", "x.gif"], "--output x.gif: a name that ends in .png, .svg or .pdf is wanted"),
    (["x", "--show", "all"], "invalid choice: 'all'"),
    (["x", "--from", "3", "--to", "2"], "--from 3 is not before --to 2"),
    (["x", "--bitrate", "5"], "--bitrate 5: 10000..1000000 bit/s is allowed"),
])
def test_bad_arguments_are_told(arguments, reason, tmp_path):
    result = plot(*arguments)
    assert (result.returncode, result.stdout) == (2, "")
    assert reason in result.stderr
    assert result.stderr.count("\n") == 1


def test_joints_that_are_not_there_are_told(write, tmp_path):
    result = plot(write("r.txt", GOOD), "--joints", "elbow", "-o", tmp_path / "x.png")
    assert (result.returncode, result.stderr) == (2, "plot: --joints elbow: there are shoulder, slide\n")


def test_without_matplotlib_the_cure_is_told(write, tmp_path):
    (tmp_path / "matplotlib.py").write_text("raise ImportError('as if it were not installed')\n")
    result = plot(write("r.txt", GOOD), "-o", tmp_path / "x.png", PYTHONPATH=str(tmp_path))
    assert (result.returncode, result.stdout) == (2, "")
    assert "apt install python3-matplotlib" in result.stderr
