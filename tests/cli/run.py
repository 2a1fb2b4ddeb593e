#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The contract tests of the command line: tests/cli/run.py --trysquare build/dev/trysquare [--fast | --slow] [-k TEXT]

Needs Python 3.10 with jsonschema, nothing else. Exit status: 0 all passed, 1 not. Skipped tests are listed loudly, and
with CI=true they are a failure where the real data is present.
"""

import argparse
import os
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parent / "oracle"))

import support  # noqa: E402  (needs the path above)


def flattened(suite):
    for test in suite:
        if isinstance(test, unittest.TestSuite):
            yield from flattened(test)
        else:
            yield test


def is_slow(test):
    return getattr(getattr(test, test._testMethodName, None), "is_slow", False)


def selected_tests(patterns, fast, only_slow):
    loader = unittest.TestLoader()
    tests = list(flattened(loader.discover(str(HERE), pattern="test_*.py")))
    if patterns:
        tests = [t for t in tests if any(p in t.id() for p in patterns) or "_FailedTest" in t.id()]
    left_out = [t for t in tests if (fast and is_slow(t)) or (only_slow and not is_slow(t))]
    return unittest.TestSuite(t for t in tests if t not in left_out), left_out


def main():
    parser = argparse.ArgumentParser(description="Contract tests of the trysquare command.")
    parser.add_argument("--trysquare", required=True, type=Path, help="the command under test")
    parser.add_argument("--fast", action="store_true", help="leave out the long runs on real data")
    parser.add_argument("--slow", action="store_true", help="run only what --fast leaves out")
    parser.add_argument("-k", action="append", default=[], metavar="TEXT", help="only tests whose name contains TEXT")
    parser.add_argument("-v", action="store_true", help="name every test")
    arguments = parser.parse_args()

    command = arguments.trysquare.resolve()
    if not os.access(command, os.X_OK) or command.is_dir():
        print(f"{command}: not an executable", file=sys.stderr)
        return 1
    support.COMMAND = str(command)

    suite, left_out = selected_tests(arguments.k, arguments.fast, arguments.slow)
    result = unittest.TextTestRunner(verbosity=2 if arguments.v else 1).run(suite)
    if left_out:
        print(f"left out, as asked: {len(left_out)} tests")
    for test, reason in result.skipped:
        print(f"!!! SKIPPED {test.id()}: {reason}")
    may_skip = os.environ.get("CI") != "true" or support.data_folder() is None
    if result.skipped and not may_skip:
        print("!!! CI=true and the data is there: skipping is a failure")
    return 0 if result.wasSuccessful() and result.testsRun > 0 and (may_skip or not result.skipped) else 1


if __name__ == "__main__":
    sys.exit(main())
