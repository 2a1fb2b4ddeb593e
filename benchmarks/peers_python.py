#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One Python peer once, in a process of its own; prints one line of JSON like neighborhood_peers. Needs open3d, numpy.

Engines: open3d (estimate_covariances by radius, then numpy's eigenvalues) and map-metrics, the loops of that package
(mpv and mme go over the points each for itself); with --mom KITTI_FOLDER its mom over 2000 queries.
"""

import argparse
import json
import os
import pathlib
import resource
import time

os.environ["OMP_NUM_THREADS"] = "1"  # Open3D reads it once, when it is loaded
import numpy as np
import open3d as o3d


def user_seconds():
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def chosen(num_points, every):
    """Blocks of 64 consecutive points, one out of `every`."""
    index = np.arange(num_points)
    return index[(index // 64) % every == 0]


def cloud_of(points):
    cloud = o3d.geometry.PointCloud()
    cloud.points = o3d.utility.Vector3dVector(points)
    return cloud


def run_open3d(points, queries, radius):
    """All points are queries: Open3D offers no choice. Builds its tree inside."""
    cloud = cloud_of(points)
    start = user_seconds()
    cloud.estimate_covariances(o3d.geometry.KDTreeSearchParamRadius(radius))
    np.linalg.eigvalsh(np.asarray(cloud.covariances))
    return {"build_user_s": 0.0, "query_user_s": user_seconds() - start, "num_queries": len(points),
            "neighbors_sum": None, "mpv": None, "mme": None}


def neighbors_covariance(points, tree, query, radius, least):
    _, index, _ = tree.search_radius_vector_3d(query, radius)
    if len(index) <= least:
        return None, len(index)
    return np.cov(points[np.asarray(index)].T), len(index)


def run_map_metrics(points, queries, radius):
    cloud = cloud_of(points)
    start = user_seconds()
    tree = o3d.geometry.KDTreeFlann(cloud)
    built = user_seconds()
    neighbors_sum, variances = 0, []
    for i in queries:
        covariance, count = neighbors_covariance(points, tree, points[i], radius, 5)
        neighbors_sum += count
        if covariance is not None:
            variances.append(min(np.linalg.eigvalsh(covariance)))
    entropies = []
    for i in queries:
        covariance, _ = neighbors_covariance(points, tree, points[i], radius, 5)
        if covariance is not None:
            determinant = np.linalg.det(2 * np.pi * np.e * covariance)
            if determinant > 0:
                entropies.append(0.5 * np.log(determinant))
    end = user_seconds()
    # Two calls of the package, each of which builds its tree.
    return {"build_user_s": 2 * (built - start), "query_user_s": end - built, "num_queries": len(queries),
            "neighbors_sum": neighbors_sum, "mpv": float(np.mean(variances)), "mme": float(np.mean(entropies))}


def kitti_scans(folder):
    """The scans and the poses of the LiDAR in the frame of scan 0."""
    rows = [line.split() for line in (folder / "calib.txt").read_text().splitlines()]
    calibration = np.eye(4)
    calibration[:3] = np.array([row[1:] for row in rows if row and row[0] == "Tr:"][0], float).reshape(3, 4)
    poses = []
    for row in np.loadtxt(folder / "poses.txt"):
        pose = np.eye(4)
        pose[:3] = row.reshape(3, 4)
        poses.append(np.linalg.inv(calibration) @ pose @ calibration)
    poses = [np.linalg.inv(poses[0]) @ pose for pose in poses]
    files = sorted((folder / "velodyne").glob("*.bin"))
    return [np.fromfile(file, np.float32).reshape(-1, 4)[:, :3].astype(float) for file in files], poses


def run_mom(folder, radius, local):
    """map-metrics' mom: aggregates the map, builds the tree, medians of the smallest eigenvalues. Reading included."""
    start = user_seconds()
    scans, poses = kitti_scans(folder)
    points = np.vstack([scan @ pose[:3, :3].T + pose[:3, 3] for scan, pose in zip(scans, poses)])
    first = scans[0]
    if local:
        first = first[(first[:, 0] > 4) & (first[:, 0] < 16) & (np.abs(first[:, 1]) < 8)]
    queries = first[:: max(len(first) // 2000, 1)][:2000]
    tree = o3d.geometry.KDTreeFlann(cloud_of(points))
    variances = []
    for query in queries:
        covariance, _ = neighbors_covariance(points, tree, query, radius, 3)
        if covariance is not None:
            variances.append(min(np.linalg.eigvalsh(covariance)))
    return {"engine": "map-metrics", "queries": "local" if local else "spread", "user_s": user_seconds() - start,
            "median_m2": float(np.median(variances))}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--engine", choices=["open3d", "map-metrics"], default="map-metrics")
    parser.add_argument("--map", type=pathlib.Path)
    parser.add_argument("--mom", type=pathlib.Path, metavar="KITTI_FOLDER")
    parser.add_argument("--local", action="store_true")
    parser.add_argument("--radius", type=float, default=1.0)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--version", action="store_true")
    arguments = parser.parse_args()
    if arguments.version:
        print(json.dumps({"open3d": o3d.__version__, "numpy": np.__version__}))
        return
    if arguments.mom:
        print(json.dumps(run_mom(arguments.mom, arguments.radius, arguments.local)))
        return
    points = np.ascontiguousarray(np.fromfile(arguments.map, float).reshape(-1, 4)[:, :3])
    run = {"open3d": run_open3d, "map-metrics": run_map_metrics}[arguments.engine]
    start = time.monotonic()
    result = run(points, chosen(len(points), arguments.every), arguments.radius)
    print(json.dumps({"engine": arguments.engine, "num_points": len(points), "radius_m": arguments.radius,
                      "every": arguments.every, "wall_s": time.monotonic() - start, **result}))


if __name__ == "__main__":
    main()
