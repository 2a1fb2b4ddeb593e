# SPDX-License-Identifier: Apache-2.0
"""`perturb`: noise of the size that was asked for, in the frame and format of the input."""

import math

import geometry
import write_data
from support import CliTest, trysquare


def positions(poses):
    return [tuple(row[3] for row in pose[:3]) for pose in poses]


def squares(differences):
    return [sum(x * x for x in d) for d in differences]


class PerturbTest(CliTest):
    def setUp(self):
        super().setUp()
        self.poses = [geometry.pose(yaw=0.01 * i, translation=(i * 0.1, 0.0, 0.0)) for i in range(600)]
        self.file = self.folder / "poses.txt"
        self.output = self.folder / "noisy.txt"
        write_data.write_kitti(self.file, self.poses)

    def perturb(self, *options):
        self.run_ok("perturb", self.file, "-o", self.output, *options)
        return write_data.read_kitti(self.output)

    def errors(self, noisy):
        return [
            tuple(a - b for a, b in zip(n, p)) for n, p in zip(positions(noisy), positions(self.poses), strict=True)
        ]

    def test_white_noise_has_the_size_that_was_asked_for(self):
        errors = self.errors(self.perturb("--translation", 0.05))
        mean_square = sum(squares(errors)) / len(errors) / 3
        self.assertLess(abs(mean_square / 0.0025 - 1), 5 * math.sqrt(2 / 1800))
        neighbors = sum(a[0] * b[0] for a, b in zip(errors, errors[1:])) / len(errors)
        self.assertLess(abs(neighbors), 5 * 0.0025 / math.sqrt(600))

    def test_a_walk_has_steps_of_that_size_and_starts_at_the_first_pose(self):
        errors = self.errors(self.perturb("--translation", 0.05, "--model", "walk"))
        self.assertEqual((0.0, 0.0, 0.0), errors[0])
        steps = [tuple(x - y for x, y in zip(a, b)) for a, b in zip(errors[1:], errors)]
        mean_square = sum(squares(steps)) / len(steps) / 3
        self.assertLess(abs(mean_square / 0.0025 - 1), 5 * math.sqrt(2 / 1797))

    def test_rotation_is_in_degrees_and_leaves_positions_alone(self):
        noisy = self.perturb("--rotation", 1)
        self.assertEqual(positions(self.poses), positions(noisy))
        document = self.run_ok("ape", self.file, self.output, "-r", "angle_deg", "--json", "-").json()
        rms_per_axis = document["statistics"]["rmse"] / math.sqrt(3)
        self.assertLess(abs(rms_per_axis**2 - 1), 5 * math.sqrt(2 / 1800))

    def test_a_seed_repeats_and_another_does_not(self):
        first = self.perturb("--translation", 0.05, "--seed", 3)
        self.assertEqual(first, self.perturb("--translation", 0.05, "--seed", 3))
        self.assertNotEqual(first, self.perturb("--translation", 0.05, "--seed", 4))

    def test_format_and_time_stamps_are_those_of_the_input(self):
        tum, noisy = self.folder / "poses.tum", self.folder / "noisy.any"
        write_data.write_tum(tum, self.poses)
        self.run_ok("perturb", tum, "-o", noisy, "--translation", 0.05)
        stamps = [[float(line.split()[0]) for line in file.read_text().splitlines() if line[:1] != "#"]
                  for file in (tum, noisy)]  # fmt: skip
        self.assertEqual(stamps[0], stamps[1])
        self.assertTrue(all(len(line.split()) == 8 for line in noisy.read_text().splitlines() if line[:1] != "#"))
        document = self.run_ok("ape", tum, noisy, "--json", "-").json()
        self.assertEqual(600, document["num_pairs"])

    def test_bad_input(self):
        out = ("-o", self.output)
        for words, options in (
            (("--output",), ("--translation", 1)),
            (("nothing to do",), out),
            (("translation_sigma_m = -1",), (*out, "--translation", -1)),
            (("rotation_sigma_rad",), (*out, "--rotation", "nan")),
            (("--model", "brown"), (*out, "--translation", 1, "--model", "brown")),
        ):
            with self.subTest(options=options):
                self.assert_usage_error(trysquare("perturb", self.file, *options), *words)
        self.assertFalse(self.output.exists())
        result = trysquare("perturb", self.folder / "none.txt", *out, "--translation", 1)
        self.assertEqual(3, result.exit_code, result)
        self.assertIn("none.txt", result.stderr)
        self.file.write_text("1 2 3\n")
        result = trysquare("perturb", self.file, *out, "--translation", 1)
        self.assertEqual(3, result.exit_code, result)
        self.assertIn("line 1", result.stderr)
        self.assertFalse(self.output.exists())
