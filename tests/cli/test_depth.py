# SPDX-License-Identifier: Apache-2.0
"""The ARCore depth set against the oracle: every number, to 1e-9 relative."""

from support import DataTest


class DepthTest(DataTest):
    def setUp(self):
        super().setUp()
        depth = self.data / "arcore-depth"
        self.inputs = (depth / "pcs", depth / "poses", "--preset", "depth")
        self.subset = (
            "--subset",
            depth / "orth_subset" / "orth-0091-*.npy",
            "--subset-pose",
            depth / "poses" / "pose-0091.txt",
        )
        self.expected = self.oracle("map_oracle.json")["depth"]

    def test_mme_mpv_and_their_counts(self):
        document = self.evaluate(*self.inputs, "--metrics", "mme,mpv")
        self.assertEqual(document["inputs"]["num_scans"], 28)
        self.assertEqual(document["inputs"]["num_points"], self.expected["n_points"])
        self.assertEqual(document["settings"]["radius_m"], 0.2)
        for name, unit in (("mme", "nats"), ("mpv", "m2")):
            expected, actual = self.expected[f"{name}_reference"], document["metrics"][name]
            self.assert_relative(actual["value"], expected["value"], what=name)
            self.assertEqual(actual["unit"], unit)
            self.assertEqual(actual["num_queries"], self.expected["n_points"])
            self.assertEqual(actual["num_used"], expected["used"])
            self.assertEqual(actual["num_too_few"], expected["rejected"])
            self.assertEqual(actual["num_degenerate"], 0)
        neighbors = self.expected["mme_reference"]["mean_neighbours"]
        self.assert_relative(document["overlap"]["neighbors_mean"], neighbors)
        # By scipy's kd-tree over all 103 975 points; the oracle file does not hold them.
        self.assert_relative(document["overlap"]["scans_per_neighborhood_mean"], 7.645465649735989)
        self.assert_relative(document["overlap"]["multi_scan_share"], 0.9841882027064719)

    def check_orthogonal(self, document, name):
        actual = document["metrics"][name]
        paper, reference = self.expected[f"{name}_paper"], self.expected[f"{name}_reference"]
        self.assert_relative(actual["mean_of_means"], paper["value"], what=f"{name} paper")
        self.assert_relative(actual["sum_of_medians"], reference["value"], what=f"{name} map-metrics")
        self.assertEqual([d["num_points"] for d in actual["directions"]], self.expected["orth_sizes"])
        for i, direction in enumerate(actual["directions"]):
            self.assert_relative(direction["mean"], paper["per_direction"][i], what=f"{name} direction {i} mean")
            self.assert_relative(
                direction["median"], reference["per_direction"][i], what=f"{name} direction {i} median"
            )

    def test_mom_and_omme_as_in_the_paper(self):
        document = self.evaluate(*self.inputs, *self.subset, "--metrics", "mom,omme")
        self.check_orthogonal(document, "mom")
        self.check_orthogonal(document, "omme")
        metrics = document["metrics"]
        self.assert_relative(metrics["mom"]["value"], 0.0022034978851190544)
        self.assert_relative(metrics["omme"]["value"], -3.9649491408366573)
        self.assertIs(metrics["mom"]["follows_trajectory_error"], True)

    def test_mom_as_in_map_metrics(self):
        document = self.evaluate(*self.inputs, *self.subset, "--metrics", "mom,omme", "--definition", "map-metrics")
        self.check_orthogonal(document, "mom")
        self.assert_relative(document["metrics"]["mom"]["value"], 0.00618308233671337)

    def test_everything_at_once_has_a_value_and_exit_0(self):
        """The command of the issue: all metrics, subset, no exit code but 0."""
        document = self.evaluate(*self.inputs, *self.subset)
        self.assert_relative(document["metrics"]["mme"]["value"], -3.6144387057257514)
        self.assert_relative(document["metrics"]["mpv"]["value"], 0.0025390347963358565)
        self.assert_relative(document["metrics"]["mom"]["value"], 0.0022034978851190544)

    def test_mapeval_is_lower_by_a_constant_where_both_are_defined(self):
        """MapEval takes the query out, so only about: the same neighborhoods would give exactly ln(2 pi e) less."""
        document = self.evaluate(*self.inputs, "--metrics", "mme", "--definition", "mapeval")
        self.assertAlmostEqual(document["metrics"]["mme"]["value"], -6.4523, delta=0.02)

    def test_the_pickled_subset_is_refused_and_the_message_says_so(self):
        pickled = self.data / "arcore-depth" / "orth_subset" / "orth-0091.npy"
        self.assertTrue(pickled.is_file())
        result = self.run_ok("evaluate", *self.inputs, "--subset", pickled, exit_codes=(3,))
        self.assertIn("orth-0091.npy", result.stderr)
        self.assertIn("pickle", result.stderr.lower())
        self.assertEqual(result.stdout, "")
