# SPDX-License-Identifier: Apache-2.0
"""Results hold every key of the JSON, and defaults are those of the command."""

from __future__ import annotations

import json
import subprocess
import types
import typing
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trysquare as ts
from trysquare._result import Result

#: Keys that say what kind of JSON it is, not what was found.
OF_THE_FILE = {"schema", "version", "timing"}


def require_all_keys(json_part: Any, part: Any, where: str) -> None:
    """Every key of the JSON is a member, a reason, or of the file; part by part."""
    if isinstance(part, Result):
        for key, value in json_part.items():
            if key.endswith("_reason"):
                assert part.why[key.removesuffix("_reason")] == value, where
            elif key not in OF_THE_FILE:
                assert hasattr(part, key), f"{where}.{key}"
                require_all_keys(value, getattr(part, key), f"{where}.{key}")
    elif isinstance(part, (list, tuple)):
        assert len(json_part) == len(part), where
        for i, (value, member) in enumerate(zip(json_part, part, strict=True)):
            require_all_keys(value, member, f"{where}[{i}]")
    else:
        assert json_part == part, where


def test_an_evaluation_holds_all_of_its_json(room: Any) -> None:
    scans, poses = room
    moved = ts.perturb(poses, translation_m=0.03, seed=5)
    result = ts.evaluate(scans, moved, reference=poses, window=2)
    assert result.window_correlations and result.windows
    require_all_keys(json.loads(result.to_json()), result, "evaluation")


def test_an_undefined_evaluation_too() -> None:
    lonely = np.arange(30.0).reshape(10, 3) * 100
    result = ts.evaluate([lonely] * 2, np.stack([np.eye(4)] * 2))
    require_all_keys(json.loads(result.to_json()), result, "evaluation")


def test_a_comparison_holds_all_of_its_json(room: Any) -> None:
    scans, poses = room
    others = {"true": poses, "off": ts.perturb(poses, translation_m=0.03, seed=3)}
    result = ts.compare(scans, others)
    text = json.loads(result.to_json())
    del text["inputs"]
    require_all_keys(text, result, "comparison")


def test_a_diagnosis_holds_all_of_its_json(room: Any) -> None:
    scans, poses = room
    moved = poses.copy()
    moved[2, :3, 3] += [0.08, -0.06, 0.05]
    result = ts.diagnose(scans, moved)
    text = json.loads(result.to_json())
    del text["inputs"], text["settings"]
    require_all_keys(text, result, "diagnosis")


@pytest.mark.parametrize("metric", ["ape", "rpe"])
def test_trajectory_errors_hold_all_of_their_json(room: Any, metric: str) -> None:
    poses = room[1]
    moved = ts.perturb(poses, translation_m=0.1, seed=1)
    options: dict[str, Any] = {"kitti": True, "every_pair": True} if metric == "rpe" else {}
    result = getattr(ts, metric)(poses, moved, **options)
    text = json.loads(result.to_json())
    require_all_keys(text, result, metric)


def test_an_unknown_shape_is_an_error_and_not_a_default() -> None:
    from trysquare._evaluation import Verdict

    with pytest.raises(KeyError, match=r"Verdict\.reasons"):
        Verdict.from_json({"meaningful": True})


def test_members_of_results_have_types_that_can_be_resolved() -> None:
    import trysquare._comparison
    import trysquare._diagnosis
    import trysquare._evaluation
    import trysquare._trajectory

    modules: list[types.ModuleType] = [
        trysquare._comparison,
        trysquare._diagnosis,
        trysquare._evaluation,
        trysquare._trajectory,
    ]
    for module in modules:
        for member in vars(module).values():
            if isinstance(member, type) and issubclass(member, Result):
                typing.get_type_hints(member)


@pytest.mark.parametrize("preset", ["lidar", "depth"])
def test_defaults_are_those_of_the_command(command: Path, tmp_path: Path, room: Any, preset: str) -> None:
    scans, poses = room
    np.save(tmp_path / "0.npy", scans[0])
    ts.write_trajectory(tmp_path / "pose.txt", poses[:1])
    arguments = [command, "evaluate", tmp_path / "0.npy", tmp_path / "pose.txt", "--preset", preset, "--json", "-"]
    printed = json.loads(subprocess.run(arguments, capture_output=True, text=True, check=False).stdout)["settings"]
    defaults = ts.default_settings(preset)
    assert defaults.pop("max_range_m") == np.inf and printed["max_range_m"] is None
    subset = printed["orthogonal_subset"]
    assert defaults.pop("subset_method") == subset["method"]
    assert defaults.pop("subset_scans") is None and defaults.pop("join_colinear") is True
    assert {name: printed[name] for name in defaults} == defaults
    own = json.loads(ts.evaluate(scans[:1], poses[:1], preset=preset).to_json())["settings"]
    assert own == printed
