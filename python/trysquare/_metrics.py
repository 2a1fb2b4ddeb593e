# SPDX-License-Identifier: Apache-2.0
"""Single metrics of a registered map, with the value of every point."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare import _core
from trysquare._arrays import as_points, as_subset
from trysquare._settings import as_threads, evaluation_settings


@dataclasses.dataclass(frozen=True, eq=False)
class PointMetric:
    """MME [nats] or MPV [m2] of a map: lower is better."""

    value: float | None  #: None: no point is defined, and `reason` says why.
    reason: str
    #: (M,) in the order of the queries; NaN: undefined.
    per_point: NDArray[np.float64] = dataclasses.field(repr=False)
    num_neighbors: NDArray[np.uint32] = dataclasses.field(
        repr=False
    )  #: (M,) points in the neighborhood, the query included if it is one of the map.
    num_queries: int
    num_used: int
    num_degenerate: int
    num_too_few: int


@dataclasses.dataclass(frozen=True)
class MetricOfDirection:
    """What the points of one direction say; `mean` and `median` are None when none of them is defined."""

    num_points: int
    num_used: int
    num_degenerate: int
    num_too_few: int
    mean: float | None
    median: float | None


@dataclasses.dataclass(frozen=True, eq=False)
class OrthogonalMetric:
    """MOM [m2] or OMME [nats] of a map: lower is better."""

    value: float | None  #: None: no direction is defined, and `reason` says why.
    reason: str
    mean_of_means: float | None  #: The paper's.
    sum_of_medians: float | None  #: map-metrics'.
    directions: list[MetricOfDirection]
    per_point: list[NDArray[np.float64]] = dataclasses.field(repr=False)  #: For each direction, (K,); NaN: undefined.
    follows_trajectory_error: bool  #: False with fewer than three directions.


def mme(
    points: Any,
    *,
    radius_m: float | None = None,
    preset: str = "lidar",
    queries: Any = None,
    min_neighbors: int | None = None,
    definition: str | None = None,
    threads: int = 0,
) -> PointMetric:
    """Mean map entropy: the mean of ln sqrt(det(2 pi e Sigma)) over the points of the map [nats].

    points: (N, 3) [m], finite. radius_m: of the neighborhoods, strictly less; None: the preset's, lidar 1.0, depth 0.2.
    queries: (M, 3) points of interest; None: all of the map. min_neighbors: None: 6, the query included.
    definition: "paper", "map-metrics", "mapeval" or "ais-bonn". threads: 0: all cores.
    Raises InvalidArgument. Source: the paper, section III-B; docs/definitions.md#mme.
    """
    return _point_metric(_core.mme, "entropies", points, queries, preset, radius_m, min_neighbors, definition, threads)


def mpv(
    points: Any,
    *,
    radius_m: float | None = None,
    preset: str = "lidar",
    queries: Any = None,
    min_neighbors: int | None = None,
    definition: str | None = None,
    threads: int = 0,
) -> PointMetric:
    """Mean plane variance: the mean of the smallest eigenvalue of the covariance of every neighborhood [m2].

    Arguments and errors: as mme(). Source: the paper, section III-B; docs/definitions.md#mpv.
    """
    return _point_metric(
        _core.mpv, "plane_variances", points, queries, preset, radius_m, min_neighbors, definition, threads
    )


def mom(
    points: Any,
    subset: Any,
    *,
    radius_m: float | None = None,
    preset: str = "lidar",
    min_neighbors: int | None = None,
    definition: str | None = None,
    threads: int = 0,
) -> OrthogonalMetric:
    """Mutually orthogonal metric: plane variance of an orthogonal subset, averaged over its directions [m2].

    points: (N, 3) [m] of the map. subset: up to three arrays (K, 3) [m] in the frame of the map, or what
    extract_orthogonal_subset() found. min_neighbors: None: 4. Other arguments and errors: as mme().
    Source: the paper, section IV-A; docs/definitions.md#mom.
    """
    return _orthogonal_metric(
        _core.mom, "plane_variances", points, subset, preset, radius_m, min_neighbors, definition, threads
    )


def omme(
    points: Any,
    subset: Any,
    *,
    radius_m: float | None = None,
    preset: str = "lidar",
    min_neighbors: int | None = None,
    definition: str | None = None,
    threads: int = 0,
) -> OrthogonalMetric:
    """Orthogonal mean map entropy: entropy of an orthogonal subset, averaged over its directions [nats].

    Arguments and errors: as mom(). Source: the paper, section IV-A.
    """
    return _orthogonal_metric(
        _core.omme, "entropies", points, subset, preset, radius_m, min_neighbors, definition, threads
    )


def _point_metric(
    metric: Callable[[_core.PointStatistics, _core.EvaluationSettings], _core.MetricResult],
    values: str,
    points: Any,
    queries: Any,
    preset: str,
    radius_m: float | None,
    min_neighbors: int | None,
    definition: str | None,
    threads: int,
) -> PointMetric:
    settings = evaluation_settings(preset, None, min_neighbors, radius_m=radius_m, definition=definition)
    asked = None if queries is None else as_points(queries, "queries")
    statistics = _core.point_statistics(as_points(points, "points"), asked, settings, as_threads(threads))
    result = metric(statistics, settings)
    return PointMetric(
        value=result.value,
        reason=result.reason,
        per_point=getattr(statistics, values),
        num_neighbors=statistics.num_neighbors,
        num_queries=result.num_queries,
        num_used=result.num_used,
        num_degenerate=result.num_degenerate,
        num_too_few=result.num_too_few,
    )


def _orthogonal_metric(
    metric: Callable[[_core.OrthogonalStatistics, _core.EvaluationSettings], _core.OrthogonalMetricResult],
    values: str,
    points: Any,
    subset: Any,
    preset: str,
    radius_m: float | None,
    min_neighbors: int | None,
    definition: str | None,
    threads: int,
) -> OrthogonalMetric:
    settings = evaluation_settings(preset, None, min_neighbors, radius_m=radius_m, definition=definition)
    directions = as_subset(subset)
    if directions is None:
        raise _core.InvalidArgument("subset: expected up to three arrays of points, found None")
    statistics = _core.orthogonal_statistics(as_points(points, "points"), directions, settings, as_threads(threads))
    result = metric(statistics, settings)
    return OrthogonalMetric(
        value=result.value,
        reason=result.reason,
        mean_of_means=result.mean_of_means,
        sum_of_medians=result.sum_of_medians,
        directions=[_direction_of(each) for each in result.directions],
        per_point=[getattr(statistics, values)(i) for i in range(len(statistics))],
        follows_trajectory_error=result.follows_trajectory_error,
    )


def _direction_of(native: _core.MetricOfDirection) -> MetricOfDirection:
    return MetricOfDirection(
        **{field.name: getattr(native, field.name) for field in dataclasses.fields(MetricOfDirection)}
    )
