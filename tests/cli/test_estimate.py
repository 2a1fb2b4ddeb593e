# SPDX-License-Identifier: Apache-2.0
"""The RPE without ground truth: `rpe_estimate` of `evaluate`, and `refine`. Truth: simulated poses, and what KITTI's scans say."""

import math

import support
from support import CliTest, DataTest, validate


def kitti_rows(path):
    return [[float(word) for word in line.split()] for line in path.read_text().splitlines() if line.strip()]


def pairs_rms(a, b):
    """Root mean square over all pairs of the difference of relative positions, and of their angles, in degrees."""
    def inverse_times(x, y):
        """x^-1 y of 3x4 rows, rigid."""
        rx, ry = [x[0:3], x[4:7], x[8:11]], [y[0:3], y[4:7], y[8:11]]
        d = [y[3 + 4 * i] - x[3 + 4 * i] for i in range(3)]
        rotation = [[sum(rx[k][i] * ry[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
        return rotation, [sum(rx[k][i] * d[k] for k in range(3)) for i in range(3)]

    squares, angles = [], []
    for i in range(len(a)):
        for j in range(i + 1, len(a)):
            (ra, ta), (rb, tb) = inverse_times(a[i], a[j]), inverse_times(b[i], b[j])
            squares.append(sum((x - y) ** 2 for x, y in zip(ta, tb)))
            trace = sum(ra[k][c] * rb[k][c] for k in range(3) for c in range(3))
            angles.append(math.acos(max(-1.0, min(1.0, (trace - 1) / 2))) ** 2)
    count = len(squares)
    return math.sqrt(sum(squares) / count), math.degrees(math.sqrt(sum(angles) / count))


class SimulatedEstimateTest(CliTest):
    def setUp(self):
        super().setUp()
        self.street = self.folder / "street"
        self.run_ok("simulate", "street", self.street, "--scans", 6, "--seed", 3, "--quiet")
        self.truth = self.street / "poses.txt"
        self.noisy = self.folder / "noisy.txt"
        self.run_ok("perturb", self.truth, "-o", self.noisy, "--translation", 0.05, "--rotation", 0.2)

    def estimate(self, poses, *options, **keywords):
        document = self.evaluate(self.street / "velodyne", poses, "--metrics", "rpe", *options, **keywords)
        validate(self, document, "evaluation")
        return document

    def test_the_estimate_is_the_true_error_within_its_interval(self):
        expected_m, expected_deg = pairs_rms(kitti_rows(self.truth), kitti_rows(self.noisy))
        estimate = self.estimate(self.noisy)["rpe_estimate"]
        self.assertEqual(estimate["status"], "measured")
        self.assert_relative(estimate["translation_rms_m"], expected_m, 0.02)
        self.assert_relative(estimate["rotation_rms_deg"], expected_deg, 0.05)
        self.assertLessEqual(estimate["interval_m"][0], expected_m)
        self.assertGreaterEqual(estimate["interval_m"][1], expected_m)
        self.assertEqual([pose["index"] for pose in estimate["poses"]], list(range(6)))

    def test_windows_have_the_estimate_too(self):
        document = self.estimate(self.noisy, "--window", 3, "--reference", self.truth)
        for window in document["windows"]:
            self.assert_relative(window["rpe_estimate_m"], window["rpe_m"], 0.1)

    def test_true_poses_are_bounded(self):
        estimate = self.estimate(self.truth)["rpe_estimate"]
        self.assertEqual(estimate["status"], "bound")
        self.assertLess(estimate["upper_bound_m"], 0.02)

    def test_refine_writes_the_true_poses_in_the_format_of_the_input(self):
        adjusted = self.folder / "adjusted.txt"
        result = self.run_ok("refine", self.street / "velodyne", self.noisy, "-o", adjusted)
        self.assertIn("iterations", result.stdout)
        left_m, left_deg = pairs_rms(kitti_rows(self.truth), kitti_rows(adjusted))
        self.assertLess(left_m, 0.015)
        self.assertLess(left_deg, 0.05)
        self.assertEqual([len(row) for row in kitti_rows(adjusted)], [12] * 6)

    def test_refine_undoes_the_extrinsic(self):
        """Poses of a body that carries the sensor: the adjusted ones are the body's again, with the first as it was."""
        yaw = math.radians(30)
        c, s = math.cos(yaw), math.sin(yaw)
        extrinsic = [c, -s, 0, 0.5, s, c, 0, -0.2, 0, 0, 1, 0.1, 0, 0, 0, 1]
        inverse = [c, s, 0, -0.5 * c + 0.2 * s, -s, c, 0, 0.5 * s + 0.2 * c, 0, 0, 1, -0.1]

        def times(a, b):
            return [
                sum(a[4 * i + k] * b[4 * k + j] for k in range(3)) + (a[4 * i + 3] if j == 3 else 0)
                for i in range(3)
                for j in range(4)
            ]

        def of_body(path, name):
            out = self.folder / name
            rows = [times(row, inverse) for row in kitti_rows(path)]
            out.write_text("".join(" ".join(repr(x) for x in row) + "\n" for row in rows))
            return out

        noisy, truth = of_body(self.noisy, "noisy_body.txt"), of_body(self.truth, "true_body.txt")
        adjusted = self.folder / "adjusted_body.txt"
        words = " ".join(repr(x) for x in extrinsic)
        self.run_ok("refine", self.street / "velodyne", noisy, "-o", adjusted, "--extrinsic", words)
        self.assertLess(pairs_rms(kitti_rows(truth), kitti_rows(adjusted))[0], 0.015)
        for got, expected in zip(kitti_rows(adjusted)[0], kitti_rows(noisy)[0]):
            self.assertAlmostEqual(got, expected, 9)

    def test_a_refusal_has_reasons_and_exit_code_4_and_writes_nothing(self):
        two = ("--last", 1)
        document = self.estimate(self.noisy, *two, exit_codes=(4,))
        self.assertEqual(document["rpe_estimate"]["status"], "refused")
        self.assertIsNone(document["rpe_estimate"]["translation_rms_m"])
        self.assertIn("2 poses", " ".join(document["verdict"]["reasons"]))
        adjusted = self.folder / "adjusted.txt"
        result = support.trysquare("refine", self.street / "velodyne", self.noisy, "-o", adjusted, *two)
        self.assertEqual(result.exit_code, 4, result)
        self.assertIn("2 poses", result.stderr)
        self.assertFalse(adjusted.exists())


class KittiEstimateTest(DataTest):
    def estimate(self, *poses):
        call = (self.data / "kitti00" / "velodyne", *poses, "--metrics", "rpe", "--min-range", 2.8)
        return self.evaluate(*call, exit_codes=(0, 4))["rpe_estimate"]

    def test_ground_truth_is_half_a_metre_off_and_icp_is_better(self):
        truth = self.estimate(self.data / "kitti00" / "poses.txt")
        self.assertEqual(truth["status"], "measured")
        self.assertAlmostEqual(truth["translation_rms_m"], 0.57, delta=0.01)
        self.assertAlmostEqual(truth["rotation_rms_deg"], 0.94, delta=0.02)
        icp = self.estimate(self.oracle_folder / "kitti00_icp.txt")
        self.assertLess(icp["upper_bound_m"] or icp["interval_m"][1], 0.05)

    def test_a_forgotten_calibration_is_refused(self):
        estimate = self.estimate(self.data / "kitti00" / "poses.txt", "--no-calib")
        self.assertEqual(estimate["status"], "refused")
        self.assertIsNone(estimate["translation_rms_m"])
