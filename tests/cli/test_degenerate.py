# SPDX-License-Identifier: Apache-2.0
"""Invariances, and scenes at the edge of meaning: each has its documented result, and undefined is never 0."""

import random

import geometry
import write_data
from support import CliTest, is_finite_document

METRICS = ("mme", "mpv", "mom", "omme")


class SceneTest(CliTest):
    def setUp(self):
        super().setUp()
        self.scans, self.poses = geometry.corner(num_scans=5, per_plane=150)

    def values(self, scans, poses, *options, name="data", exit_codes=(0,), writer=write_data.write_npy, radius=0.5):
        """The JSON for scans written with 17 digits."""
        inputs = write_data.write_dataset(self.folder / name, scans, poses, writer, ".npy")
        return self.evaluate(*inputs, "--radius", radius, *options, exit_codes=exit_codes)

    def subset_option(self, poses, scale=1.0, name="subset"):
        folder = self.folder / name
        folder.mkdir()
        subset = geometry.corner_subset(poses)
        return ("--subset", write_data.write_subset(folder, [[tuple(scale * c for c in p) for p in d] for d in subset]))

    def metric_values(self, document):
        return {name: document["metrics"][name]["value"] for name in METRICS}

    def assert_same_metrics(self, a, b, tolerance):
        a, b = self.metric_values(a), self.metric_values(b)
        for name in METRICS:
            self.assert_relative(a[name], b[name], tolerance, name)


class InvarianceTest(SceneTest):
    def test_rigid_motion_of_the_world(self):
        subset = self.subset_option(self.poses)
        motion = geometry.pose(1.0, -0.4, 2.2, (30.0, -70.0, 11.0))
        moved = [geometry.compose(motion, p) for p in self.poses]
        before = self.values(self.scans, self.poses, *subset)
        self.assert_same_metrics(self.values(self.scans, moved, *subset, name="moved"), before, 1e-9)

    def test_utm_sized_coordinates(self):
        subset = self.subset_option(self.poses)
        motion = geometry.pose(translation=(5e5, 5e6, 100.0))
        moved = [geometry.compose(motion, p) for p in self.poses]
        before = self.values(self.scans, self.poses, *subset)
        after = self.values(self.scans, moved, *subset, name="utm")
        self.assert_same_metrics(after, before, 1e-6)
        self.assertFalse(after["warnings"], "UTM coordinates are nothing to warn of")

    def test_order_of_the_points(self):
        subset = self.subset_option(self.poses)
        shuffled = [random.Random(4).sample(scan, len(scan)) for scan in self.scans]
        before = self.values(self.scans, self.poses, *subset)
        self.assert_same_metrics(self.values(shuffled, self.poses, *subset, name="shuffled"), before, 1e-10)

    def test_scale(self):
        """s times as large, with a radius s times as large: variances s², entropies + 3 ln s."""
        s = 4.0
        scaled = [[tuple(s * c for c in p) for p in scan] for scan in self.scans]
        poses = [geometry.scaled(p, s) for p in self.poses]
        before = self.metric_values(self.values(self.scans, self.poses, *self.subset_option(self.poses)))
        options = self.subset_option(self.poses, s, "subset_scaled")
        after = self.metric_values(self.values(scaled, poses, *options, name="scaled", radius=0.5 * s))
        for name in ("mpv", "mom"):
            self.assert_relative(after[name], s * s * before[name], 1e-9, name)
        for name in ("mme", "omme"):
            self.assertAlmostEqual(after[name], before[name] + 3 * 1.3862943611198906, delta=1e-9)

    def test_mom_is_the_average_of_the_directions_and_each_is_an_mpv(self):
        """Each direction's mean is the MPV of the same queries: `map` of the map, asked at those points only."""
        mom = self.values(self.scans, self.poses, *self.subset_option(self.poses))["metrics"]["mom"]
        means = [d["mean"] for d in mom["directions"]]
        medians = [d["median"] for d in mom["directions"]]
        self.assertEqual(len(means), 3)
        self.assert_relative(mom["value"], sum(means) / 3, 1e-14)
        self.assert_relative(mom["sum_of_medians"], sum(medians), 1e-14)
        self.assertIs(mom["follows_trajectory_error"], True)

    def test_pose_errors_raise_mom(self):
        """Else none of the tests above says anything."""
        subset = self.subset_option(self.poses)
        rng = random.Random(8)
        noisy = [
            geometry.compose(p, geometry.pose(translation=tuple(rng.gauss(0, 0.08) for _ in range(3))))
            for p in self.poses
        ]
        noisy[0] = self.poses[0]
        before = self.metric_values(self.values(self.scans, self.poses, *subset))
        after = self.metric_values(self.values(self.scans, noisy, *subset, name="noisy"))
        self.assertGreater(after["mom"], 3 * before["mom"])
        self.assertGreater(after["mpv"], 2 * before["mpv"])
        self.assertGreater(after["mme"], before["mme"] + 0.3)


