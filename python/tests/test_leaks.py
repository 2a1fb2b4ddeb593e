# SPDX-License-Identifier: Apache-2.0
"""A thousand calls take no more memory than a hundred."""

from __future__ import annotations

import gc
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trysquare as ts
from trysquare.compat import map_metrics

STATM = Path("/proc/self/statm")
pytestmark = pytest.mark.skipif(not STATM.exists(), reason="resident memory is read from /proc")

NUM_POINTS = 1500  # in each of two scans: one copy of a map is 72 kB, and a thousand leaked copies are 72 MB
BOUND_BYTES = 8e6
NUM_CALLS = 1000


def resident_bytes() -> float:
    gc.collect()
    return int(STATM.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def growth(call: Callable[[], object], num_calls: int = NUM_CALLS) -> float:
    """Bytes by which the process grows from the hundredth to the last call; the first ones fill pools and caches."""
    for _ in range(num_calls // 10):
        call()
    before = resident_bytes()
    for _ in range(num_calls):
        call()
    return resident_bytes() - before


@pytest.fixture(scope="module")
def tiny() -> tuple[list[Any], Any]:
    """Two scans of a corner from one place, and their poses."""
    rng = np.random.default_rng(5)
    scans = []
    for _ in range(2):
        walls = rng.uniform(0.3, 3, (3, NUM_POINTS // 3, 3))
        for axis in range(3):
            walls[axis, :, axis] = rng.normal(0, 0.01, NUM_POINTS // 3)
        scans.append(walls.reshape(-1, 3) - [1.0, 1.0, 1.0])
    return scans, np.array([np.eye(4)] * 2)


def test_what_is_kept_is_seen(tiny: Any) -> None:
    """The measure itself: a tenth of what is looked for, kept on purpose."""
    kept: list[Any] = []
    assert growth(lambda: kept.append(np.ones(72_000 // 8))) > BOUND_BYTES


@pytest.mark.slow
def test_evaluations_leave_nothing_behind(tiny: Any) -> None:
    scans, poses = tiny

    def call() -> None:
        result = ts.evaluate(scans, poses, radius_m=0.5, metrics=["mme", "mpv", "mom", "omme"])
        assert result.points.plane_variances.base is not None  # a view, whose owner must go with it
        assert result.mpv is not None and result.mpv.num_queries == 2 * NUM_POINTS

    assert growth(call) < BOUND_BYTES


def test_metrics_of_maps_leave_nothing_behind(tiny: Any) -> None:
    points = np.concatenate(tiny[0])
    assert growth(lambda: ts.mme(points, radius_m=0.5).per_point.sum()) < BOUND_BYTES


@pytest.mark.slow
def test_the_drop_in_leaves_nothing_behind(tiny: Any) -> None:
    config = map_metrics.CustomConfig(knn_rad=0.5)

    def call() -> None:
        map_metrics.mpv(tiny[0], tiny[1], config)
        map_metrics.extract_orthogonal_subsets(tiny[0][0], config)

    assert growth(call) < BOUND_BYTES


def test_trajectories_leave_nothing_behind() -> None:
    poses = np.array([np.eye(4)] * 2000)
    assert growth(lambda: ts.rpe(poses, poses).errors.sum()) < BOUND_BYTES


def test_errors_leave_nothing_behind(tiny: Any) -> None:
    scans, poses = tiny
    bent = poses.copy()
    bent[1, 3, 3] = 2

    def call() -> None:
        with pytest.raises(ValueError, match="last row"):
            ts.evaluate(scans, bent)

    assert growth(call) < BOUND_BYTES


def test_an_array_outlives_its_result(tiny: Any) -> None:
    """A view of something that C++ holds keeps it."""
    per_point = ts.mpv(np.concatenate(tiny[0]), radius_m=0.5).per_point
    expected = per_point.copy()
    gc.collect()
    [ts.mpv(np.concatenate(tiny[0]) * 2, radius_m=0.5) for _ in range(20)]
    np.testing.assert_array_equal(per_point, expected)
