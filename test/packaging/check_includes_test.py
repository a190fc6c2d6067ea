"""scripts/check_includes must find each kind of violation, and nothing else."""

import importlib.machinery
import importlib.util
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "check_includes"


def load():
    loader = importlib.machinery.SourceFileLoader("check_includes", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_includes", loader))
    loader.exec_module(module)
    return module


check_includes = load()
ARROWS = check_includes.read_arrows((ROOT / "cmake" / "stages.cmake").read_text())


def faults(stage, text, file=""):
    return check_includes.check_text(stage, text, ARROWS, file)


def ours(header):
    return f'#include "interpolated_motion_driver/{header}"\n'


@pytest.mark.parametrize("stage, header", [
    ("units", "interpolation/pvt_record.h"),
    ("interpolation", "trajectory/path.h"),
    ("trajectory", "encoding/pvt_encoder.h"),
    ("protocol", "axis/axis.h"),
    ("encoding", "axis/axis.h"),
    ("axis", "motion/group.h"),
    ("axis", "transport/can_bus.h"),
    ("motion", "hardware/configuration.h"),
    ("motion", "recording/flight_recorder.h"),
    ("recording", "transport/can_bus.h"),
    ("recording", "hardware/configuration.h"),
    ("transport", "emulation/drive.h"),
    ("emulation", "encoding/pvt_encoder.h"),
    ("emulation", "axis/axis.h"),
    ("emulation", "protocol/canopen/sdo_client.h"),
    ("hardware", "node/clock.h"),
    ("node", "tools/client.h"),
    ("emulated_drives", "node/clock.h"),
    ("hardware", "command_line/option_set.h"),
    ("command_line", "hardware/configuration.h"),
])
def test_an_arrow_that_runs_back_is_found(stage, header):
    assert len(faults(stage, ours(header))) == 1


@pytest.mark.parametrize("file, header", [
    ("axis/epos/epos_axis.h", "axis/cyclic/telemetry.h"),
    ("axis/silverlode/status.cpp", "axis/epos/record_feed.h"),
    ("emulation/cyclic/fine_interpolation.h", "emulation/epos/spline_segment.h"),
    ("emulation/silverdust/axis.h", "emulation/epos/pvt_buffer.h"),
    ("hardware/epos/drive_kind.cpp", "axis/silverlode/silverlode_axis.h"),
    ("hardware/epos/drive_kind.cpp", "emulation/cyclic/cyclic_drive.h"),
    ("axis/cyclic/cyclic_axis.cpp", "encoding/pvt/pvt_encoder.h"),
])
def test_a_kind_of_drive_knows_no_other(file, header):
    (line, reason), = faults(file.split("/")[0], ours(header), file)
    assert "knows no other" in reason


@pytest.mark.parametrize("file, header", [
    ("axis/axis.cpp", "axis/epos/epos_axis.h"),
    ("axis/cia402/cia402_axis.h", "axis/epos/epos_parameters.h"),
    ("encoding/transmission.h", "encoding/ims/ims_encoder.h"),
    ("emulation/world.h", "emulation/silverdust/silverdust.h"),
    ("emulation/canopen/canopen_node.cpp", "emulation/epos/epos_objects.h"),
    ("hardware/assembly.cpp", "hardware/epos/drive_kind.h"),
    ("hardware/assembly.cpp", "axis/cyclic/cyclic_axis.h"),
    ("hardware/drive_kinds.h", "hardware/epos/drive_kind.h"),
    ("motion/group.cpp", "axis/epos/epos_axis.h"),
    ("node/main.cpp", "emulation/epos/epos_drive.h"),
    ("emulated_drives/server.cpp", "hardware/cyclic/drive_kind.h"),
    ("hardware/assembly.cpp", "hardware/standstill/drive_kind.h"),
])
def test_what_is_for_all_kinds_of_drives_knows_none(file, header):
    (line, reason), = faults(file.split("/")[0], ours(header), file)
    assert "knows none" in reason


def test_a_kind_is_found_behind_a_relative_path_too():
    assert len(faults("emulation", '#include "epos/epos_drive_implementation.h"\n', "emulation/world.cpp")) == 1
    assert faults("emulation", '#include "epos_drive_implementation.h"\n', "emulation/epos/epos_drive.cpp") == []


@pytest.mark.parametrize("file, header", [
    ("hardware/drive_kinds.cpp", "hardware/epos/drive_kind.h"),
    ("hardware/silverlode/drive_kind.cpp", "emulation/silverdust/silverdust.h"),
    ("hardware/silverlode/drive_kind.cpp", "axis/silverlode/silverlode_axis.h"),
    ("axis/epos/epos_axis.cpp", "encoding/pvt/pvt_encoder.h"),
    ("axis/silverlode/segment_feed.h", "encoding/ims/ims_encoder.h"),
    ("axis/epos/epos_axis.h", "axis/cia402/cia402_axis.h"),
    ("emulation/cyclic/cyclic_drive.h", "emulation/canopen/canopen_drive.h"),
    ("hardware/drive_parameters.h", "axis/cia402/cia402_parameters.h"),
    ("hardware/serial_link.h", "protocol/silverlode/line_master.h"),
    ("axis/epos/epos_axis.cpp", "axis/playback_clock.h"),
])
def test_a_kind_is_known_to_itself_and_to_the_list(file, header):
    assert faults(file.split("/")[0], ours(header), file) == []


@pytest.mark.parametrize("stage, header", [
    ("interpolation", "units/time.h"),
    ("encoding", "trajectory/path.h"),
    ("axis", "trajectory/path.h"),
    ("motion", "axis/axis.h"),
    ("transport", "protocol/canopen/frame.h"),
    ("emulation", "protocol/canopen/frame.h"),
    ("emulation", "interpolation/pvt_record.h"),
    ("hardware", "emulation/drive.h"),
    ("node", "hardware/configuration.h"),
    ("node", "DriveState.h"),
    ("emulated_drives", "hardware/drive_kind.h"),
    ("emulated_drives", "command_line/option_set.h"),
    ("tools", "command_line/option_set.h"),
    ("node", "command_line/option_set.h"),
])
def test_an_arrow_of_the_table_is_allowed(stage, header):
    assert faults(stage, ours(header)) == []


@pytest.mark.parametrize("stage, line", [
    ("hardware", "#include <ros/ros.h>"),
    ("emulated_drives", "#include <ros/ros.h>"),
    ("motion", "#include <control_msgs/FollowJointTrajectoryAction.h>"),
    ("hardware", "#include <actionlib/server/action_server.h>"),
    ("hardware", '#include "interpolated_motion_driver/DriveState.h"'),
    ("axis", "#include <linux/can.h>"),
    ("node", "#include <sys/socket.h>"),
    ("emulation", "#include <termios.h>"),
    ("hardware", "  #  include   <fcntl.h>"),
    ("motion", "#include <thread>"),
    ("axis", '#include "../motion/group.h"'),
])
def test_a_header_of_another_world_is_found(stage, line):
    assert len(faults(stage, line + "\n")) == 1


@pytest.mark.parametrize("stage, line", [
    ("axis", "auto now = std::chrono::steady_clock::now();"),
    ("axis", "auto now = Clock::now();"),
    ("hardware", "const auto t = ros::Time::now();"),
    ("motion", "std::this_thread::sleep_for(1ms);"),
    ("emulation", "usleep(10);"),
    ("protocol", "clock_gettime(CLOCK_MONOTONIC, &t);"),
])
def test_reading_a_clock_or_sleeping_is_found(stage, line):
    assert len(faults(stage, line + "\n")) == 1


@pytest.mark.parametrize("stage, line", [
    ("transport", "auto now = std::chrono::steady_clock::now();"),
    ("node", "ros::Time::now();"),
    ("transport", "#include <linux/can.h>"),
    ("axis", "// unlike steady_clock::now() this is given"),
    ("axis", "/* #include <ros/ros.h> */"),
    ("axis", 'const char* text = "sleep_for()";'),
    ("axis", "void advance(HostTime now);"),
])
def test_what_is_allowed_or_only_spoken_of_is_not_found(stage, line):
    assert faults(stage, line + "\n") == []


def test_the_line_of_the_violation_is_told():
    text = "/* two\nlines */\n" + ours("units/time.h") + ours("motion/group.h")
    assert [line for line, _ in faults("axis", text)] == [4]


def test_an_unknown_stage_is_a_violation():
    assert len(faults("helpers", "")) == 1


def test_the_program_fails_on_a_violating_tree_and_passes_on_a_clean_one(tmp_path):
    (tmp_path / "cmake").mkdir()
    (tmp_path / "cmake" / "stages.cmake").write_text((ROOT / "cmake" / "stages.cmake").read_text())
    source = tmp_path / "src" / "axis" / "epos" / "feeder.cpp"
    source.parent.mkdir(parents=True)
    source.write_text(ours("axis/axis.h"))
    assert subprocess.run([SCRIPT, tmp_path], stdout=subprocess.PIPE).returncode == 0

    source.write_text(ours("axis/axis.h") + ours("motion/group.h"))
    result = subprocess.run([SCRIPT, tmp_path], stdout=subprocess.PIPE, text=True)
    assert result.returncode == 1
    assert "src/axis/epos/feeder.cpp:2: axis must not include motion/" in result.stdout


def test_a_tree_without_sources_is_no_success(tmp_path):
    (tmp_path / "cmake").mkdir()
    (tmp_path / "cmake" / "stages.cmake").write_text("")
    assert subprocess.run([SCRIPT, tmp_path], stdout=subprocess.PIPE).returncode == 1
