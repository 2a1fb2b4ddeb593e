# SPDX-License-Identifier: Apache-2.0
"""KITTI 00 against the oracle: four trajectories, two radii, two orthogonal subsets; every number, to 1e-9 relative.

One full run per trajectory and radius with the first subset; the second subset needs MOM and OMME only, which is quick.
"""

import math

from support import DataTest, slow

# scans_per_neighborhood_mean and multi_scan_share over the used queries, by scipy: for each scan, is its nearest point
# nearer than the radius? The oracle file does not hold them.
OVERLAP = {
    ("gt_calibrated", 0.5): (16.81086050502574, 0.9987946392089564),
    ("gt_WITHOUT_calibration", 0.5): (1.740928235025623, 0.45403431606464867),
    ("gt_calibrated", 1.0): (18.810827895595434, 0.9997349102773246),
    ("gt_WITHOUT_calibration", 1.0): (3.3703476733259796, 0.9840462474976509),
}


def warning_text(document):
    return " ".join(f"{w['code']} {w['message']}" for w in document["warnings"]).lower()


class KittiTest(DataTest):
    def setUp(self):
        super().setUp()
        self.kitti = self.data / "kitti00"

    def arguments(self, name, radius):
        calibration = self.kitti / "calib.txt"
        poses, options = {
            "gt_calibrated": (self.kitti / "poses.txt", ("--calib", calibration)),
            "gt_WITHOUT_calibration": (self.kitti / "poses.txt", ("--no-calib",)),
            "icp": (self.oracle_folder / "kitti00_icp.txt", ()),
            "ba_refined": (self.oracle_folder / "kitti00_adjusted.txt", ()),
        }[name]
        return (self.kitti / "velodyne", poses, *options, "--radius", radius, "--query-every", 50)

    def subset(self, kind):
        return ("--subset", self.oracle_folder / f"kitti_orth_{kind}_*.npy")

    def test_a_reference_keeps_its_own_calibration(self):
        """The reference is in the camera's frame with a calib.txt beside it, the estimate in the scanner's without."""
        for name in ("icp", "ba_refined"):
            poses = self.arguments(name, 0.5)[1]
            document = self.evaluate(
                self.kitti / "velodyne", poses, "--reference", self.kitti / "poses.txt",
                "--radius", 0.5, "--query-every", 5000, "--metrics", "mpv",
            )  # fmt: skip
            expected = self.oracle("map_oracle.json")["kitti"][name]["rpe_vs_gt_calibrated"]["std"]
            self.assert_relative(document["reference"]["rpe"]["rmse"], expected["rmse"], 1e-5, name)
            self.assertEqual(document["inputs"]["reference_extrinsic"], "calib.txt:Tr")
            self.assertIsNone(document["inputs"]["extrinsic"])

    def check_subset(self, document, expected):
        mom, omme = document["metrics"]["mom"], document["metrics"]["omme"]
        self.assert_relative(mom["value"], expected["mom_paper"], what="mom")
        self.assert_relative(mom["mean_of_means"], expected["mom_paper"], what="mom paper")
        self.assert_relative(mom["sum_of_medians"], expected["mom_reference"], what="mom map-metrics")
        self.assert_relative(omme["mean_of_means"], expected["omme_paper"], what="omme paper")
        self.assertEqual(len(mom["directions"]), 3)
        for i, direction in enumerate(mom["directions"]):
            self.assert_relative(direction["mean"], expected["mean_lmin"][i], what=f"direction {i} mean")
            self.assert_relative(direction["median"], expected["median_lmin"][i], what=f"direction {i} median")

    def check(self, name, radius):
        expected = self.oracle("map_oracle.json")["kitti"][name][f"r{radius}"]
        arguments = self.arguments(name, radius)
        only_mom = self.evaluate(*arguments, *self.subset("paper"), "--metrics", "mom,omme", exit_codes=(0, 4))
        self.check_subset(only_mom, expected["orth_paper"])

        document = self.evaluate(*arguments, *self.subset("reference"), exit_codes=(0, 4))
        self.check_subset(document, expected["orth_reference"])
        inputs, metrics = document["inputs"], document["metrics"]
        self.assertEqual(inputs["num_scans"], 20)
        num_records = sum(f.stat().st_size for f in (self.kitti / "velodyne").glob("*.bin")) // 16
        self.assertEqual(inputs["num_points"] + inputs["num_dropped_points"], num_records)
        for metric in ("mme", "mpv"):
            result = metrics[metric]
            self.assert_relative(result["value"], expected[metric], what=metric)
            self.assertEqual(result["num_used"], expected["used"])
            self.assertEqual(result["num_degenerate"], expected["degenerate"])
            self.assertEqual(result["num_queries"], math.ceil(inputs["num_points"] / 50))
            self.assertEqual(result["num_used"] + result["num_too_few"], result["num_queries"])
        self.assert_relative(document["overlap"]["neighbors_mean"], expected["mean_neighbours"])
        if (name, radius) in OVERLAP:
            mean, share = OVERLAP[name, radius]
            self.assert_relative(document["overlap"]["scans_per_neighborhood_mean"], mean)
            self.assert_relative(document["overlap"]["multi_scan_share"], share)
        return document

    def check_good(self, name, radius):
        document = self.check(name, radius)
        self.assertIs(document["verdict"]["meaningful"], True)
        self.assertNotIn("camera", warning_text(document), "a false alarm")
        return document

    def test_calibrated_r05(self):
        document = self.check_good("gt_calibrated", 0.5)
        self.assertEqual(document["inputs"]["extrinsic"], "calib.txt:Tr")
        self.assertEqual(document["inputs"]["poses_format"], "kitti")

    @slow
    def test_calibrated_r10(self):
        self.check_good("gt_calibrated", 1.0)

    @slow
    def test_without_calibration_r05(self):
        """The trap: every metric looks better. The overlap and the warning say otherwise."""
        document = self.check("gt_WITHOUT_calibration", 0.5)
        self.assertIs(document["verdict"]["meaningful"], False)
        self.assertLess(document["overlap"]["multi_scan_share"], 0.8)
        self.assertTrue(document["verdict"]["reasons"])
        self.assertIn("camera", warning_text(document))

    @slow
    def test_without_calibration_r10(self):
        document = self.check("gt_WITHOUT_calibration", 1.0)
        self.assertIn("camera", warning_text(document))

    @slow
    def test_icp_r05(self):
        self.check_good("icp", 0.5)

    @slow
    def test_icp_r10(self):
        self.check_good("icp", 1.0)

    @slow
    def test_adjusted_r05(self):
        self.check_good("ba_refined", 0.5)

    @slow
    def test_adjusted_r10(self):
        self.check_good("ba_refined", 1.0)


