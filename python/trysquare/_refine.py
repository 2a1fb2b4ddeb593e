# SPDX-License-Identifier: Apache-2.0
"""The trajectory in which the scans agree on their flat surfaces."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare import _core
from trysquare._arrays import as_poses, as_scans
from trysquare._evaluate import Progress, facts_of
from trysquare._evaluation import RpeEstimate
from trysquare._settings import adjustment_settings, as_progress, as_threads


@dataclasses.dataclass(frozen=True, eq=False)
class Refinement:
    """Adjusted poses, and what the correction amounts to."""

    poses: NDArray[np.float64] | None  #: (M, 4, 4) world_from_scan, the first as given; None: the estimate is refused.
    estimate: RpeEstimate  #: How far the given poses are off; `estimate.reasons` says why there are none.


def refine(
    scans: Any,
    poses: Any = None,
    *,
    preset: str = "lidar",
    min_range_m: float | None = None,
    max_range_m: float | None = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> Refinement:
    """Adjusts the poses to the planar patches that the scans share.

    scans, poses, threads, progress: as in evaluate(). preset: "lidar", or "depth" for rooms.
    min_range_m, max_range_m: points nearer to the sensor or farther away are dropped [m].
    Raises InvalidArgument. A refusal is a result: `poses` is None. Source: docs/definitions.md#rpe-estimate.
    """
    settings = adjustment_settings(preset, min_range_m=min_range_m, max_range_m=max_range_m)
    own_poses = facts_of(scans, poses)[1]
    adjusted, text = _core.refine(
        as_scans(scans), as_poses(own_poses, "poses"), settings, as_threads(threads), as_progress(progress)
    )
    return Refinement(adjusted, RpeEstimate.from_json(json.loads(text)["rpe_estimate"]))
