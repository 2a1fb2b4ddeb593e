# SPDX-License-Identifier: Apache-2.0
"""What is wrong with scans and poses, from frames to single poses."""

from __future__ import annotations

from typing import Any

from trysquare import _core
from trysquare._arrays import as_matrix, as_poses, as_scans, as_stamps
from trysquare._diagnosis import Diagnosis, diagnosis_of
from trysquare._evaluate import Progress, facts_of
from trysquare._settings import adjustment_settings, as_progress, as_threads, set_given


def diagnose(
    scans: Any,
    poses: Any = None,
    *,
    radius_m: float | None = None,
    max_time_offset_s: float | None = None,
    preset: str = "lidar",
    min_range_m: float | None = None,
    max_range_m: float | None = None,
    all_poses: Any = None,
    all_stamps_ns: Any = None,
    extrinsic: Any = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> Diagnosis:
    """Looks for what is commonly wrong: frames, handedness, clocks, gaps and copies, single poses, jumps, ghost walls.

    scans, poses, preset, extrinsic, min_range_m, max_range_m, threads, progress: as in evaluate().
    radius_m: of the neighborhoods by which frames are compared [m].
    max_time_offset_s: offsets between the clocks of scans and poses are sought up to this [s].
    all_poses, all_stamps_ns: (M, 4, 4) poses of the sensor with their (M,) times [ns], also those between the scans:
        for the time offset, where the scans have times. A Dataset brings its own.

    Raises InvalidArgument. Findings are results, not errors. Source: docs/definitions.md#diagnosis.
    """
    settings = set_given(_core.DiagnosisSettings(), radius_m=radius_m, max_time_offset_s=max_time_offset_s)
    settings.adjustment = adjustment_settings(preset, min_range_m=min_range_m, max_range_m=max_range_m)
    facts, own_poses, own_extrinsic = facts_of(scans, poses)
    if poses is None and all_poses is None:
        all_poses, all_stamps_ns = scans.all_poses, scans.all_stamps_ns
    if (all_poses is None) != (all_stamps_ns is None):
        raise _core.InvalidArgument("all_poses and all_stamps_ns: expected both or none")
    extrinsic = own_extrinsic if extrinsic is None else extrinsic
    return diagnosis_of(
        _core.diagnose(
            as_scans(scans),
            as_poses(own_poses, "poses"),
            settings,
            None if all_poses is None else as_poses(all_poses, "all_poses"),
            as_stamps(all_stamps_ns, "all_stamps_ns"),
            None if extrinsic is None else as_matrix(extrinsic, "extrinsic"),
            facts,
            as_threads(threads),
            as_progress(progress),
        )
    )
