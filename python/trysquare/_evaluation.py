# SPDX-License-Identifier: Apache-2.0
"""What evaluate() finds out. Names, units and reasons are those of the JSON (docs/schema/evaluation.schema.json)."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trysquare import _core
from trysquare._files import write_text
from trysquare._result import Result

if TYPE_CHECKING:
    import pandas

Vector = list[float]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Inputs(Result):
    """What an evaluation was made of."""

    scans: str
    poses: str | None
    poses_format: str | None
    left_handed: bool
    extrinsic: str | None
    reference: str | None
    reference_extrinsic: str | None
    subset: str | None
    num_scans: int
    num_points: int
    num_dropped_points: int
    num_not_finite_points: int
    num_origin_points: int
    num_out_of_range_points: int
    num_duplicate_points: int


@dataclasses.dataclass(frozen=True, kw_only=True)
class MetricResult(Result):
    """MME [nats] or MPV [m2]: lower is better. `value` is None with a `reason` when no point is defined."""

    value: float | None
    unit: str
    num_queries: int
    num_used: int
    num_degenerate: int
    num_too_few: int
    reason: str | None = None


@dataclasses.dataclass(frozen=True, kw_only=True)
class Direction(Result):
    """What the points of one direction say; `normal` is a unit vector in the map frame."""

    normal: Vector | None
    num_points: int
    num_used: int
    num_degenerate: int
    num_too_few: int
    mean: float | None
    median: float | None
    reason: str | None = None


@dataclasses.dataclass(frozen=True, kw_only=True)
class OrthogonalMetricResult(MetricResult):
    """MOM [m2] or OMME [nats]: lower is better.

    `follows_trajectory_error` is False with fewer than three directions: then only runs on one scene can be compared.
    """

    mean_of_means: float | None
    sum_of_medians: float | None
    directions: list[Direction]
    follows_trajectory_error: bool


@dataclasses.dataclass(frozen=True, kw_only=True)
class Overlap(Result):
    """Whether the neighborhoods hold points of several scans; without that a map says nothing of its poses."""

    num_neighborhoods: int
    scans_per_neighborhood_mean: float | None
    multi_scan_share: float | None
    neighbors_mean: float | None
    line_like_share: float | None
    reason: str | None = None


@dataclasses.dataclass(frozen=True, kw_only=True)
class PoseTie(Result):
    """How well the poses `first_pose` to `last_pose`, inclusive, hold each other by the planes that they share.

    Groups of them slide past each other along `direction` (map frame) where `eigenvalue` is below `limit`.
    """

    eigenvalue: float | None
    limit: float | None
    first_pose: int
    last_pose: int
    direction: Vector


@dataclasses.dataclass(frozen=True, kw_only=True)
class Observability(Result):
    """How well the surfaces fix the poses; `weak_direction` is a unit vector in the map frame."""

    smallest_eigenvalue: float | None
    weak_direction: Vector | None
    weakest_tie: PoseTie | None


@dataclasses.dataclass(frozen=True, kw_only=True)
class PairRpe(Result):
    """The estimate for pairs of poses that are `delta` apart (`unit`: f frames, m metres), judged by itself."""

    delta: float
    unit: str
    num_pairs: int
    status: str
    translation_rms_m: float | None
    rotation_rms_deg: float | None
    interval_m: tuple[float, float] | None
    upper_bound_m: float | None
    half_difference_m: float | None
    half_difference_deg: float | None


@dataclasses.dataclass(frozen=True, kw_only=True)
class PoseError(Result):
    """By how much a pose is off, in the map frame; `suspect` when it stands out from those around it."""

    index: int
    translation_error_m: Vector
    rotation_error_deg: Vector
    sigma_m: float | None
    sigma_deg: float | None
    num_observations: int
    score: float | None
    suspect: bool


@dataclasses.dataclass(frozen=True, kw_only=True)
class RpeEstimate(Result):
    """Trajectory error without ground truth: the RPE over all pairs, in metres and degrees. Lower is better.

    `status` is "measured", "bound" (at most `upper_bound_m`) or "refused", and `reasons` says which rule failed and by
    how much. `interval_covers` says what the intervals mean. Source: docs/definitions.md#rpe-estimate.
    """

    status: str
    reasons: list[str]
    translation_rms_m: float | None
    rotation_rms_deg: float | None
    interval_m: tuple[float, float] | None
    interval_deg: tuple[float, float] | None
    interval_covers: str
    upper_bound_m: float | None
    half_difference_m: float | None
    half_difference_deg: float | None
    last_step_m: float | None
    last_step_deg: float | None
    num_iterations: int
    systematic_indicator_m: float | None
    mom_debiased_m: float | None
    num_patches: int
    observations_per_pose_min: int
    least_share_of_neighbors: float | None
    num_components: int
    within_scan_sigma_m: float | None
    observability: Observability
    by_pairs: list[PairRpe]
    poses: list[PoseError]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Statistics(Result):
    """Statistics of errors, under evo's names."""

    rmse: float
    mean: float
    median: float
    std: float
    min: float
    max: float
    sse: float
    unit: str | None = None
    relation: str | None = None
    pairs: str | None = None
    alignment: str | None = None
    num_pairs: int | None = None
    num_poses: int | None = None


