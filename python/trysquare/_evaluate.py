# SPDX-License-Identifier: Apache-2.0
"""The main job: what the map says of the poses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from trysquare import _core
from trysquare._arrays import as_matrix, as_points, as_poses, as_scans, as_subset
from trysquare._evaluation import Evaluation, evaluation_of
from trysquare._settings import as_progress, as_threads, evaluation_settings

Progress = Callable[[str, int, int], object]


def evaluate(
    scans: Any,
    poses: Any = None,
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
    subset: Any = None,
    subset_method: str | None = None,
    subset_scans: int | None = None,
    join_colinear: bool | None = None,
    reference: Any = None,
    extrinsic: Any = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> Evaluation:
    """MME, MPV, OMME, MOM, the RPE estimate in metres and the overlap of the map that poses make of scans.

    An argument that is None has the default of the library: default_settings() shows them.

    scans: N arrays (K, 3) [m], each in the frame of its sensor; clouds with `points`; a Dataset; or any sequence, which
        is then asked for one scan at a time. Points that are not finite or exactly at the origin are dropped.
    poses: (N, 4, 4) world_from_scan; None: those of the Dataset.
    metrics: of "mme", "mpv", "omme", "mom", "rpe"; None: all.
    radius_m: of the neighborhoods [m]; else the preset's ("lidar" 1.0, "depth" 0.2).
    min_neighbors: fewest points of a neighborhood, the query included; None: 6 for MME and MPV, 4 for MOM and OMME.
    min_range_m, max_range_m: points nearer to the sensor or farther away are dropped [m].
    definition: "paper", "map-metrics", "mapeval" or "ais-bonn".
    query_every: every n-th point of the map is evaluated.
    window, stride: scans per window and from one to the next; None: 10 from 20 scans on.
    subset: an orthogonal subset in the map frame (that of the first scan): up to three arrays (K, 3) [m], or an
        OrthogonalSubset; None: it is extracted by `subset_method`, "patches", "paper" or "map-metrics", from
        `subset_scans` scans, evenly spread; join_colinear: clusters co-linear with a direction join it ("paper").
    reference: (N, 4, 4) true poses, for RPE and APE; None: those of the Dataset, if it has some.
    extrinsic: (4, 4) body_from_sensor that is part of the poses, if any: helps to name mistakes of frames.
    threads: 0: all cores. Results are the same for every number, to the bit.
    progress: called with (stage, done, total) by the threads that work, one call at a time. What it raises is printed
        and does not stop the work; an interrupt (Ctrl-C) is raised when the work is done.

    Returns an Evaluation; what is undefined is None with the reason; `verdict` says whether the rest means anything.
    Raises InvalidArgument (a ValueError) naming the argument; IoError from scans that are files.
    Source: Kornilova & Ferrer, "Be your own Benchmark", sections III and IV; docs/definitions.md.
    """
    settings = evaluation_settings(
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
        join_colinear=join_colinear,
    )
    facts, own_poses, own_extrinsic = facts_of(scans, poses)
    directions = as_subset(subset)
    if directions is not None:
        facts.subset = "numpy arrays"
    if reference is not None:
        facts.reference, facts.reference_extrinsic = "numpy array", None
    elif hasattr(scans, "facts"):
        reference = scans.reference
    if extrinsic is None:
        extrinsic = own_extrinsic
    native = _core.evaluate(
        as_scans(scans),
        as_poses(own_poses, "poses"),
        settings,
        directions,
        None if reference is None else as_poses(reference, "reference"),
        None if extrinsic is None else as_matrix(extrinsic, "extrinsic"),
        facts,
        as_threads(threads),
        as_progress(progress),
    )
    return evaluation_of(native)


def evaluate_map(
    points: Any,
    *,
    metrics: Sequence[str] | str | None = None,
    radius_m: float | None = None,
    preset: str = "lidar",
    min_neighbors: int | None = None,
    definition: str | None = None,
    query_every: int | None = None,
    subset: Any = None,
    subset_method: str | None = None,
    join_colinear: bool | None = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> Evaluation:
    """The same for one registered map without poses: no overlap, no windows, no estimate of the trajectory error.

    points: (N, 3) [m] in the map frame, or a cloud. Points at the origin are kept; those that are not finite are
        dropped and counted.
    Other arguments, result and errors: as evaluate().
    """
    settings = evaluation_settings(
        preset,
        metrics,
        min_neighbors,
        radius_m=radius_m,
        definition=definition,
        query_every=query_every,
        subset_method=subset_method,
        join_colinear=join_colinear,
    )
    facts = _core.InputFacts()
    facts.scans, facts.poses = "numpy array", None
    directions = as_subset(subset)
    if directions is not None:
        facts.subset = "numpy arrays"
    num_threads, hear = as_threads(threads), as_progress(progress)
    native = _core.evaluate_map(as_points(points, "points"), settings, directions, facts, num_threads, hear)
    return evaluation_of(native)


def facts_of(scans: Any, poses: Any) -> tuple[_core.InputFacts, Any, Any]:
    """Where the inputs came from, the poses and the extrinsic; a Dataset brings its own."""
    facts = _core.InputFacts()
    own_facts = getattr(scans, "facts", None)
    if own_facts is None:
        if poses is None:
            raise _core.InvalidArgument("poses: expected an (M, 4, 4) array, found None: only a Dataset brings its own")
        return facts, poses, None
    facts.scans = own_facts.scans
    facts.left_handed = own_facts.left_handed
    facts.reference = own_facts.reference
    facts.reference_extrinsic = own_facts.reference_extrinsic
    if poses is not None:
        return facts, poses, None
    facts.poses = own_facts.poses
    facts.poses_format = own_facts.poses_format
    facts.extrinsic_source = own_facts.extrinsic_source
    facts.warnings = own_facts.warnings
    return facts, scans.poses, scans.extrinsic
