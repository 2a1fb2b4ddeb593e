# SPDX-License-Identifier: Apache-2.0
"""`trysquare compare`: which of several trajectories of the same scans is better. Truth: how they were made."""

import csv
import json
import math

import support
from support import CliTest, DataTest, validate


class SimulatedCompareTest(CliTest):
    def setUp(self):
        super().setUp()
        self.street = self.folder / "street"
        self.run_ok("simulate", "street", self.street, "--scans", 12, "--seed", 3, "--quiet")
        self.poses = {}
        for name, translation_m, seed in (("good", 0.01, 1), ("bad", 0.08, 2), ("worse", 0.08, 3)):
            self.poses[name] = self.folder / f"{name}.txt"
            self.run_ok("perturb", self.street / "poses.txt", "-o", self.poses[name], "--translation", translation_m,
                        "--rotation", 0.05, "--seed", seed)
        self.quick = ("--metrics", "rpe,mpv", "--query-every", 20)

    def compare(self, *names, options=()):
        result = self.run_ok("compare", self.street / "velodyne", *[self.poses[n] for n in names], *self.quick, *options,
                             "--json", "-")
        document = json.loads(result.stdout)
        validate(self, document, "comparison")
        return document

    def test_it_names_the_better(self):
        document = self.compare("bad", "good", "worse", options=("--out", self.folder / "out"))
        by_rpe = document["comparisons"][0]
        self.assertEqual(by_rpe["metric"], "rpe")
        self.assertEqual(document["verdict"]["best"], ["good"])
        # Six windows can tell two trajectories apart, not three: then intervals of the RPE decide.
        intervals = {t["name"]: t["interval_m"] for t in document["trajectories"]}
        for pair in by_rpe["pairs"]:
            self.assertFalse(pair["windows_can_tell"])
            first, second = intervals[pair["first"]], intervals[pair["second"]]
            expected = pair["first"] if first[1] < second[0] else pair["second"] if second[1] < first[0] else None
            self.assertEqual(pair["better"], expected)
        written = json.loads((self.folder / "out" / "comparison.json").read_text())
        self.assertEqual(written, document)
        with (self.folder / "out" / "windows.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 3 * 6)
        mean = {n: sum(float(r["rpe_m"]) for r in rows if r["trajectory"] == n) / 6 for n in ("bad", "good")}
        self.assert_relative(by_rpe["pairs"][0]["mean_difference"], mean["bad"] - mean["good"], 1e-9)

    def test_the_table_says_it_in_words(self):
        result = self.run_ok("compare", self.street / "velodyne", self.poses["bad"], self.poses["good"], *self.quick)
        self.assertRegex(result.stdout, r"good is better than bad by 0\.\d+ m a window \[0\.\d+, 0\.\d+\], p = 0\.031, 6 of 6 windows")
        self.assertIn("Best by RPE: good.", result.stdout)

    def test_the_same_bytes_for_every_number_of_threads(self):
        words = ("compare", self.street / "velodyne", self.poses["bad"], self.poses["good"], *self.quick, "--json", "-")
        self.assertEqual(self.run_ok(*words, "--threads", 1).stdout, self.run_ok(*words, "--threads", 3).stdout)

    def test_mistakes_are_told(self):
        for words, expected in (
            ((self.poses["good"],), "at least two POSES"),
            ((self.poses["good"], self.poses["bad"], "--window", 4, "--stride", 2), "overlap"),
            ((self.poses["good"], self.poses["good"]), "two trajectories are called"),
        ):
            result = support.trysquare("compare", self.street / "velodyne", *words)
            self.assertEqual(result.exit_code, 2, result)
            self.assertIn(expected, result.stderr)

    def test_only_scans_that_all_have_a_pose_for(self):
        """The bad one has no pose for two scans, told by time: ten remain."""
        rows = [[float(w) for w in line.split()] for line in self.poses["bad"].read_text().splitlines()]
        times = (self.street / "times.txt").read_text().split()
        self.poses["gaps"] = self.folder / "gaps.tum"
        with self.poses["gaps"].open("w") as file:
            for i, (time, m) in enumerate(zip(times, rows)):
                w = math.sqrt(1 + m[0] + m[5] + m[10]) / 2
                x, y, z = (m[9] - m[6]) / (4 * w), (m[2] - m[8]) / (4 * w), (m[4] - m[1]) / (4 * w)
                if i not in (2, 7):
                    print(time, m[3], m[7], m[11], x, y, z, w, file=file)
        document = self.compare("good", "gaps")
        self.assertEqual(document["inputs"]["num_scans"], 10)
        self.assertEqual(document["trajectories"][1]["poses_format"], "tum")
        self.assertEqual(document["verdict"]["best"], ["good"])


class KittiCompareTest(DataTest):
    def test_the_ground_truth_comes_last(self):
        document = self.run_ok("compare", self.data / "kitti00" / "velodyne", self.data / "kitti00" / "poses.txt",
                               self.oracle_folder / "kitti00_icp.txt", self.oracle_folder / "kitti00_adjusted.txt",
                               "--min-range", 2.8, "--metrics", "rpe", "--query-every", 1000, "--json", "-").json()
        ranks = {r["name"]: r["rank"] for r in document["comparisons"][0]["ranks"]}
        self.assertEqual(ranks, {"kitti00_adjusted": 1, "kitti00_icp": 2, "poses": 3})
        self.assertLess(document["adjusted_agreement_m"], 0.001)