class KittiFrameTest(DataTest):
    """Every 4th scan, every 1000th point: what does not need the full data."""

    def setUp(self):
        super().setUp()
        kitti = self.data / "kitti00"
        self.inputs = (kitti / "velodyne", kitti / "poses.txt", "--radius", 1, "--query-every", 1000, "--every", 4)

    def test_the_calibration_beside_the_poses_is_used_and_reported(self):
        found = self.run_ok("evaluate", *self.inputs, "--metrics", "mpv", "--json", "-")
        given = self.run_ok(
            "evaluate", *self.inputs, "--metrics", "mpv", "--calib", self.inputs[1].parent / "calib.txt", "--json", "-"
        )
        found, given = found.json(), given.json()
        self.assertEqual(found["inputs"]["extrinsic"], "calib.txt:Tr")
        self.assertEqual(found["metrics"], given["metrics"])

    def test_the_forgotten_calibration_is_named_on_stderr_too(self):
        result = self.run_ok(
            "evaluate",
            *self.inputs,
            "--metrics",
            "mpv",
            "--no-calib",
            "--json",
            self.folder / "e.json",
            exit_codes=(0, 4),
        )
        self.assertIn("camera", result.stderr.lower())

    def test_a_data_set_root_is_recognised(self):
        root = self.inputs[0].parent
        rooted = self.evaluate(root, root / "poses.txt", *self.inputs[2:], "--metrics", "mpv")
        given = self.evaluate(*self.inputs, "--metrics", "mpv")
        self.assertEqual(rooted["metrics"], given["metrics"])
