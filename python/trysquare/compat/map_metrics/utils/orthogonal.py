# SPDX-License-Identifier: Apache-2.0
"""The orthogonal subset as map-metrics finds it, and its files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from trysquare import _core
from trysquare.compat.map_metrics._clouds import Array, Many, map_from_scan, moved, normals_of, points_of
from trysquare.compat.map_metrics._subset_files import read_directions, read_pose
from trysquare.compat.map_metrics.config import LidarConfig, max_nearest_of, more_than, radius_of

__all__ = ["extract_orthogonal_subsets", "read_orthogonal_subset"]

_PLANARITY_RATIO = 100.0
_MIN_NEIGHBORS = 4
_LINKAGE_CUT = 0.1


def extract_orthogonal_subsets(
    pc: Any, config: Any = LidarConfig, eps: float = 1e-1
) -> tuple[list[Array], list[Array], list[Array]]:
    """Planar points of one cloud that face three mutually orthogonal directions.

    Planar is 100 λ₁ < λ₂ within `config.KNN_RAD`. The normals are those of the cloud, or of the `config.MAX_NN` nearest
    points within that radius. Ward's linkage, cut at 0.1, groups them by their sign too; of the groups of more than
    `config.MIN_CLUST_SIZE` three with |n·m| < eps and the most points together are taken.

    Returns three lists with an entry for each direction, the largest first: points (K, 3) in the frame of the cloud,
    in metres, their normals (K, 3), and the mean normal (3,) of length 1. InvalidArgument, a ValueError, if there are
    no three such directions.

    Source: map-metrics 0.0.4; docs/definitions.md#orthogonal-subset.
    """
    if not 0 < eps < 1 / 3:
        raise _core.InvalidArgument(f"eps = {eps!r}: expected a number between 0 and 1/3")
    points, normals = _planar(pc, config)
    if len(points) == 0:
        raise _core.InvalidArgument("pc: no orthogonal subset: none of its points lies in a plane")
    labels = _core.ward_clusters(normals, _LINKAGE_CUT)
    groups = [np.flatnonzero(labels == label) for label in range(int(labels.max()) + 1)]
    groups = [group for group in groups if len(group) >= more_than(config, "MIN_CLUST_SIZE")]
    means = np.reshape([normals[group].mean(axis=0) for group in groups], (-1, 3))
    means /= np.linalg.norm(means, axis=1, keepdims=True)
    clique = _core.largest_orthogonal_clique(means, [len(group) for group in groups], float(eps))
    if len(clique) < 3:
        raise _core.InvalidArgument(
            f"pc: no orthogonal subset: found {len(clique)} mutually orthogonal directions in {len(points)} "
            f"planar points and {len(groups)} groups of normals, expected 3"
        )
    chosen = [groups[i] for i in clique]
    return [points[group] for group in chosen], [normals[group] for group in chosen], [means[i] for i in clique]


def read_orthogonal_subset(orth_subset_name: Path | str, orth_pose_name: Path | str, ts: Many) -> list[Array]:
    """An orthogonal subset from its files, in the frame of the first cloud.

    orth_subset_name: a `.npz` with one (K, 3) array for each direction; a `.npy` of shape (D, K, 3); or a pattern such
        as 'subset-*.npy', one (K, 3) file for each direction. A `.npy` with a pickle inside, which the original reads,
        is not opened, because a pickle runs code: write its arrays to files of their own where you trust it, for
        example with `numpy.savez("subset.npz", *numpy.load("subset.npy", allow_pickle=True))`.
    orth_pose_name: text file with a 4 × 4 `world_from_scan` of the cloud that the subset was taken from; further
        columns are ignored.
    ts: the poses (4, 4) of the clouds.

    Returns one (K, 3) array [m] for each direction. IoError (an OSError) names the file and what was found.
    """
    if len(ts) == 0:
        raise _core.InvalidArgument("ts: found no pose, expected those of the clouds")
    map_from_subset = map_from_scan([*ts[:1], read_pose(orth_pose_name)])[-1]
    return [moved(map_from_subset, direction) for direction in read_directions(orth_subset_name)]


def _planar(pc: Any, config: Any) -> tuple[Array, Array]:
    """Points with a flat neighborhood, and their normals."""
    points, radius_m = points_of(pc, "pc"), radius_of(config)
    max_nearest = max_nearest_of(config)
    planar: Array = _core.planar_points(points, radius_m, _PLANARITY_RATIO, _MIN_NEIGHBORS, 0)
    normals = normals_of(pc, "pc.normals")
    if normals is None:
        return planar, _core.nearest_neighbor_normals(points, planar, radius_m, max_nearest, 0)
    if normals.shape != points.shape:
        raise _core.InvalidArgument(f"pc.normals: found {len(normals)} for {len(points)} points")
    is_planar = np.isin(_rows(points), _rows(planar))  # a point and its copy have the same neighborhood
    return points[is_planar], normals[is_planar]


def _rows(points: Array) -> Any:
    """(N,) values that are equal where the points (N, 3) are."""
    return np.ascontiguousarray(points).view(np.dtype((np.void, 24))).ravel()
