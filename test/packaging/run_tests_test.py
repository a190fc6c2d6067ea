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
    tally = tally_of(tmp_path, """<testsuites><testsuite name="a"><testcase name="x/0" status="run"/><testcase name="y" status="run">
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


def tally_of_rostest(tmp_path, outer, inner, succeeded):
    (tmp_path / "rostest-some.xml").write_text(f'<testsuite><testcase classname="RosTest" name="testarm">{outer}</testcase></testsuite>')
    if inner is not None:
        (tmp_path / "rosunit-arm.xml").write_text(f"<testsuite>{inner}</testsuite>")
    tally = run_tests.Tally()
    tally.add_result("some.test", tmp_path / "rostest-some.xml", succeeded)
    return tally


PASSED = '<testcase name="x"/>'
FAILED = '<testcase name="y"><failure type="AssertionError">9 != 2</failure></testcase>'
PROBLEM = '<failure message="test failed"/>'


def test_the_cases_of_a_rostest_program_are_counted_one_by_one(tmp_path):
    assert tally_of_rostest(tmp_path, "", PASSED + PASSED, True).closing_line() == "2 passed, 0 failed"


def test_a_failed_case_of_a_rostest_program_is_named(tmp_path):
    tally = tally_of_rostest(tmp_path, "", PASSED + FAILED, False)
    assert tally.closing_line() == "1 passed, 1 failed"
    assert tally.failures[0][1] == "9 != 2"


def test_a_rostest_program_that_failed_beyond_its_cases_is_a_failure(tmp_path):
    assert tally_of_rostest(tmp_path, PROBLEM, PASSED, False).closing_line() == "1 passed, 1 failed"
    assert tally_of_rostest(tmp_path, PROBLEM, "", False).closing_line() == "0 passed, 1 failed"


def test_a_rostest_program_without_result_is_a_failure(tmp_path):
    assert tally_of_rostest(tmp_path, PROBLEM, None, False).closing_line() == "0 passed, 1 failed"


def test_results_of_an_earlier_run_are_removed_and_nothing_else(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    results = tmp_path / "results"
    results.mkdir()
    old = [results / "gtest-some.xml", results / "rostest-some.xml", results / "rosunit-arm.xml"]
    kept = [tmp_path / "package.xml", results / "other.xml"]
    for file in old + kept:
        file.write_text("<testsuite/>")
    run_tests.remove_old([old[0], old[1], results / "never-ran.xml", Path("no-result-file")])
    assert not any(file.exists() for file in old)
    assert all(file.exists() for file in kept)


def test_what_a_sanitizer_complains_of_is_a_failure(tmp_path):
    (tmp_path / "report.17").write_text("WARNING: ThreadSanitizer: data race\nmore")
    tally = run_tests.Tally()
    run_tests.add_reports(tmp_path, tally)
    assert tally.closing_line() == "0 passed, 1 failed"
    assert tally.failures[0][1].startswith("WARNING: ThreadSanitizer: data race")
