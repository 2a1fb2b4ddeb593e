#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cluster_normals against scipy: tests/oracle/normal_clusters.py (--fast | --slow) PATH/TO/trysquare_cluster_normals

The partitions must be the same; with scikit-learn, too, where that is installed. Inputs are random, so that no two
distances are equal. Needs Python 3.10 with numpy and scipy. Normals of a real scan are looked for in $TRYSQUARE_DATA,
and in shared/data beside the repository.
"""

import argparse
import os
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial import cKDTree
from scipy.spatial.distance import pdist

try:
    from sklearn.cluster import AgglomerativeClustering
except ImportError:
    AgglomerativeClustering = None

PROGRAM = None  # set by main
SCAN = Path("kitti00", "velodyne", "000000.bin")
KINDS = (("complete", "sign-free"), ("complete", "signed"), ("ward", "signed"))


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def on_the_sphere(rng, count):
    return unit(rng.normal(size=(count, 3)))


def around_directions(rng, count, spread, directions=8):
    """What a scan has: a few directions with noise, signs at random."""
    centers = on_the_sphere(rng, directions)
    normals = unit(centers[rng.integers(directions, size=count)] + rng.normal(scale=spread, size=(count, 3)))
    return normals * rng.choice([-1.0, 1.0], size=(count, 1))


def around_the_boundary_of_signs(rng, count):
    """x around 0: the sign that makes the first coordinate positive is different for neighbors."""
    angles = rng.uniform(0, 2 * np.pi, count)
    return unit(np.column_stack([rng.normal(scale=0.02, size=count), np.cos(angles), np.sin(angles)]))


def scan_normals(every):
    """Normals of every `every`-th point of a real scan, by this script's own arithmetic; None without the data."""
    folders = [Path(os.environ["TRYSQUARE_DATA"])] if "TRYSQUARE_DATA" in os.environ else []
    folders.append(Path(__file__).resolve().parents[2].parent / "shared" / "data")
    path = next((folder / SCAN for folder in folders if (folder / SCAN).is_file()), None)
    if path is None:
        return None
    points = np.fromfile(path, dtype=np.float32).reshape(-1, 4)[:, :3].astype(float)
    normals = []
    for neighbors in cKDTree(points).query_ball_point(points[::every], 1.0):
        if len(neighbors) >= 4:
            values, vectors = np.linalg.eigh(np.cov(points[neighbors].T))
            if 100 * values[0] < values[1]:
                normals.append(vectors[:, 0])
    return np.array(normals)


def labels_of(normals, method, signs, cut):
    done = subprocess.run([PROGRAM, method, signs, repr(cut)], input=np.ascontiguousarray(normals).tobytes(),
                          stdout=subprocess.PIPE, check=True)
    return np.frombuffer(done.stdout, dtype=np.uint32)


def distances(normals, signs):
    condensed = pdist(normals)
    return condensed if signs == "signed" else np.minimum(condensed, np.sqrt(np.maximum(0, 4 - condensed**2)))


def by_scipy(normals, method, signs, cut):
    tree = linkage(normals, "ward") if method == "ward" else linkage(distances(normals, signs), "complete")
    return fcluster(tree, cut, "distance")


def by_sklearn(normals, method, signs, cut):
    options = {"n_clusters": None, "distance_threshold": cut, "linkage": method}
    if signs == "signed":
        return AgglomerativeClustering(**options).fit_predict(normals)
    cosines = np.clip(np.abs(normals @ normals.T), 0, 1)
    return AgglomerativeClustering(metric="precomputed", **options).fit_predict(np.sqrt(2 - 2 * cosines))


class ComparisonTest(unittest.TestCase):
    num_compared = 0

    def assert_same_partition(self, normals, cut, what, kinds=KINDS):
        for method, signs in kinds:
            labels = labels_of(normals, method, signs, cut)
            self.assertEqual(len(labels), len(normals))
            peers = {"scipy": by_scipy} | ({"scikit-learn": by_sklearn} if AgglomerativeClustering else {})
            for name, peer in peers.items():
                theirs = peer(normals, method, signs, cut)
                pairs = {*zip(labels.tolist(), theirs.tolist())}
                sizes = (len({*labels.tolist()}), len({*theirs.tolist()}), len(pairs))
                self.assertEqual(len({*sizes}), 1, f"{what}, {method}, {signs}, cut {cut}: (clusters of ours, of "
                                                   f"{name}, common refinement) = {sizes}")
                ComparisonTest.num_compared += 1

    def scan_normals(self, every):
        normals = scan_normals(every)
        if normals is None:
            self.skipTest("NO REAL DATA: set TRYSQUARE_DATA to the folder that holds kitti00")
        return normals


class FastTest(ComparisonTest):
    def test_random_normals(self):
        for seed in range(4):
            rng = np.random.default_rng(seed)
            for cut in (0.05, 0.1, 0.3, 1.2):
                self.assert_same_partition(on_the_sphere(rng, 700), cut, f"sphere {seed}")

    def test_normals_around_a_few_directions(self):
        for seed, spread in enumerate((0.003, 0.01, 0.03, 0.1)):
            rng = np.random.default_rng(100 + seed)
            for cut in (0.1, 0.3):
                self.assert_same_partition(around_directions(rng, 900, spread), cut, f"directions {spread}")

    def test_normals_at_the_boundary_of_signs(self):
        for seed in range(4):
            normals = around_the_boundary_of_signs(np.random.default_rng(200 + seed), 800)
            self.assert_same_partition(normals, 0.1, f"boundary {seed}")

    def test_normals_of_a_scan(self):
        for every in (50, 83):
            normals = self.scan_normals(every)
            self.assertGreater(len(normals), 500)
            for cut in (0.03, 0.1):
                self.assert_same_partition(normals, cut, f"scan, every {every}")


class SlowTest(ComparisonTest):
    def test_many_normals_of_a_scan(self):
        self.assert_same_partition(self.scan_normals(6), 0.1, "scan, every 6")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    selection = parser.add_mutually_exclusive_group(required=True)
    selection.add_argument("--fast", dest="chosen", action="store_const", const=FastTest, help="many small inputs")
    selection.add_argument("--slow", dest="chosen", action="store_const", const=SlowTest, help="ten thousand normals")
    parser.add_argument("program")
    arguments = parser.parse_args()
    PROGRAM = arguments.program
    result = unittest.TextTestRunner().run(unittest.defaultTestLoader.loadTestsFromTestCase(arguments.chosen))
    for test, reason in result.skipped:
        print(f"!!! SKIPPED {test.id()}: {reason}")
    peers = "scipy and scikit-learn" if AgglomerativeClustering else "scipy"
    print(f"{ComparisonTest.num_compared} partitions compared with {peers}")
    sys.exit(0 if result.wasSuccessful() else 1)
