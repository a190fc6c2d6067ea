"""The count that scripts/test ends with: nothing that went wrong may be missing from it."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "lib"))
import run_tests  # noqa: E402


def tally_of(tmp_path, xml, succeeded=True):
    result = tmp_path / "result.xml"
    if xml is not None:
        result.write_text(xml)
    tally = run_tests.Tally()
    tally.add_result("program", result, succeeded)
    return tally


def test_cases_are_counted_one_by_one(tmp_path):
    tally = tally_of(tmp_path, """<testsuites><testsuite name="a"><testcase name="x" status="run"/><testcase name="y" status="run">
        <failure message="expected 1, got 2"/></testcase><testcase name="z" status="notrun"/></testsuite>
        <testsuite name="b"><testcase name="x"/><testcase name="e"><error type="boom">text</error></testcase></testsuite></testsuites>""",
                     succeeded=False)
    assert tally.closing_line() == "2 passed, 2 failed, 1 skipped"
    assert [message for _, message in tally.failures] == ["expected 1, got 2", "text"]


def test_a_passing_program(tmp_path):
    assert tally_of(tmp_path, '<testsuite><testcase name="x"/></testsuite>').closing_line() == "1 passed, 0 failed"


def test_a_program_without_result_is_a_failure(tmp_path):
    assert tally_of(tmp_path, None, succeeded=False).closing_line() == "0 passed, 1 failed"


def test_a_half_written_result_is_a_failure(tmp_path):
    assert tally_of(tmp_path, "<testsuite><testcase").closing_line() == "0 passed, 1 failed"


def test_a_program_that_ran_nothing_is_a_failure(tmp_path):
    assert tally_of(tmp_path, "<testsuites tests='0'/>").closing_line() == "0 passed, 1 failed"


def test_a_program_that_crashed_after_its_last_case_is_a_failure(tmp_path):
    xml = '<testsuite><testcase name="x"/></testsuite>'
    assert tally_of(tmp_path, xml, succeeded=False).closing_line() == "1 passed, 1 failed"
