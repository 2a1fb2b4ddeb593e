# SPDX-License-Identifier: Apache-2.0
"""`evaluate` against the brute force of tests/oracle on small scenes, by every definition, to 1e-9."""

import random

import brute_force
import geometry
import write_data
from support import CliTest


def map_in_first_frame(scans, poses):
    """All points in the frame of the first scan: the motions first, then the points (as METRICS says)."""
    map_from_world = geometry.inverse(poses[0])
    points, scan_of_point = [], []
    for index, (scan, pose) in enumerate(zip(scans, poses, strict=True)):
        map_from_scan = geometry.compose(map_from_world, pose)
        points += [geometry.apply(map_from_scan, p) for p in scan]
        scan_of_point += [index] * len(scan)
    return points, scan_of_point


def sparse_corner():
    """Some queries have too few neighbors for one definition and enough for another; one clump is in one scan only."""
    scans, poses = geometry.corner(num_scans=4, per_plane=55, size_m=2.4, noise_m=0.02, seed=5)
    rng = random.Random(9)
    for scan in scans:
        scan += geometry.as_float32([tuple(8.0 * rng.random() - 4.0 for _ in range(3)) for _ in range(12)])
    scans[1] += geometry.as_float32([tuple(30.0 + 0.3 * rng.random() for _ in range(3)) for _ in range(30)])
    return scans, poses


class OracleTest(CliTest):
    radius_m = 0.4

    def setUp(self):
        super().setUp()
        self.scans, self.poses = sparse_corner()
        self.inputs = write_data.write_dataset(self.folder, self.scans, self.poses)
        self.map_points, self.scan_of_point = map_in_first_frame(self.scans, self.poses)

    def expected_points(self, min_neighbors=6, definition="paper", every=1):
        queries = self.map_points[::every]
        return [
            brute_force.point_values(self.map_points, self.scan_of_point, q, self.radius_m, min_neighbors, definition)
            for q in queries
        ]

    def test_the_scene_has_every_kind_of_point(self):
        """Else the tests below could not tell the definitions apart."""
        counts = [p.num_neighbors for p in self.expected_points()]
        self.assertGreater(sum(n < 4 for n in counts), 10)
        self.assertGreater(sum(4 <= n < 6 for n in counts), 2)
        self.assertGreater(sum(6 <= n < 11 for n in counts), 5)
        self.assertGreater(sum(n >= 11 for n in counts), 100)

    def test_mme_by_every_definition(self):
        for definition in ("paper", "map-metrics", "mapeval", "ais-bonn"):
            with self.subTest(definition=definition):
                points = self.expected_points(definition=definition)
                value, num_defined = brute_force.mme(points, definition)
                document = self.evaluate(
                    *self.inputs, "--radius", self.radius_m, "--metrics", "mme,mpv", "--definition", definition
                )
                actual = document["metrics"]["mme"]
                self.assert_relative(actual["value"], value)
                self.assertEqual(actual["num_queries"], len(points))
                self.assertEqual(document["settings"]["definition"], definition)
                if definition != "ais-bonn":  # there every point enters the mean, the undefined ones as 0
                    self.assertEqual(actual["num_used"], num_defined)

    def test_mpv_and_the_counts(self):
        points = self.expected_points()
        value, num_defined = brute_force.mpv(points)
        document = self.evaluate(*self.inputs, "--radius", self.radius_m, "--metrics", "mme,mpv")
        actual = document["metrics"]["mpv"]
        self.assert_relative(actual["value"], value)
        self.assertEqual(actual["num_used"], num_defined)
        self.assertEqual(actual["num_too_few"], len(points) - num_defined)
        self.assertEqual(actual["num_degenerate"], 0)

    def test_overlap(self):
        expected = brute_force.overlap(self.expected_points(), 6)
        self.assertTrue(0.8 < expected["multi_scan_share"] < 0.99, "a share that says something")
        document = self.evaluate(*self.inputs, "--radius", self.radius_m)
        for key, value in expected.items():
            self.assert_relative(document["overlap"][key], value, what=key)

    def test_min_neighbors_sets_the_least_count(self):
        for least in (4, 10, 16):
            with self.subTest(min_neighbors=least):
                points = self.expected_points(min_neighbors=least)
                document = self.evaluate(
                    *self.inputs, "--radius", self.radius_m, "--min-neighbors", least, "--metrics", "mme,mpv"
                )
                self.assert_relative(document["metrics"]["mme"]["value"], brute_force.mme(points)[0])
                self.assert_relative(document["metrics"]["mpv"]["value"], brute_force.mpv(points)[0])
                self.assertEqual(document["settings"]["min_neighbors"], least)
                self.assertEqual(document["settings"]["min_neighbors_orthogonal"], least)

    def test_query_every_takes_the_indices_that_it_divides(self):
        points = self.expected_points(every=7)
        document = self.evaluate(*self.inputs, "--radius", self.radius_m, "--query-every", 7, "--metrics", "mpv")
        self.assert_relative(document["metrics"]["mpv"]["value"], brute_force.mpv(points)[0])
        self.assertEqual(document["metrics"]["mpv"]["num_queries"], len(points))

    def test_mom_and_omme_of_a_given_subset_in_both_flavours(self):
        subset = geometry.corner_subset(self.poses, per_direction=20, size_m=2.4)
        glob = write_data.write_subset(self.folder, subset)
        expected = brute_force.orthogonal_metrics(self.map_points, self.scan_of_point, subset, self.radius_m)
        for definition, flavour in (("paper", "mean_of_means"), ("map-metrics", "sum_of_medians")):
            document = self.evaluate(
                *self.inputs, "--radius", self.radius_m, "--subset", glob, "--definition", definition
            )
            for name in ("mom", "omme"):
                with self.subTest(metric=name, definition=definition):
                    actual = document["metrics"][name]
                    self.assert_relative(actual["value"], expected[name][flavour])
                    for key in ("mean_of_means", "sum_of_medians"):
                        self.assert_relative(actual[key], expected[name][key], what=key)
                    self.assertEqual(len(actual["directions"]), 3)
                    for got, want in zip(actual["directions"], expected[name]["directions"], strict=True):
                        self.assertEqual(got["num_points"], want["num_points"])
                        self.assert_relative(got["mean"], want["mean"])
                        self.assert_relative(got["median"], want["median"])

    def test_subset_in_the_frame_of_another_scan(self):
        """--subset-pose: the points pass through the pose of the scan that they were taken from."""
        subset_in_map = geometry.corner_subset(self.poses, per_direction=20, size_m=2.4)
        scan_from_map = geometry.compose(geometry.inverse(self.poses[2]), self.poses[0])
        in_scan = [[geometry.apply(scan_from_map, p) for p in direction] for direction in subset_in_map]
        glob = write_data.write_subset(self.folder, in_scan)
        write_data.write_matrices(self.folder / "pose", [self.poses[2]])
        expected = brute_force.orthogonal_metrics(self.map_points, self.scan_of_point, subset_in_map, self.radius_m)
        document = self.evaluate(
            *self.inputs, "--radius", self.radius_m, "--subset", glob, "--subset-pose", self.folder / "pose/pose-0.txt"
        )
        self.assert_relative(document["metrics"]["mom"]["value"], expected["mom"]["mean_of_means"])