@dataclasses.dataclass(frozen=True, kw_only=True)
class ReferenceErrors(Result):
    """Errors against the reference: RPE over all pairs [m, deg], APE after SE(3) alignment [m]."""

    rpe: Statistics
    rpe_rotation: Statistics
    ape: Statistics | None
    paper_rpe: float
    paper_rpe_unit: str


@dataclasses.dataclass(frozen=True, kw_only=True)
class Window(Result):
    """The metrics of the map of the scans `first` to `last`, inclusive."""

    first: int
    last: int
    mom: float | None
    omme: float | None
    mpv: float | None
    mme: float | None
    follows_trajectory_error: bool | None
    rpe_estimate_m: float | None
    rpe_m: float | None
    overlap: Overlap
    meaningful: bool


@dataclasses.dataclass(frozen=True, kw_only=True)
class WindowCorrelation(Result):
    """How a metric of the windows goes along with their true RPE."""

    metric: str
    num_windows: int
    pearson: float | None
    spearman: float | None
    kendall_tau_b: float | None
    reason: str | None = None


@dataclasses.dataclass(frozen=True, kw_only=True)
class Warning(Result):
    """Something that a reader of the numbers should know."""

    code: str
    message: str


@dataclasses.dataclass(frozen=True, kw_only=True)
class Verdict(Result):
    """Whether the numbers mean anything, and why not."""

    meaningful: bool
    reasons: list[str]


@dataclasses.dataclass(frozen=True, kw_only=True)
class TrajectoryInMap(Result):
    """Where the sensor stood, in the map frame [m]."""

    num_poses: int
    path_length_m: float
    positions_in_map_m: list[Vector]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Metrics(Result):
    """The metrics of the whole map; None: not asked for."""

    mme: MetricResult | None
    mpv: MetricResult | None
    mom: OrthogonalMetricResult | None
    omme: OrthogonalMetricResult | None


@dataclasses.dataclass(frozen=True, kw_only=True, eq=False)
class MapPoints:
    """The map and the values of its points; rows belong together. NaN: the point has no value."""

    points_in_map: NDArray[np.float64]  #: (N, 3) [m], map frame: that of the first scan.
    scan_of_point: NDArray[np.uint32]  #: (N,)
    query_indices: NDArray[np.uint64]  #: (M,) which points of the map have values.
    plane_variances: NDArray[np.float64]  #: (M,) [m2]
    entropies: NDArray[np.float64]  #: (M,) [nats]
    num_neighbors: NDArray[np.uint32]  #: (M,)
    num_scans: NDArray[np.uint32]  #: (M,) distinct scans among the neighbors.


