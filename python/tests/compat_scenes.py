# SPDX-License-Identifier: Apache-2.0
"""Scenes for the drop-in of map-metrics, and what the original makes of them.

Run it where map-metrics 0.0.4 and Open3D are installed, to get the values that test_compat.py compares with:

    python python/tests/compat_scenes.py        # map-metrics 0.0.4, open3d 0.18.0, scikit-learn 1.9.1, numpy 1.26.4
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np


def _digits(values: Any) -> Any:
    """Rounded, so that the scenes are the same where sin and cos are not; also the pose files of real data are."""
    return np.round(values, 6)


def room(rng: np.random.Generator, num_points: int = 900) -> Any:
    """Points on three walls that meet in a corner, 1 cm of noise, seen from the point (2, 2, 1.5): (3 · N, 3)."""
    walls = []
    for axis in range(3):
        wall = rng.uniform(0.0, 3.0, (num_points, 3))
        wall[:, axis] = 0.01 * rng.standard_normal(num_points)
        walls.append(wall)
    return np.concatenate(walls)


def pose(yaw: float, position: Any) -> Any:
    matrix = np.eye(4)
    matrix[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    matrix[:3, 3] = position
    return _digits(matrix)


def scans_and_poses() -> tuple[list[Any], list[Any]]:
    """Three scans of the room in the sensor's frame, and poses that are off by centimetres, far from the origin."""
    rng = np.random.default_rng(2021)
    scans, poses = [], []
    for i in range(3):
        true = pose(0.1 + 0.4 * i, [500.0 + 0.3 * i, -200.0, 30.0])
        in_world = room(rng) + np.array([500.0, -200.0, 30.0]) - np.array([2.0, 2.0, 1.5])
        scans.append(_digits((in_world - true[:3, 3]) @ true[:3, :3]))
        poses.append(pose(0.1 + 0.405 * i, true[:3, 3] + 0.02 * i))
    return scans, poses


def orthogonal_subset(scan: Any) -> list[Any]:
    """The middle of each wall as the first scan sees it, every fifth point."""
    return [scan[900 * wall : 900 * (wall + 1) : 5] for wall in range(3)]


def normals(scan: Any, num_walls: int = 3) -> Any:
    """Unit normals that scatter about those of the walls, every tenth one of the first wall turned round: (N, 3)."""
    rng = np.random.default_rng(7)
    walls = pose(0.1, [0, 0, 0])[:3, :3].T @ np.eye(3)
    found = np.repeat(walls.T, len(scan) // num_walls, axis=0) + 0.02 * rng.standard_normal(scan.shape)
    found[0:900:10] *= -1
    return _digits(found / np.linalg.norm(found, axis=1, keepdims=True))


CONFIGS: dict[str, dict[str, Any]] = {
    "lidar": {"knn_rad": 1.0},
    "depth": {"knn_rad": 0.2},
    "custom": {"knn_rad": 0.3, "min_knn": 40, "max_nn": 12, "min_clust_size": 20},
}
SPARSE: dict[str, Any] = {"knn_rad": 0.07}


def _original_values() -> dict[str, Any]:
    import map_metrics.config
    import map_metrics.metrics
    import map_metrics.utils.orthogonal
    import open3d as o3d

    scans, poses = scans_and_poses()
    clouds = [o3d.geometry.PointCloud(o3d.utility.Vector3dVector(scan)) for scan in scans]
    values: dict[str, Any] = {}
    sparse = map_metrics.config.CustomConfig(**SPARSE)  # most points have three to six neighbors
    values["mme sparse"] = map_metrics.metrics.mme(clouds, poses, sparse)
    values["mpv sparse"] = map_metrics.metrics.mpv(clouds, poses, sparse)
    values["mom sparse"] = map_metrics.metrics.mom(clouds, poses, orthogonal_subset(scans[0]), sparse)
    for name, settings in CONFIGS.items():
        config = map_metrics.config.CustomConfig(**settings)
        values[f"mme {name}"] = map_metrics.metrics.mme(clouds, poses, config)
        values[f"mpv {name}"] = map_metrics.metrics.mpv(clouds, poses, config)
        values[f"mom {name}"] = map_metrics.metrics.mom(clouds, poses, orthogonal_subset(scans[0]), config)
        with_normals = o3d.geometry.PointCloud(clouds[0])
        with_normals.normals = o3d.utility.Vector3dVector(normals(scans[0]))
        try:
            points, _, means = map_metrics.utils.orthogonal.extract_orthogonal_subsets(with_normals, config)
            values[f"extracted {name}"] = sorted(
                [[len(p), *np.sum(p, axis=0).tolist(), *m.tolist()] for p, m in zip(points, means, strict=True)],
                reverse=True,
            )
            values[f"mom of extracted {name}"] = map_metrics.metrics.mom(
                [with_normals, *clouds[1:]], poses, config=config
            )
        except ValueError as error:
            values[f"extracted {name}"] = str(error)
    few = [o3d.geometry.PointCloud(o3d.utility.Vector3dVector(np.eye(3)))]
    values["mme of three points"] = map_metrics.metrics.mme(few, [np.eye(4)])
    values["mpv of three points"] = map_metrics.metrics.mpv(few, [np.eye(4)])
    return values


if __name__ == "__main__":
    print(json.dumps(_original_values(), indent=4, default=float))
