"""Runs the lints and every test that ctest knows, and counts the test cases: run_tests.py ROOT BUILD [address|thread]

With the name of the sanitizer that BUILD was made with: no lints, and unit tests and node tests only. Every process that a sanitizer
complains of counts as a failed case, whether or not its test has noticed.

Each ctest test writes one JUnit XML file; its cases are counted from there. A program that crashed, was killed, wrote no result or ran
no case counts as one failed case. The last line is "N passed, N failed".
"""

import json
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

TIMEOUT = 600  # s, for a test program
SANITIZED_TIMEOUT = 3000
# Of a sanitized build. Not those that run in a kernel of their own, what is no C++, and what measures processor time and memory.
SANITIZED_TESTS = ("-R", "_(gtest|rostest)_", "-E", r"_gtest_(socketcan|packaging)_tests$|_resources\.test$")
# They measure how long something takes, which a sanitizer multiplies by ten.
MEASURING_TESTS = "PlannerInputs.FiveThousandPointsArePlannedInMilliseconds"
LINES_OF_REPORT = 40
SYMBOLIZER = "/usr/bin/llvm-symbolizer-14"  # of Debian's llvm-14

LINTS = ("format", "includes", "classes", "catkin", "tidy")


def cases_of(result):
    """The cases in a result file. rostest writes one case, testNAME, for each program NAME that it ran, whose own cases are in
    rosunit-NAME.xml beside it: these count, and rostest's own only where there are none, or where it alone has failed."""
    cases = []
    for case in ElementTree.parse(result).getroot().iter("testcase"):
        inner = result.parent / ("rosunit-" + re.sub("^test", "", case.get("name", "")) + ".xml")
        if not result.name.startswith("rostest-") or not inner.exists():
            cases.append(case)
            continue
        inner_cases = list(ElementTree.parse(inner).getroot().iter("testcase"))
        cases += inner_cases
        if not inner_cases or problem_of(case) is not None and all(problem_of(inner_case) is None for inner_case in inner_cases):
            cases.append(case)
    return cases


def problem_of(case):
    """The <failure> or <error> of a test case, if it has one."""
    failure = case.find("failure")
    return failure if failure is not None else case.find("error")


class Tally:
    def __init__(self):
        self.passed = 0
        self.skipped = 0
        self.failures = []  # (name, message)

    def add_case(self, name, case):
        problem = problem_of(case)
        if problem is not None:
            self.failures.append((name, problem.get("message") or problem.text or ""))
        elif case.find("skipped") is not None or case.get("status") == "notrun" or case.get("result") in ("skipped", "suppressed"):
            self.skipped += 1
        else:
            self.passed += 1

    def add_result(self, test, result, succeeded):
        """Counts the cases of one test program; `result` is its XML file, `succeeded` whether ctest saw it pass."""
        before = len(self.failures)
        try:
            cases = cases_of(result)
        except (OSError, ElementTree.ParseError) as error:
            self.failures.append((test, f"no readable result: {error}"))
            return
        for case in cases:
            self.add_case(f"{test}: {case.get('classname', '')}.{case.get('name', '')}", case)
        if not cases:
            self.failures.append((test, "ran no test case"))
        elif not succeeded and len(self.failures) == before:
            self.failures.append((test, "every case passed, but the program failed: a crash at its end, or a time-out"))

    def closing_line(self):
        skipped = f", {self.skipped} skipped" if self.skipped else ""
        return f"{self.passed} passed, {len(self.failures)} failed{skipped}"


def ctest_tests(build, selection=()):
    """{name: result file} of every test that is registered, or selected by options of ctest."""
    listing = subprocess.run(["ctest", "--show-only=json-v1", *selection], cwd=build, stdout=subprocess.PIPE, check=True, text=True).stdout
    tests = {}
    for test in json.loads(listing)["tests"]:
        command = test.get("command", [])
        runner = next((i for i, word in enumerate(command) if word.endswith("/run_tests.py")), None)
        tests[test["name"]] = Path(command[runner + 1]) if runner is not None else Path("no-result-file")
    return tests


