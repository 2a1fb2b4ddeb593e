# SPDX-License-Identifier: Apache-2.0
"""Single metrics against numpy, point by point."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from conftest import corner

import trysquare as ts


@pytest.fixture(scope="module")
def points() -> Any:
    return corner(3000, np.random.default_rng(3))


def covariances(points: Any, queries: Any, radius: float) -> list[Any]:
    """Of the neighborhood of every query, with divisor n - 1; None with fewer than six points."""
    found = []
    for query in queries:
        near = points[((points - query) ** 2).sum(axis=1) < radius**2]
        found.append(np.cov(near.T) if len(near) >= 6 else None)
    return found


def test_mpv_is_the_mean_of_the_smallest_eigenvalues(points: Any) -> None:
    expected = np.array([np.nan if c is None else np.linalg.eigvalsh(c)[0] for c in covariances(points, points, 0.5)])
    result = ts.mpv(points, radius_m=0.5)
    np.testing.assert_allclose(result.per_point, expected, rtol=1e-9)
    assert result.value == pytest.approx(np.nanmean(expected), rel=1e-12)
    assert result.num_queries == len(points) and result.num_too_few == np.isnan(expected).sum()


def test_mme_is_the_mean_of_the_entropies(points: Any) -> None:
    expected = np.array(
        [
            np.nan if c is None else 0.5 * np.log(np.linalg.det(2 * np.pi * np.e * c))
            for c in covariances(points, points[::9], 0.5)
        ]
    )
    result = ts.mme(points, radius_m=0.5, queries=points[::9])
    np.testing.assert_allclose(result.per_point, expected, rtol=1e-9)
    assert result.value == pytest.approx(np.nanmean(expected), rel=1e-12)


def test_mom_averages_over_the_directions(points: Any) -> None:
    subset = [points[:1000:10], points[1000:2000:10], points[2000::10]]
    result = ts.mom(points, subset, radius_m=0.5, min_neighbors=6)
    means = []
    for queries, values in zip(subset, result.per_point, strict=True):
        expected = [np.nan if c is None else np.linalg.eigvalsh(c)[0] for c in covariances(points, queries, 0.5)]
        np.testing.assert_allclose(values, expected, rtol=1e-9)
        means.append(np.nanmean(expected))
    assert result.value == pytest.approx(np.mean(means), rel=1e-12) == result.mean_of_means
    by_authors = ts.mom(points, subset, radius_m=0.5, min_neighbors=6, definition="map-metrics")
    assert by_authors.value == pytest.approx(sum(np.nanmedian(v) for v in result.per_point), rel=1e-12)
    assert result.follows_trajectory_error and not ts.mom(points, subset[:2], radius_m=0.5).follows_trajectory_error


def test_omme_is_the_entropy_of_the_subset(points: Any) -> None:
    subset = [points[:1000:10], points[1000:2000:10]]
    result = ts.omme(points, subset, radius_m=0.5)
    assert result.value == pytest.approx(np.mean([np.nanmean(values) for values in result.per_point]), rel=1e-12)


def test_a_map_without_neighbors_has_no_value() -> None:
    lonely = np.arange(30.0).reshape(10, 3) * 100
    for metric in (ts.mme, ts.mpv):
        result = metric(lonely)
        assert result.value is None and "too few" in result.reason and np.isnan(result.per_point).all()
    nothing = ts.mom(lonely, [lonely])
    assert nothing.value is None and nothing.reason and np.isnan(nothing.per_point[0]).all()


def test_presets_are_those_of_the_command(points: Any) -> None:
    assert ts.mpv(points).value == ts.mpv(points, radius_m=1.0).value
    assert ts.mpv(points, preset="depth").value == ts.mpv(points, radius_m=0.2).value


def test_an_orthogonal_subset_faces_three_directions(room: Any) -> None:
    scans, poses = room
    found = ts.extract_orthogonal_subset(scans, poses, radius_m=0.5)
    assert len(found.directions) == 3 and found.reason == ""
    world_from_map = poses[0][:3, :3]
    faced = {int(np.argmax(np.abs(world_from_map @ each.normal))) for each in found.directions}
    assert faced == {0, 1, 2}
    for direction in found.directions:
        in_world = direction.points @ world_from_map.T + poses[0][:3, 3]
        axis = int(np.argmax(np.abs(world_from_map @ direction.normal)))
        assert np.abs(in_world[:, axis]).max() < 0.06  # six standard deviations of the noise
    given = ts.evaluate(scans, poses, radius_m=0.5, subset=found, metrics="mom").mom
    extracted = ts.evaluate(scans, poses, radius_m=0.5, metrics="mom").mom
    assert given is not None and extracted is not None and given.value == pytest.approx(extracted.value, rel=1e-12)


def test_one_scan_needs_no_poses(points: Any) -> None:
    assert len(ts.extract_orthogonal_subset(points, radius_m=0.5, method="paper").directions) == 3
