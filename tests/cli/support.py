# SPDX-License-Identifier: Apache-2.0
"""What every module of the contract tests shares: running the command, reading its JSON, finding the real data."""

import json
import math
import os
import re
import shutil
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
SCHEMAS = REPOSITORY / "docs" / "schema"
MEMORY_LIMIT_BYTES = 200 * 1024 * 1024

# Set by run.py before any test runs.
COMMAND = None
CASE_TIMEOUT_S = 300.0


class Result:
    """What one call of the command left behind."""

    def __init__(self, arguments, exit_code, stdout, stderr, seconds, peak_bytes):
        self.arguments = arguments
        self.exit_code = exit_code
        self.stdout = stdout
        self.stderr = stderr
        self.seconds = seconds
        self.peak_bytes = peak_bytes

    def json(self):
        return json.loads(self.stdout)

    def __str__(self):
        def shortened(text):
            return text if len(text) < 3000 else text[:1500] + "\n[...]\n" + text[-1500:]

        return (
            f"\n$ trysquare {' '.join(self.arguments)}\nexit {self.exit_code}"
            f"\n--- stdout\n{shortened(self.stdout)}\n--- stderr\n{shortened(self.stderr)}\n---"
        )


def clean_environment(extra=None):
    """The environment without what would change a result: settings, colors."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith("TRYSQUARE_") and k not in ("NO_COLOR", "COLUMNS")}
    kept["LC_ALL"] = "C.UTF-8"
    kept.update(extra or {})
    return kept


def trysquare(*arguments, environment=None, timeout_s=None, cwd=None):
    """Runs the command to its end. Peak memory is that of this very child (wait4), not of all children so far."""
    words = [str(a) for a in arguments]
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        start = time.monotonic()
        process = subprocess.Popen(
            [COMMAND, *words],
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=err,
            env=clean_environment(environment),
            cwd=cwd,
        )
        watchdog = threading.Timer(timeout_s or CASE_TIMEOUT_S, process.kill)
        watchdog.start()
        _, status, usage = os.wait4(process.pid, 0)
        watchdog.cancel()
        seconds = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)  # else Popen complains that nobody waited
        out.seek(0)
        err.seek(0)
        stdout = out.read().decode("utf-8", "replace")
        stderr = err.read().decode("utf-8", "replace")
    return Result(words, process.returncode, stdout, stderr, seconds, usage.ru_maxrss * 1024)


def slow(test):
    """Marks a test that --fast leaves out (not: skips)."""
    test.is_slow = True
    return test


def data_folder():
    """The folder that holds arcore-depth, kitti00 and trajectories; None when this machine has none."""
    named = os.environ.get("TRYSQUARE_DATA")
    candidates = [Path(named)] if named else []
    candidates.append(REPOSITORY.parent / "shared" / "data")
    return next((c for c in candidates if (c / "kitti00").is_dir()), None)


class CliTest(unittest.TestCase):
    """A test with a folder of its own and the assertions of this contract."""

    longMessage = True

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="trysquare_cli_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_ok(self, *arguments, exit_codes=(0,), **options):
        result = trysquare(*arguments, **options)
        self.assertIn(result.exit_code, exit_codes, result)
        return result

    def evaluate(self, *arguments, exit_codes=(0,), **options):
        """The JSON of `evaluate ARGUMENTS --json -`. Exit 0 and verdict.meaningful always say the same."""
        result = self.run_ok("evaluate", *arguments, "--json", "-", exit_codes=exit_codes, **options)
        document = result.json()
        self.assertEqual(document["verdict"]["meaningful"], result.exit_code == 0, result)
        return document

    def assert_relative(self, actual, expected, tolerance=1e-9, what=""):
        self.assertIsNotNone(actual, what)
        limit = tolerance * abs(expected)
        self.assertLessEqual(abs(actual - expected), limit, f"{what}: got {actual!r}, expected {expected!r}")

    def assert_usage_error(self, result, *words):
        self.assertEqual(result.exit_code, 2, result)
        self.assertEqual(result.stdout, "", result)
        for word in words:
            self.assertIn(str(word), result.stderr, result)

    def assert_no_escapes(self, *texts):
        for text in texts:
            self.assertNotIn("\x1b", text)


class DataTest(CliTest):
    """A test on the real data. Without it: skipped, and run.py says so loudly (an error under CI with data)."""

    def setUp(self):
        super().setUp()
        self.data = data_folder()
        if self.data is None:
            self.skipTest("NO REAL DATA: set TRYSQUARE_DATA to the folder with arcore-depth, kitti00, trajectories")
        self.oracle_folder = self.data.parent / "oracle"

    def oracle(self, name):
        return json.loads((self.oracle_folder / name).read_text())


def validate(test, document, schema_name):
    """Against docs/schema/<schema_name>.schema.json, draft as the schema says."""
    import jsonschema

    path = SCHEMAS / f"{schema_name}.schema.json"
    test.assertTrue(path.is_file(), f"{path} is missing")
    schema = json.loads(path.read_text())
    checker = jsonschema.validators.validator_for(schema)
    checker.check_schema(schema)
    errors = sorted(checker(schema).iter_errors(document), key=lambda e: list(map(str, e.path)))
    test.assertEqual([], [f"{'/'.join(map(str, e.path))}: {e.message}" for e in errors[:10]])


def all_numbers(document):
    """Every float of a JSON document."""
    if isinstance(document, dict):
        document = list(document.values())
    if isinstance(document, list):
        for part in document:
            yield from all_numbers(part)
    elif isinstance(document, float):
        yield document


def is_finite_document(document):
    return all(math.isfinite(x) for x in all_numbers(document))


def mentions_place(text):
    """Does an error message say the line or the byte?"""
    return re.search(r"\b(line|byte)\s+\d+", text) is not None
