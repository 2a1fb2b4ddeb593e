# SPDX-License-Identifier: Apache-2.0
"""Which of several trajectories of the same scans is better, and whether the difference is real."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from trysquare import _core
from trysquare._arrays import as_poses, as_scans
from trysquare._comparison import Comparison, comparison_of
from trysquare._evaluate import Progress
from trysquare._settings import as_progress, as_threads, evaluation_settings, set_given


def compare(
    scans: Any,
    candidates: Mapping[str, Any],
    *,
    metrics: Sequence[str] | str | None = None,
    radius_m: float | None = None,
    preset: str = "lidar",
    min_neighbors: int | None = None,
    definition: str | None = None,
    query_every: int | None = None,
    min_range_m: float | None = None,
    max_range_m: float | None = None,
    window: int | None = None,
    stride: int | None = None,
    subset_method: str | None = None,
    subset_scans: int | None = None,
    confidence: float | None = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> Comparison:
    """Evaluates every trajectory by itself, measures all against the poses in which the scans agree, and pairs windows.

    scans: as in evaluate().
    candidates: name: (N, 4, 4) world_from_scan, two or more; each may have a world of its own.
    window: scans per window; None: 2 to 10, so that there are ten windows if possible. Windows may not overlap.
    confidence: of intervals; a difference is real at p <= 1 - confidence. None: 0.95.
    Other arguments: as in evaluate().

    p-values are exact (sign flips of windows) and corrected for the number of pairs. Raises InvalidArgument.
    Source: docs/definitions.md#comparison.
    """
    if not isinstance(candidates, Mapping):
        found = type(candidates).__name__
        raise _core.InvalidArgument(f"candidates: expected a dict of names and (M, 4, 4) arrays, found {found}")
    settings = _core.ComparisonSettings()
    settings.evaluation = evaluation_settings(
        preset,
        metrics,
        min_neighbors,
        radius_m=radius_m,
        definition=definition,
        query_every=query_every,
        min_range_m=min_range_m,
        max_range_m=max_range_m,
        window=window,
        stride=stride,
        subset_method=subset_method,
        subset_scans=subset_scans,
    )
    set_given(settings, confidence=confidence)
    poses = [as_poses(each, f"candidates[{name!r}]") for name, each in candidates.items()]
    facts = getattr(scans, "facts", None)
    scans_name = "numpy arrays" if facts is None else facts.scans
    names = [str(name) for name in candidates]
    return comparison_of(
        *_core.compare(as_scans(scans), names, poses, settings, scans_name, as_threads(threads), as_progress(progress))
    )