@dataclasses.dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Evaluation(Result):
    """Everything evaluate() finds out. `to_json()` is the text that the command prints for the same input."""

    inputs: Inputs
    settings: dict[str, Any]
    metrics: Metrics
    overlap: Overlap
    rpe_estimate: RpeEstimate | None
    reference: ReferenceErrors | None
    windows: list[Window]
    num_scans_outside_windows: int
    window_correlations: list[WindowCorrelation]
    warnings: list[Warning]
    verdict: Verdict
    trajectory: TrajectoryInMap | None
    world_from_map: list[Vector]
    points: MapPoints
    subset: list[NDArray[np.float64]]  #: Points by direction, (K, 3) [m], map frame.
    adjusted_poses: NDArray[np.float64] | None  #: (M, 4, 4); None: refused.
    text: str

    def __repr__(self) -> str:
        """What fits into a line; to_json() has everything."""
        parts = [f"{self.inputs.num_scans} scans", f"{self.inputs.num_points} points"]
        for name in ("mom", "mpv", "mme", "omme"):
            metric = getattr(self, name)
            if metric is not None:
                parts.append(f"{name} {'undefined' if metric.value is None else f'{metric.value:.6g} {metric.unit}'}")
        if self.rpe_estimate is not None:
            metres = self.rpe_estimate.translation_rms_m
            parts.append(f"rpe {self.rpe_estimate.status}" + ("" if metres is None else f" {metres:.4g} m"))
        parts.append("meaningful" if self.verdict.meaningful else "means nothing: " + "; ".join(self.verdict.reasons))
        return f"<Evaluation: {', '.join(parts)}>"

    @property
    def mme(self) -> MetricResult | None:
        """Mean map entropy [nats]."""
        return self.metrics.mme

    @property
    def mpv(self) -> MetricResult | None:
        """Mean plane variance [m2]."""
        return self.metrics.mpv

    @property
    def mom(self) -> OrthogonalMetricResult | None:
        """Mutually orthogonal metric [m2]."""
        return self.metrics.mom

    @property
    def omme(self) -> OrthogonalMetricResult | None:
        """Orthogonal mean map entropy [nats]."""
        return self.metrics.omme

    def to_json(self, path: str | Path | None = None) -> str:
        """The JSON text; written to `path`, whole or not at all, when one is given."""
        if path is not None:
            write_text(path, self.text)
        return self.text

    def to_pandas(self) -> pandas.DataFrame:
        """One row per window, or one row of the whole map when there are no windows. Needs pandas."""
        from trysquare._pandas import frame_of

        rows: list[dict[str, Any]] = [window_row(window) for window in self.windows]
        return frame_of(rows or [self._whole()])

    def _whole(self) -> dict[str, Any]:
        estimate = self.rpe_estimate
        row: dict[str, Any] = {"first": 0, "last": self.inputs.num_scans - 1}
        for name in ("mom", "omme", "mpv", "mme"):
            metric = getattr(self, name)
            row[name] = None if metric is None else metric.value
        row["rpe_estimate_m"] = None if estimate is None else estimate.translation_rms_m
        row["rpe_m"] = None if self.reference is None else self.reference.rpe.rmse
        row["multi_scan_share"] = self.overlap.multi_scan_share
        row["meaningful"] = self.verdict.meaningful
        return row


def window_row(window: Window) -> dict[str, Any]:
    """A window as a row of a table."""
    names = "first last mom omme mpv mme rpe_estimate_m rpe_m".split()
    row = {name: getattr(window, name) for name in names}
    return {**row, "multi_scan_share": window.overlap.multi_scan_share, "meaningful": window.meaningful}


def evaluation_of(native: _core.NativeEvaluation) -> Evaluation:
    """The result from that of the library. Arrays are views of it; nothing is copied."""
    points = MapPoints(
        points_in_map=native.points_in_map,
        scan_of_point=native.scan_of_point,
        query_indices=native.query_indices,
        plane_variances=native.plane_variances,
        entropies=native.entropies,
        num_neighbors=native.num_neighbors,
        num_scans=native.num_scans,
    )
    return Evaluation.from_json(
        json.loads(native.json),
        points=points,
        subset=list(native.subset),
        adjusted_poses=native.adjusted,
        text=native.json,
    )