def readable(ctest_name):
    return re.sub(r"^_ctest_[a-z_]+?_(gtest|rostest|pytest)_", "", ctest_name)


def remove_old(results):
    """Removes what an earlier run left of these result files, and of the programs that rostest ran for them; nothing else."""
    for result in results:
        result.unlink(missing_ok=True)
        if result.name.startswith("rostest-"):
            for inner in result.parent.glob("rosunit-*.xml"):
                inner.unlink()


def run_ctest(build, tally, selection=(), timeout=TIMEOUT):
    tests = ctest_tests(build, selection)
    if not tests:
        tally.failures.append(("ctest", "no test is registered"))
        return
    remove_old(tests.values())
    failed_log = build / "Testing" / "Temporary" / "LastTestsFailed.log"
    failed_log.unlink(missing_ok=True)
    status = subprocess.call(["ctest", "--output-on-failure", "--timeout", str(timeout), "-j", str(os.cpu_count()), *selection], cwd=build)
    failed = {line.split(":", 1)[1] for line in failed_log.read_text().splitlines()} if failed_log.exists() else set()
    for name, result in sorted(tests.items()):
        tally.add_result(readable(name), result, name not in failed)
    if status and not tally.failures:
        tally.failures.append(("ctest", f"exit status {status}"))


def sanitizer_environment(root, reports):
    """The variables that tell the sanitizers what to leave out, and to write what they find into files in `reports`: nobody reads what
    the processes of a rostest print."""
    suppressions = root / "test" / "sanitizers"
    log = f"log_path={reports}/report"
    return {"ASAN_OPTIONS": f"{log}:detect_leaks=1:detect_stack_use_after_return=1",
            "UBSAN_OPTIONS": f"{log}:print_stacktrace=1",
            "LSAN_OPTIONS": f"suppressions={suppressions}/leaks.txt:print_suppressions=0",
            # ROS's libraries have not been built with the sanitizer: where they access memory, it does not see what orders it.
            "TSAN_OPTIONS": f"{log}:suppressions={suppressions}/threads.txt:second_deadlock_stack=1:print_suppressions=0:"
                            "ignore_noninstrumented_modules=1",
            "GTEST_FILTER": f"-{MEASURING_TESTS}",
            "ASAN_SYMBOLIZER_PATH": SYMBOLIZER, "TSAN_SYMBOLIZER_PATH": SYMBOLIZER}


def add_reports(reports, tally):
    for report in sorted(reports.glob("report.*")):
        lines = report.read_text(errors="replace").splitlines()
        tally.failures.append((f"sanitizer: {report}", "\n".join(lines[:LINES_OF_REPORT])))


def run_sanitized(root, build, tally):
    reports = build / "reports"
    reports.mkdir(exist_ok=True)
    for old in reports.glob("report.*"):
        old.unlink()
    os.environ.update(sanitizer_environment(root, reports))
    run_ctest(build, tally, SANITIZED_TESTS, SANITIZED_TIMEOUT)
    add_reports(reports, tally)


def run_lints(root, tally):
    for check in LINTS:
        print(f"\n== lint {check}", flush=True)
        if subprocess.call([root / "scripts" / "lint", check]) == 0:
            tally.passed += 1
        else:
            tally.failures.append((f"lint {check}", "see above"))


def main(arguments):
    root, build = Path(arguments[1]), Path(arguments[2])
    tally = Tally()
    if len(arguments) > 3:
        print(f"\n== tests, with the sanitizer {arguments[3]}", flush=True)
        run_sanitized(root, build, tally)
    else:
        run_lints(root, tally)
        print("\n== tests", flush=True)
        run_ctest(build, tally)
    print()
    for name, message in tally.failures:
        print(f"FAILED {name}\n    " + message.strip().replace("\n", "\n    "))
    print(tally.closing_line())
    return 1 if tally.failures or not tally.passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
