# SPDX-License-Identifier: Apache-2.0
"""`ape` and `rpe` against evo itself, for whoever has it: TRYSQUARE_EVO names a Python that can import evo 1.36
(`./run test` installs one in build/evo). All combinations of evo run in one process, tests/oracle/evo_matrix.py."""

import json
import os
import subprocess
import zipfile
from pathlib import Path

from support import REPOSITORY, DataTest, slow, trysquare

ORACLE = REPOSITORY / "tests" / "oracle" / "evo_matrix.py"


def evo_python():
    named = os.environ.get("TRYSQUARE_EVO")
    candidates = [Path(named)] if named else [REPOSITORY / "build" / "evo" / "bin" / "python"]
    return next((c for c in candidates if c.is_file()), None)


class EvoMatrixTest(DataTest):
    def setUp(self):
        super().setUp()
        self.python = evo_python()
        if self.python is None:
            self.skipTest("NO EVO: set TRYSQUARE_EVO to a Python that has evo 1.36.5")

    def close(self, actual, expected, unit):
        """Near zero 1e-12 m or rad, and as much in the other units."""
        near_zero = 1e-12 * {"%": 100, "mm": 1000, "cm": 100, "deg": 57.3}.get(unit, 1)
        return actual is not None and abs(actual - expected) <= max(1e-9 * abs(expected), near_zero)

    @slow
    def test_every_combination_of_options_has_the_statistics_of_evo(self):
        output = self.folder / "matrix.json"
        command = [str(self.python), str(ORACLE), str(self.data / "trajectories"), str(output)]
        subprocess.run(command, check=True, capture_output=True, env={**os.environ, "PYTHONWARNINGS": "ignore"})
        records = json.loads(output.read_text())
        self.assertGreaterEqual(len(records), 200)
        for record in records:
            with self.subTest(arguments=" ".join(record["arguments"])):
                self.check(record)

    def check(self, record):
        result = trysquare(*record["arguments"], "--json", "-")
        if record["stats"] is None:  # evo finds no pairs: ours is undefined, too
            self.assertEqual(result.exit_code, 4, result)
            return
        self.assertEqual(result.exit_code, 0, result)
        document = result.json()
        self.assertEqual(document["num_pairs"], record["num_pairs"])
        actual = document["statistics"]
        wrong = {k: (actual[k], v) for k, v in record["stats"].items() if not self.close(actual[k], v, document["unit"])}
        self.assertEqual({}, wrong)

    @slow
    def test_evo_res_opens_our_result_files(self):
        files = []
        reference, estimate = (self.data / "trajectories" / n for n in ("V102_groundtruth.csv", "V102.txt"))
        for verb, options in (("ape", ["-as"]), ("rpe", ["-d", "2", "-u", "m", "--all_pairs"])):
            files.append(self.folder / f"{verb}.zip")
            self.run_ok(verb, reference, estimate, *options, "--save-results", files[-1])
            with zipfile.ZipFile(files[-1]) as archive:
                self.assertIsNone(archive.testzip())
        for file in files:
            table = self.folder / f"{file.stem}.csv"
            command = [str(self.python.parent / "evo_res"), str(file), "--save_table", str(table), "--no_warnings"]
            result = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "HOME": str(self.folder)})
            self.assertEqual(result.returncode, 0, result.stderr + result.stdout)
            self.assertIn("rmse", table.read_text())

    @slow
    def test_arrays_of_result_files_are_those_of_evo(self):
        script = (
            "import json, sys\nfrom evo.tools import file_interface\n"
            "r = file_interface.load_res_file(sys.argv[1])\n"
            "print(json.dumps({'info': r.info, 'stats': r.stats,"
            " 'arrays': {k: v.tolist() for k, v in r.np_arrays.items()}}))"
        )
        ours = self.folder / "ours.zip"
        theirs = self.folder / "theirs.zip"
        files = [self.data / "trajectories" / n for n in ("V102_groundtruth.csv", "V102.txt")]
        for verb, options in (("ape", ["-a"]), ("rpe", ["-d", "1", "-u", "m"])):
            self.run_ok(verb, *files, *options, "--save-results", ours)
            environment = {**os.environ, "HOME": str(self.folder), "PYTHONWARNINGS": "ignore"}
            command = [str(self.python.parent / f"evo_{verb}"), "euroc", *map(str, files), *options]
            command += ["--save_results", str(theirs), "--no_warnings"]
            subprocess.run(command, check=True, capture_output=True, env=environment)
            a, b = (
                json.loads(subprocess.run([self.python, "-c", script, f], check=True, capture_output=True, env=environment).stdout)
                for f in (ours, theirs)
            )
            self.assertEqual(a["info"]["title"], b["info"]["title"])
            self.assertEqual(a["info"]["label"], b["info"]["label"])
            self.assertEqual(a["arrays"].keys(), b["arrays"].keys())
            for name, values in b["arrays"].items():
                self.assert_same_array(a["arrays"][name], values, f"{verb} {name}")

    @slow
    def test_evo_reads_the_trajectories_in_our_result_files_and_they_are_its_own(self):
        script = (
            "import sys\nimport numpy as np\nfrom evo import main_ape, main_rpe\n"
            "from evo.core import metrics, sync, units\nfrom evo.tools import file_interface\n"
            "verb, reference, estimate, ours = sys.argv[1:]\n"
            "pair = sync.associate_trajectories(file_interface.read_euroc_csv_trajectory(reference),"
            " file_interface.read_tum_trajectory_file(estimate))\n"
            "relation = metrics.PoseRelation.translation_part\n"
            "names = dict(ref_name='V102_groundtruth.csv', est_name='V102.txt')\n"
            "result = main_ape.ape(*pair, relation, align=True, **names) if verb == 'ape' else"
            " main_rpe.rpe(*pair, relation, delta=1.0, delta_unit=units.Unit.meters, align=True, **names)\n"
            "read = file_interface.load_res_file(ours, load_trajectories=True)\n"
            "assert read.trajectories.keys() == result.trajectories.keys(), read.trajectories.keys()\n"
            "for name, expected in result.trajectories.items():\n"
            "    actual = read.trajectories[name]\n"
            "    assert actual.num_poses == expected.num_poses\n"
            "    assert np.abs(actual.timestamps - expected.timestamps).max() < 1e-6\n"
            "    for x, y in zip(actual.poses_se3, expected.poses_se3):\n"
            "        assert np.abs(x - y).max() < 1e-6, (name, x - y)\n"
        )
        files = [self.data / "trajectories" / n for n in ("V102_groundtruth.csv", "V102.txt")]
        for verb, options in (("ape", ["-a"]), ("rpe", ["-a", "-d", "1", "-u", "m"])):
            ours = self.folder / f"{verb}.zip"
            self.run_ok(verb, *files, *options, "--save-results", ours)
            environment = {**os.environ, "HOME": str(self.folder), "PYTHONWARNINGS": "ignore"}
            command = [self.python, "-c", script, verb, *files, ours]
            result = subprocess.run(command, capture_output=True, text=True, env=environment)
            self.assertEqual(result.returncode, 0, result.stderr)

    def assert_same_array(self, actual, expected, name):
        self.assertEqual(len(actual), len(expected), name)
        for x, y in zip(actual, expected):
            if isinstance(x, list):
                self.assert_same_array(x, y, name)
            else:
                self.assertLessEqual(abs(x - y), max(1e-9 * abs(y), 1e-9), name)