class StrictRadiusTest(CliTest):
    def test_a_point_at_exactly_the_radius_is_outside(self):
        """A lattice of step 1 (exact in binary): r = 1 sees the query only, r = 1.0001 its six neighbors as well."""
        lattice = [(float(x), float(y), float(z)) for x in range(5) for y in range(5) for z in range(5)]
        scans = [lattice, lattice[::2]]
        shift = geometry.pose(translation=(16.0, 0.0, 0.0))  # far from the first: overlap is not the question here
        inputs = write_data.write_dataset(self.folder, scans, [geometry.identity(), shift])
        strict = self.evaluate(*inputs, "--radius", 1, "--metrics", "mpv", exit_codes=(4,))["metrics"]["mpv"]
        self.assertEqual((strict["num_used"], strict["value"]), (0, None))
        above = self.evaluate(*inputs, "--radius", 1.0001, "--metrics", "mpv", exit_codes=(4,))["metrics"]["mpv"]
        points, scan_of_point = map_in_first_frame(scans, [geometry.identity(), shift])
        expected = [brute_force.point_values(points, scan_of_point, q, 1.0001, 6) for q in points]
        value, num_used = brute_force.mpv(expected)
        self.assertGreater(num_used, 20)
        self.assertEqual(above["num_used"], num_used)
        self.assert_relative(above["value"], value)


class DegenerateOracleTest(CliTest):
    def test_a_scene_that_is_half_exactly_planar(self):
        """Planar neighborhoods: 0 in MPV's mean, out of MME's, counted in both."""
        rng = random.Random(3)
        scans = []
        for _ in range(3):
            flat = [(2 * rng.random(), 2 * rng.random(), 0.0) for _ in range(60)]
            rough = [(6 + 2 * rng.random(), 2 * rng.random(), 0.05 * rng.random()) for _ in range(60)]
            scans.append(geometry.as_float32(flat + rough))
        poses = [geometry.identity()] * 3
        inputs = write_data.write_dataset(self.folder, scans, poses)
        points, scan_of_point = map_in_first_frame(scans, poses)
        document = self.evaluate(*inputs, "--radius", 0.5, "--metrics", "mme,mpv")
        expected = [brute_force.point_values(points, scan_of_point, q, 0.5, 6) for q in points]
        num_degenerate = sum(p.degenerate for p in expected)
        self.assertGreater(num_degenerate, 150)
        mme, mpv = document["metrics"]["mme"], document["metrics"]["mpv"]
        self.assertEqual((mme["num_degenerate"], mpv["num_degenerate"]), (num_degenerate, num_degenerate))
        self.assert_relative(mme["value"], brute_force.mme(expected)[0])
        self.assert_relative(mpv["value"], brute_force.mpv(expected)[0])
        self.assertEqual(mpv["num_used"], brute_force.mpv(expected)[1])
        self.assertEqual(mme["num_used"], brute_force.mme(expected)[1])