class EdgeTest(SceneTest):
    def assert_undefined(self, metric):
        """null with a reason, never 0 and never a missing key."""
        self.assertIsNone(metric["value"])
        self.assertTrue(metric["reason"])

    def test_exactly_planar_points(self):
        rng = random.Random(2)
        flat = [[(3 * rng.random(), 3 * rng.random(), 0.0) for _ in range(200)] for _ in range(3)]
        document = self.values(flat, [geometry.identity()] * 3, "--metrics", "mme,mpv", exit_codes=(0, 4))
        mme, mpv = document["metrics"]["mme"], document["metrics"]["mpv"]
        self.assertEqual(mpv["value"], 0.0)
        self.assertEqual(mpv["num_degenerate"], 600)
        self.assertEqual(mpv["num_used"], 600)
        self.assert_undefined(mme)
        self.assertEqual((mme["num_used"], mme["num_degenerate"]), (0, 600))
        self.assertTrue(is_finite_document(document))

    def test_tilted_planar_points_are_degenerate_too(self):
        """Round-off makes the determinant ±1e-17 here, not 0."""
        rng = random.Random(2)
        tilt = geometry.pose(0.3, 0.5, 0.7, (1.0, 2.0, 3.0))
        flat = [[geometry.apply(tilt, (3 * rng.random(), 3 * rng.random(), 0.0)) for _ in range(200)] for _ in range(3)]
        document = self.values(flat, [geometry.identity()] * 3, "--metrics", "mme,mpv", exit_codes=(0, 4))
        self.assertEqual(document["metrics"]["mpv"]["num_degenerate"], 600)
        self.assert_undefined(document["metrics"]["mme"])
        self.assertLess(document["metrics"]["mpv"]["value"], 1e-30)

    def test_duplicates_are_degenerate_and_counted(self):
        three = [(0.0, 0.1, 0.2), (0.3, 0.1, 0.05), (0.1, 0.4, 0.3)] * 10
        document = self.values([three, three], [geometry.identity()] * 2, "--metrics", "mme,mpv", exit_codes=(0, 4))
        self.assert_undefined(document["metrics"]["mme"])
        self.assertEqual(document["metrics"]["mme"]["num_degenerate"], 60)
        self.assertIn(document["inputs"]["num_duplicate_points"], (57, 60), "with or without the first of each")

    def test_one_scan_means_nothing_but_is_written(self):
        document = self.values(self.scans[:1], self.poses[:1], exit_codes=(4,))
        self.assertTrue(document["verdict"]["reasons"])
        self.assertEqual(document["inputs"]["num_scans"], 1)
        self.assertIsNotNone(document["metrics"]["mpv"]["value"])
        self.assertEqual(document["overlap"]["multi_scan_share"], 0.0)

    def test_two_points(self):
        document = self.values([[(1.0, 2.0, 3.0)], [(1.0, 2.1, 3.0)]], [geometry.identity()] * 2, exit_codes=(4,))
        self.assertEqual(document["inputs"]["num_points"], 2)
        for name in METRICS:
            self.assert_undefined(document["metrics"][name])
        self.assertEqual(document["metrics"]["mpv"]["num_too_few"], 2)
        self.assertIsNone(document["overlap"]["multi_scan_share"])

    def test_no_point_at_all(self):
        nothing = [[(float("nan"),) * 3] * 10] * 2
        document = self.values(nothing, [geometry.identity()] * 2, exit_codes=(4,))
        self.assertEqual(document["inputs"]["num_points"], 0)
        self.assertEqual(document["inputs"]["num_dropped_points"], 20)
        for name in METRICS:
            self.assert_undefined(document["metrics"][name])

    def test_a_well_formed_scan_without_points_is_no_error(self):
        scans = [*self.scans, []]
        document = self.values(scans, [*self.poses, self.poses[-1]])
        without = self.values(self.scans, self.poses, name="without")
        self.assertEqual(document["inputs"]["num_scans"], 6)
        self.assertEqual(document["metrics"]["mpv"], without["metrics"]["mpv"])

    def test_scans_that_never_meet(self):
        apart = [geometry.pose(translation=(100.0 * i, 0.0, 0.0)) for i in range(5)]
        document = self.values(self.scans, apart, exit_codes=(4,))
        self.assertEqual(document["overlap"]["multi_scan_share"], 0.0)
        self.assertEqual(document["overlap"]["scans_per_neighborhood_mean"], 1.0)
        self.assertIn("overlap", " ".join(document["verdict"]["reasons"]).lower())

    def test_invalid_returns_are_dropped_and_counted(self):
        dirty = [
            [
                *scan[:50],
                (0.0, 0.0, 0.0),
                (-0.0, 0.0, 0.0),
                *scan[50:],
                (float("nan"), 1.0, 2.0),
                (1.0, float("inf"), 0.0),
            ]
            for scan in self.scans
        ]
        clean = self.values(self.scans, self.poses)
        document = self.values(dirty, self.poses, name="dirty")
        self.assertEqual(document["inputs"]["num_dropped_points"], 4 * 5)
        self.assertEqual(document["inputs"]["num_points"], clean["inputs"]["num_points"])
        self.assertEqual(document["metrics"], clean["metrics"])

    def test_map_keeps_points_at_the_origin(self):
        points = [p for scan in self.scans for p in scan] + [(0.0, 0.0, 0.0)] * 3 + [(float("nan"),) * 3]
        write_data.write_npy(self.folder / "map.npy", points)
        document = self.run_ok("map", self.folder / "map.npy", "--radius", 0.5, "--json", "-", exit_codes=(0, 4)).json()
        self.assertEqual(document["inputs"]["num_points"], len(points) - 1)
        self.assertEqual(document["inputs"]["num_dropped_points"], 1)

    def test_map_warns_of_many_points_at_the_origin(self):
        points = self.scans[0] + [(0.0, 0.0, 0.0)] * 100
        write_data.write_npy(self.folder / "map.npy", points)
        document = self.run_ok("map", self.folder / "map.npy", "--radius", 0.5, "--json", "-", exit_codes=(0, 4)).json()
        self.assertIn("100", " ".join(w["message"] for w in document["warnings"]))

    def test_fewer_than_three_directions_is_said(self):
        subset = geometry.corner_subset(self.poses)[:2]
        glob = write_data.write_subset(self.folder, subset)
        mom = self.values(self.scans, self.poses, "--subset", glob)["metrics"]["mom"]
        self.assertIs(mom["follows_trajectory_error"], False)
        self.assertEqual(len(mom["directions"]), 2)
        self.assertIsNotNone(mom["value"])

    def test_a_subset_far_from_the_map_is_undefined(self):
        glob = write_data.write_subset(self.folder, [[(1000.0, 0.0, 0.0)] * 5, [(0.0, 1000.0, 0.0)] * 5])
        document = self.values(self.scans, self.poses, "--subset", glob)
        self.assert_undefined(document["metrics"]["mom"])
        self.assert_undefined(document["metrics"]["omme"])

    def test_a_scene_without_planes_leaves_mom_undefined_and_the_rest_alone(self):
        rng = random.Random(6)
        fog = [[tuple(3 * rng.random() for _ in range(3)) for _ in range(500)] for _ in range(4)]
        document = self.values(fog, [geometry.identity()] * 4)
        self.assertIsNotNone(document["metrics"]["mpv"]["value"])
        self.assert_undefined(document["metrics"]["mom"])

    def test_range_options_drop_points(self):
        near = self.values(self.scans, self.poses, "--max-range", 2.0)
        ranges = [sum(c * c for c in p) ** 0.5 for scan in self.scans for p in scan]
        self.assertEqual(near["inputs"]["num_points"], sum(r <= 2.0 for r in ranges))

    def test_selected_scans(self):
        some = self.values(self.scans, self.poses, "--first", 1, "--last", 3, "--every", 2)
        self.assertEqual(some["inputs"]["num_scans"], 2)
        same = self.values(self.scans[1:4:2], self.poses[1:4:2], name="some")
        self.assertEqual(some["metrics"]["mpv"], same["metrics"]["mpv"])

    def test_twelve_scans_are_taken_in_natural_order(self):
        """scan-10 comes after scan-9, not after scan-1."""
        scans, poses = geometry.corner(num_scans=12, per_plane=60)
        natural = self.values(scans, poses, "--metrics", "mpv")
        renamed = write_data.write_dataset(self.folder / "r", [], poses)
        for i, scan in enumerate(scans):
            write_data.write_npy(renamed[0] / f"scan-{i:03}.npy", scan)
        padded = self.evaluate(*renamed, "--radius", 0.5, "--metrics", "mpv")
        self.assertEqual(natural["metrics"]["mpv"], padded["metrics"]["mpv"])


