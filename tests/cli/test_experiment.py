# SPDX-License-Identifier: Apache-2.0
"""`experiment`: what it writes, that it goes on after an interruption, and that nothing else changes its bytes."""

import json

import geometry
import write_data
from support import CliTest, DataTest, is_finite_document, slow, trysquare, validate

SMALL = ("planes", "--environments", 2, "--trajectories", 8, "--lengths", "2,3")


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


class ExperimentTest(CliTest):
    def experiment(self, name, *options):
        out = self.folder / name
        return out, self.run_ok("experiment", *(options or SMALL), "--out", out)

    def test_results_are_written_and_follow_the_schema(self):
        out, result = self.experiment("a")
        names = set(contents(out))
        self.assertLessEqual(
            {"settings.json", "experiment.json", "correlations.csv", "summary.csv", "correlations.svg", "scatter.svg"},
            names,
        )
        self.assertEqual(4, len([name for name in names if name.startswith("samples")]))
        document = json.loads((out / "experiment.json").read_text())
        validate(self, document, "experiment")
        self.assertTrue(is_finite_document(document))
        self.assertEqual(2, len(document["groups"]))
        for word in ("planes, 3 poses", "mom_sum_of_medians", "Kendall"):
            self.assertIn(word, result.stdout)
        lines = (out / "correlations.csv").read_text().splitlines()
        self.assertEqual(1 + 4 * 5, len(lines))

    def test_json_to_stdout_is_the_file(self):
        out = self.folder / "out"
        result = self.run_ok("experiment", *SMALL, "--out", out, "--json", "-")
        self.assertEqual((out / "experiment.json").read_text(), result.stdout)

    def test_threads_change_nothing(self):
        one, _ = self.experiment("one", *SMALL, "--threads", 1)
        two, _ = self.experiment("two", *SMALL, "--threads", 2)
        self.assertEqual(contents(one), contents(two))

    def test_a_run_that_was_cut_off_goes_on_and_ends_the_same(self):
        whole, _ = self.experiment("whole")
        expected = contents(whole)
        cut, _ = self.experiment("cut")
        samples = sorted((cut / "samples").iterdir())
        kept = samples[3].stat()
        samples[0].unlink()
        samples[1].write_bytes(samples[1].read_bytes()[:-9])  # in the middle of a number
        lines = samples[2].read_bytes().splitlines(keepends=True)
        samples[2].write_bytes(b"".join(lines[:-1]))  # at the end of a line
        for name in ("experiment.json", "correlations.csv", "summary.csv", "correlations.svg"):
            (cut / name).unlink()
        _, result = self.experiment("cut")
        self.assertEqual(expected, contents(cut))
        self.assertIn("1 of 4 studies were finished before", result.stderr)
        self.assertEqual((kept.st_ino, kept.st_mtime_ns), (samples[3].stat().st_ino, samples[3].stat().st_mtime_ns))

    def test_other_settings_are_refused_in_the_same_folder(self):
        out, _ = self.experiment("a")
        before = contents(out)
        for options in ((*SMALL, "--seed", 1), (*SMALL, "--radius", 0.9), ("counterexample", *SMALL[1:])):
            result = trysquare("experiment", *options, "--out", out)
            self.assertEqual(3, result.exit_code, result)
            self.assertIn("settings.json", result.stderr)
            self.assertIn("other settings", result.stderr)
            self.assertEqual("", result.stdout)
        self.assertEqual(before, contents(out))

    def test_another_seed_gives_other_numbers(self):
        a, _ = self.experiment("a")
        b, _ = self.experiment("b", *SMALL, "--seed", 1)
        self.assertNotEqual(contents(a)["correlations.csv"], contents(b)["correlations.csv"])

    def test_settings_arrive(self):
        out, _ = self.experiment(
            "a", "counterexample", "--environments", 1, "--trajectories", 4, "--lengths", 3, "--rotation", "0,0.5",
            "--translation", 0.1, "--model", "walk", "--intervals", "fisher", "--radius", 0.8, "--queries", 50,
            "--orthogonal-points", 9, "--seed", 6,
        )  # fmt: skip
        settings = json.loads((out / "experiment.json").read_text())["settings"]
        expected = {
            "num_environments": 1, "num_poses": [3], "num_trajectories": 4, "noise_model": "walk",
            "translation_sigma_m": 0.1, "rotation_sigmas_deg": [0.0, 0.5], "radius_m": 0.8, "num_queries": 50,
            "num_points_per_direction": 9, "intervals": "fisher", "seed": 6,
        }  # fmt: skip
        self.assertEqual(expected, {key: settings[key] for key in expected})
        names = [name for name in contents(out) if name.startswith("samples")]
        self.assertIn("samples/balanced-r0.5-e00-n03.csv", names)
        self.assertEqual(6, len(names))

    def test_bad_input_is_refused_before_anything_is_written(self):
        out = self.folder / "out"
        for words, options in (
            (("EXPERIMENT",), ("nothing",)),
            (("num_poses", "1, 5"), ("planes", "--lengths", "1,5")),
            (("num_trajectories = 1",), ("planes", "--trajectories", 1)),
            (("num_environments = 0",), ("planes", "--environments", 0)),
            (("--model", "brown"), ("planes", "--model", "brown")),
            (("radius_m",), ("planes", "--radius", 0)),
            (("rotation",), ("planes", "--rotation", "-1")),
            (("--data", "--poses"), ("kitti",)),
            (("--data", "--poses"), ("kitti", "--data", self.folder)),
            (("--json",), ("paper", "--json", "-")),
        ):
            with self.subTest(options=options):
                self.assert_usage_error(trysquare("experiment", *options, "--out", out), *words)
        self.assert_usage_error(trysquare("experiment", "planes"), "--out")
        self.assertFalse(out.exists())

    def test_a_folder_that_cannot_be_is_an_input_error(self):
        file = self.folder / "file"
        file.write_text("")
        result = trysquare("experiment", *SMALL, "--out", file / "out")
        self.assertEqual(3, result.exit_code, result)

    def test_street_and_town(self):
        small = ("--environments", 1, "--trajectories", 3, "--lengths", 2, "--queries", 50)
        out, result = self.experiment("street", "street", *small)
        document = json.loads((out / "experiment.json").read_text())
        validate(self, document, "experiment")
        self.assertEqual("carla32", document["settings"]["sensor"])
        self.assertIn("mom_paper", result.stdout)
        out, _ = self.experiment("town", "town", *small, "--rotation", 0.02, "--sequence", 3, "--threads", 2)
        document = json.loads((out / "experiment.json").read_text())
        groups = [group["group"] for group in document["groups"]]
        self.assertEqual(["town-grid", "town-suburb", "town-old"], groups)
        extraction = json.loads((out / "extraction" / "town-grid-patches-3.json").read_text())
        validate(self, extraction, "orthogonal")
        self.assertEqual(3, len(extraction["windows"]))
        again, _ = self.experiment("again", "town", *small, "--rotation", 0.02, "--sequence", 3, "--threads", 1)
        self.assertEqual(contents(out), contents(again))
        self.assertEqual(18, len([name for name in contents(out) if name.startswith("extraction")]))

    def test_scans_at_hand(self):
        scans, poses = geometry.corner(num_scans=6, per_plane=200, noise_m=0.01)
        folder, file = write_data.write_dataset(self.folder / "data", scans, poses)
        out, result = self.experiment(
            "kitti", "kitti", "--data", folder, "--poses", file, "--trajectories", 5, "--lengths", "2,3", "--radius", 0.5
        )
        document = json.loads((out / "experiment.json").read_text())
        validate(self, document, "experiment")
        self.assertEqual(document["settings"]["poses"], str(file))
        self.assertEqual(4, len(document["groups"]))
        self.assertIn("mom_paper", result.stdout)
        out = self.folder / "too_long"
        result = trysquare("experiment", "kitti", "--data", folder, "--poses", file, "--lengths", "2,7", "--out", out)
        self.assert_usage_error(result, "2 environments of 7 scans need 14 scans", "has 6")
        self.assertFalse(out.exists())


class KittiExperimentTest(DataTest):
    @slow
    def test_real_scans(self):
        kitti = self.data / "kitti00"
        poses = self.oracle_folder / "kitti00_adjusted.txt"
        out = self.folder / "out"
        self.run_ok(
            "experiment", "kitti", "--data", kitti / "velodyne", "--poses", poses, "--no-calib", "--environments", 1,
            "--lengths", 5, "--trajectories", 40, "--out", out,
        )  # fmt: skip
        document = json.loads((out / "experiment.json").read_text())
        validate(self, document, "experiment")
        means = {
            (group["rotation_sigma_deg"], metric["metric"]): metric["pearson"]["mean"]
            for group in document["groups"]
            for metric in group["metrics"]
        }
        self.assertGreater(means[0.02, "omme"], means[0.02, "mme"])
        self.assertGreater(means[0.02, "mom"], means[0.2, "mom"])
