# SPDX-License-Identifier: Apache-2.0
"""APE and RPE against their formulas in numpy, and against the command."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import pose

import trysquare as ts


@pytest.fixture(scope="module")
def pair() -> Any:
    reference = np.array([pose(0.05 * i, [0.5 * i, 0.02 * i * i, 0.1 * np.sin(i)]) for i in range(40)])
    return reference, ts.perturb(reference, translation_m=0.05, rotation_deg=0.3, model="walk", seed=11)


def test_ape_is_the_distance_of_positions(pair: Any) -> None:
    reference, estimate = pair
    expected = np.linalg.norm(reference[:, :3, 3] - estimate[:, :3, 3], axis=1)
    result = ts.ape(reference, estimate)
    np.testing.assert_allclose(result.errors, expected, atol=1e-14)
    assert result.statistics is not None
    assert result.statistics.rmse == pytest.approx(np.sqrt((expected**2).mean()), rel=1e-12)
    assert result.unit == "m" and result.num_pairs == 40


def test_alignment_is_umeyamas(pair: Any) -> None:
    reference, estimate = pair
    p, q = reference[:, :3, 3].T, estimate[:, :3, 3].T
    u, _, vt = np.linalg.svd((p - p.mean(1, keepdims=True)) @ (q - q.mean(1, keepdims=True)).T)
    rotation = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
    aligned = rotation @ (q - q.mean(1, keepdims=True)) + p.mean(1, keepdims=True)
    expected = np.linalg.norm(p - aligned, axis=0)
    np.testing.assert_allclose(ts.ape(reference, estimate, align="se3").errors, expected, rtol=1e-9, atol=1e-12)


def test_rpe_is_the_error_of_motions(pair: Any) -> None:
    reference, estimate = pair
    result = ts.rpe(reference, estimate, delta=4, all_pairs=True)
    assert result.pairs.tolist() == [[i, i + 4] for i in range(36)]
    for error, (i, j) in zip(result.errors, result.pairs, strict=True):
        true_motion = np.linalg.inv(reference[i]) @ reference[j]
        motion = np.linalg.inv(estimate[i]) @ estimate[j]
        assert error == pytest.approx(np.linalg.norm((np.linalg.inv(true_motion) @ motion)[:3, 3]), rel=1e-9)


def test_stamps_pair_the_poses(pair: Any) -> None:
    reference, estimate = pair
    stamps = np.arange(40) * 100_000_000
    late = ts.Trajectory(estimate[10:], stamps[10:] + 3_000_000)
    result = ts.ape(ts.Trajectory(reference, stamps), late)
    expected = np.linalg.norm(reference[10:, :3, 3] - estimate[10:, :3, 3], axis=1)
    np.testing.assert_allclose(result.errors, expected, atol=1e-14)
    with pytest.raises(ValueError, match=r"stamp|time|pair"):
        ts.ape(ts.Trajectory(reference, stamps), late, t_max_diff_s=0.001)
    shifted = ts.ape(ts.Trajectory(reference, stamps), late, t_max_diff_s=0.001, t_offset_s=-0.003)
    assert shifted.num_pairs == 30


def test_the_command_gives_the_same(pair: Any, tmp_path: Path, command: Path) -> None:
    for name, poses in zip(("reference", "estimate"), pair, strict=True):
        ts.write_trajectory(tmp_path / f"{name}.txt", poses)
    arguments = [command, "rpe", tmp_path / "reference.txt", tmp_path / "estimate.txt", "--delta", "3"]
    arguments += ["--delta-unit", "m", "--all-pairs", "--kitti", "--every-pair", "--json", "-"]
    printed = json.loads(subprocess.run(arguments, capture_output=True, text=True, check=True).stdout)
    files = [ts.read_trajectory(tmp_path / f"{name}.txt") for name in ("reference", "estimate")]
    own = json.loads(ts.rpe(*files, delta=3, delta_unit="m", all_pairs=True, kitti=True, every_pair=True).to_json())
    del printed["inputs"], own["inputs"]
    assert own == printed


def test_what_does_not_exist_has_a_reason(pair: Any) -> None:
    straight = np.array([pose(0, [i, 0, 0]) for i in range(5)])
    result = ts.ape(straight, straight, align="se3")
    assert result.statistics is None and result.reason and len(result.errors) == 0


@pytest.mark.parametrize(
    ("argument", "value"),
    [("align", "best"), ("relation", "beauty"), ("plane", "uv"), ("t_max_diff_s", -1), ("reference_stamps_ns", [1, 2])],
)
def test_ape_names_the_argument(pair: Any, argument: str, value: Any) -> None:
    words = {"reference_stamps_ns": "stamps"}
    with pytest.raises(ValueError, match=words.get(argument, argument)):
        ts.ape(*pair, **{argument: value})


@pytest.mark.parametrize(("argument", "value"), [("delta", 0), ("delta_unit", "miles"), ("delta_tol", -1)])
def test_rpe_names_the_argument(pair: Any, argument: str, value: Any) -> None:
    with pytest.raises(ValueError, match=argument.replace("delta_tol", "tolerance")):
        ts.rpe(*pair, **{argument: value})


def test_noise_is_what_was_asked_for() -> None:
    still = np.stack([np.eye(4)] * 4000)
    moved = ts.perturb(still, translation_m=0.1, rotation_deg=1, seed=2)
    assert moved[:, :3, 3].std() == pytest.approx(0.1, rel=0.03)
    angles = np.degrees(np.arccos((np.trace(moved[:, :3, :3], axis1=1, axis2=2) - 1) / 2))
    assert np.sqrt((angles**2).mean() / 3) == pytest.approx(1, rel=0.03)
    assert np.array_equal(moved, ts.perturb(still, translation_m=0.1, rotation_deg=1, seed=2))
    walk = ts.perturb(still, translation_m=0.1, model="walk", seed=2)
    assert np.array_equal(walk[0], np.eye(4))
    assert np.diff(walk[:, :3, 3], axis=0).std() == pytest.approx(0.1, rel=0.03)
    with pytest.raises(ValueError, match="model"):
        ts.perturb(still, model="pink")
