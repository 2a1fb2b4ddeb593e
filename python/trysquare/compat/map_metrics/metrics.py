# SPDX-License-Identifier: Apache-2.0
"""The metrics of map-metrics, with its signatures. Definitions: docs/definitions.md, flavor `map-metrics`."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

import trysquare
from trysquare.compat.map_metrics._clouds import Many, PointCloud, map_from_scan, moved, points_of
from trysquare.compat.map_metrics.config import LidarConfig, more_than, radius_of
from trysquare.compat.map_metrics.utils.orthogonal import extract_orthogonal_subsets

__all__ = ["aggregate_map", "mme", "mom", "mpv"]

_FLAVOR = "map-metrics"
_MIN_NEIGHBORS_OF_MOM = 4  # the original asks for more than three, whatever the config says


def aggregate_map(pcs: Many, ts: Many) -> PointCloud:
    """All clouds in the frame of the first one.

    pcs: M clouds, each (N, 3) or of Open3D, in the sensor's frame [m]. ts: M poses (4, 4), `world_from_scan`.
    Returns a `PointCloud`: `.points` is (N, 3), in the order of the clouds. ValueError if the counts differ.
    """
    if len(pcs) != len(ts):
        raise trysquare.InvalidArgument(
            f"pcs, ts: found {len(pcs)} point clouds and {len(ts)} poses, expected as many of both"
        )
    poses = map_from_scan(ts)
    clouds = [points_of(cloud, f"pcs[{i}]") for i, cloud in enumerate(pcs)]
    points = np.empty((sum(map(len, clouds)), 3))
    begin = 0
    for pose, cloud in zip(poses, clouds, strict=True):
        moved(pose, cloud, points[begin : begin + len(cloud)])
        begin += len(cloud)
    return PointCloud(points)


def mme(pcs: Many, ts: Many, config: Any = LidarConfig) -> float:
    """Mean Map Entropy in nats: mean of ½ ln det(2πe Σ) over the points with more than `config.MIN_KNN` neighbors.

    Arguments as for `aggregate_map`. NaN and a TrysquareWarning when no point has an entropy.
    """
    points, settings = aggregate_map(pcs, ts).points, _settings(config)
    result = trysquare.mme(points, **settings)
    return _value_or_nan("mme", result.value, result.reason)


def mpv(pcs: Many, ts: Many, config: Any = LidarConfig) -> float:
    """Mean Plane Variance in m²: mean of λ₁ over the points with more than `config.MIN_KNN` neighbors.

    Arguments as for `aggregate_map`. NaN and a TrysquareWarning when no point has enough neighbors.
    """
    points, settings = aggregate_map(pcs, ts).points, _settings(config)
    result = trysquare.mpv(points, **settings)
    return _value_or_nan("mpv", result.value, result.reason)


def mom(pcs: Many, ts: Many, orth_list: Many | None = None, config: Any = LidarConfig) -> float:
    """Mutually Orthogonal Metric in m²: the median of λ₁ of each direction, summed over the directions.

    pcs, ts: as for `aggregate_map`.
    orth_list: up to three (K, 3), one for each direction, in the frame of the first cloud [m]; None: those that
        `extract_orthogonal_subsets` finds in `pcs[0]`, and its ValueError when there are none.

    Points with fewer than four neighbors do not count. NaN and a TrysquareWarning when a direction is left with none: a
    sum over the others would be too good.
    """
    points = aggregate_map(pcs, ts).points
    if orth_list is None:
        orth_list, _, _ = extract_orthogonal_subsets(pcs[0], config=config)
    directions = [points_of(direction, f"orth_list[{i}]") for i, direction in enumerate(orth_list)]
    if not directions:
        return _value_or_nan("mom", None, "orth_list is empty")
    settings = {**_settings(config), "min_neighbors": _MIN_NEIGHBORS_OF_MOM}
    result = trysquare.mom(points, directions, **settings)
    bare = [f"orth_list[{i}]" for i, direction in enumerate(result.directions) if direction.median is None]
    if bare:
        return _value_or_nan("mom", None, f"no point of {' and '.join(bare)} has four neighbors within the radius")
    return _value_or_nan("mom", result.value, result.reason)


def _settings(config: Any) -> dict[str, Any]:
    return {"radius_m": radius_of(config), "min_neighbors": more_than(config, "MIN_KNN"), "definition": _FLAVOR}


def _value_or_nan(name: str, value: float | None, reason: str) -> float:
    """The value, or NaN and a warning that points to who called the metric."""
    if value is None:
        warnings.warn(f"{name} is undefined: {reason}", trysquare.TrysquareWarning, stacklevel=3)
        return math.nan
    return value