class TimeTest(CliTest):
    """Scans whose names are times, and poses with time stamps: the times decide which pose belongs to which scan."""

    def setUp(self):
        super().setUp()
        self.scans, self.poses = geometry.corner(num_scans=6, per_plane=60)
        self.scan_folder = self.folder / "scans"
        self.scan_folder.mkdir()
        for i, scan in enumerate(self.scans):
            write_data.write_xyz(self.scan_folder / f"{100 + i}.500000000.xyz", scan)

    def mpv(self, name, poses, stamps, *options):
        file = self.folder / f"{name}.tum"
        write_data.write_tum(file, poses, stamps)
        document = self.evaluate(self.scan_folder, file, "--radius", 0.5, "--metrics", "mpv", *options)
        return document["metrics"]["mpv"]["value"], [w["code"] for w in document["warnings"]]

    def test_an_extra_pose_changes_nothing(self):
        stamps = [f"{100 + i}.5" for i in range(6)]
        straight = self.mpv("straight", self.poses, stamps)
        extra = self.mpv("extra", [*self.poses, self.poses[0]], [*stamps, "107.5"])
        self.assertEqual(straight, extra)

    def test_a_scan_without_a_pose_is_left_out_and_said_so(self):
        stamps = [f"{101 + i}.5" for i in range(5)]
        value, warnings = self.mpv("late", self.poses[1:], stamps)
        self.assertIn("scans_without_pose", warnings)
        same_count, warnings = self.mpv("same", [*self.poses[1:], self.poses[0]], [*stamps, "300.5"])
        self.assertIn("scans_without_pose", warnings)
        self.assertEqual(value, same_count)

    def test_times_without_anything_in_common_are_taken_in_order_and_said_so(self):
        straight = self.mpv("straight", self.poses, [f"{100 + i}.5" for i in range(6)])
        value, warnings = self.mpv("other", self.poses, [f"{900 + i}.5" for i in range(6)])
        self.assertEqual(value, straight[0])
        self.assertIn("times_differ", warnings)

    def test_the_order_of_the_poses_does_not_matter(self):
        stamps = [f"{100 + i}.5" for i in range(6)]
        shuffled = [3, 0, 5, 4, 1, 2]
        straight = self.mpv("straight", self.poses, stamps)
        value, _ = self.mpv("shuffled", [self.poses[i] for i in shuffled], [stamps[i] for i in shuffled])
        self.assertEqual(straight[0], value)
        five = [3, 0, 4, 1, 2]
        in_order, _ = self.mpv("five", self.poses[:5], stamps[:5])
        value, warnings = self.mpv("shuffled_five", [self.poses[i] for i in five], [stamps[i] for i in five])
        self.assertEqual(in_order, value)
        self.assertIn("scans_without_pose", warnings)

    def test_fewer_poses_without_a_time_in_common_are_refused(self):
        write_data.write_tum(self.folder / "five.tum", self.poses[:5], [f"{900 + i}.5" for i in range(5)])
        result = self.run_ok("evaluate", self.scan_folder, self.folder / "five.tum", exit_codes=(3,))
        self.assertIn("five.tum: no pose lies within", result.stderr)
