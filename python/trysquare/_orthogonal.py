# SPDX-License-Identifier: Apache-2.0
"""Surfaces that are at right angles to each other."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare import _core
from trysquare._arrays import as_poses, as_scans
from trysquare._evaluate import Progress, facts_of
from trysquare._files import write_text
from trysquare._settings import as_progress, as_threads, evaluation_settings


@dataclasses.dataclass(frozen=True, eq=False)
class OrthogonalDirection:
    """Points of the surfaces that face one direction."""

    normal: NDArray[np.float64]  #: (3,) unit vector, map frame, sign arbitrary.
    points: NDArray[np.float64]  #: (K, 3) [m], map frame.


@dataclasses.dataclass(frozen=True, eq=False)
class OrthogonalSubset:
    """Up to three mutually orthogonal directions; fewer than three is the degenerate case, and `reason` says why."""

    directions: list[OrthogonalDirection]
    reason: str
    num_points: int  #: Points looked at.
    num_planar: int  #: Of these, on a plane.
    text: str = dataclasses.field(repr=False)

    def to_json(self, path: Any = None) -> str:
        """The JSON text, schema trysquare.orthogonal/1; written to `path` when one is given."""
        if path is not None:
            write_text(path, self.text)
        return self.text


def extract_orthogonal_subset(
    scans: Any,
    poses: Any = None,
    *,
    radius_m: float | None = None,
    preset: str = "lidar",
    method: str | None = None,
    num_scans: int | None = None,
    join_colinear: bool | None = None,
    min_range_m: float | None = None,
    max_range_m: float | None = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> OrthogonalSubset:
    """Finds up to three mutually orthogonal directions and the planar points that face them.

    scans, poses, preset, join_colinear, min_range_m, max_range_m, threads, progress: as in evaluate(); one scan, an
        (N, 3) array, needs no poses.
    radius_m: of the metrics' neighborhoods [m]; method: "patches", "paper" or "map-metrics".
    num_scans: so many scans, evenly spread, are looked at; None: the method's own number.

    Raises InvalidArgument. Source: the paper, section IV-B; docs/definitions.md#orthogonal-subset.
    """
    settings = evaluation_settings(
        preset,
        radius_m=radius_m,
        subset_method=method,
        subset_scans=num_scans,
        join_colinear=join_colinear,
        min_range_m=min_range_m,
        max_range_m=max_range_m,
    )
    if poses is None and (hasattr(scans, "points") or getattr(scans, "ndim", None) == 2):
        scans, poses = [scans], np.eye(4)[np.newaxis]
    facts, own_poses, _ = facts_of(scans, poses)
    found = _core.extract_orthogonal_subset(
        as_scans(scans),
        as_poses(own_poses, "poses"),
        settings,
        as_threads(threads),
        as_progress(progress),
        facts.scans,
        facts.poses or "numpy arrays",
    )
    directions = [OrthogonalDirection(found.normal(i), found.points(i)) for i in range(len(found))]
    return OrthogonalSubset(directions, found.reason, found.num_points, found.num_planar, found.json)
