# SPDX-License-Identifier: Apache-2.0
"""Functions that take arrays: wrong ones are refused by name, and odd ones that are fine give the same numbers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trysquare as ts
from trysquare.compat import map_metrics

QUICK: dict[str, Any] = {"metrics": ["mpv"], "radius_m": 0.5}
CONFIG = map_metrics.CustomConfig(knn_rad=0.5)

#: What takes points, (N, 3): by the name of the argument in the message, and a call whose result is compared.
POINTS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "mme": ("points", lambda p: ts.mme(p, radius_m=0.5).value),
    "mpv": ("points", lambda p: ts.mpv(p, radius_m=0.5).per_point),
    "mpv queries": ("queries", lambda p: ts.mpv(corner(), radius_m=0.5, queries=p).per_point),
    "mom": ("points", lambda p: ts.mom(p, [corner()[::7]], radius_m=0.5).value),
    "mom subset": (r"subset\[0\]", lambda p: ts.mom(corner(), [p], radius_m=0.5).value),
    "omme": ("points", lambda p: ts.omme(p, [corner()[::7]], radius_m=0.5).value),
    "evaluate_map": ("points", lambda p: ts.evaluate_map(p, **QUICK).to_json()),
    "evaluate": (r"scans\[1\]", lambda p: ts.evaluate([corner(), p], eyes(2), **QUICK).to_json()),
    "compare": (
        r"scans\[2\]",
        lambda p: ts.compare([*[corner()] * 2, p], {"a": eyes(3), "b": eyes(3)}, **QUICK).to_json(),
    ),
    "diagnose": (r"scans\[0\]", lambda p: ts.diagnose([p, *[corner()] * 2], eyes(3)).to_json()),
    "refine": (r"scans\[0\]", lambda p: ts.refine([p, *[corner()] * 2], eyes(3)).estimate),
    "extract_orthogonal_subset": (r"scans\[0\]", lambda p: ts.extract_orthogonal_subset([p], eyes(1)).to_json()),
    "map_metrics.mme": (r"pcs\[0\]", lambda p: map_metrics.mme([p], eyes(1), CONFIG)),
    "map_metrics.mpv": (r"pcs\[0\]", lambda p: map_metrics.mpv([p], eyes(1), CONFIG)),
    "map_metrics.mom": (r"orth_list\[0\]", lambda p: map_metrics.mom([corner()], eyes(1), [p], CONFIG)),
    "map_metrics.aggregate_map": (r"pcs\[1\]", lambda p: map_metrics.aggregate_map([corner(), p], eyes(2)).points),
    "map_metrics.extract": ("pc", lambda p: map_metrics.extract_orthogonal_subsets(p, CONFIG)[0][0]),
}

#: What takes poses, (M, 4, 4).
POSES: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "evaluate": ("poses", lambda t: ts.evaluate([corner()] * 3, t, **QUICK).to_json()),
    "evaluate reference": ("reference", lambda t: ts.evaluate([corner()] * 3, eyes(3), reference=t, **QUICK).to_json()),
    "compare": (r"candidates\['b'\]", lambda t: ts.compare([corner()] * 3, {"a": eyes(3), "b": t}, **QUICK).to_json()),
    "diagnose": ("poses", lambda t: ts.diagnose([corner()] * 3, t).to_json()),
    "refine": ("poses", lambda t: ts.refine([corner()] * 3, t).estimate),
    "extract_orthogonal_subset": ("poses", lambda t: ts.extract_orthogonal_subset([corner()] * 3, t).to_json()),
    "ape": ("reference", lambda t: ts.ape(t, eyes(3)).errors),
    "ape estimate": ("estimate", lambda t: ts.ape(eyes(3), t).errors),
    "rpe": ("reference", lambda t: ts.rpe(t, eyes(3)).errors),
    "rpe estimate": ("estimate", lambda t: ts.rpe(eyes(3), t).errors),
    "perturb": ("poses", lambda t: ts.perturb(t, translation_m=0.1)),
    "write_trajectory": ("poses", lambda t: ts.write_trajectory("poses.txt", t)),
}

WRONG_POINTS = {
    "one dimension": np.zeros(3),
    "two columns": np.zeros((5, 2)),
    "three dimensions": np.zeros((2, 2, 3)),
    "a number": 3.0,
    "text": [["a", "b", "c"]],
    "complex": np.zeros((5, 3), dtype=complex),
    "booleans": np.zeros((5, 3), dtype=bool),
    "objects": np.full((5, 3), None),
    "ragged": [[0, 0, 0], [0, 0]],
    "nothing": None,
    "records": np.zeros(4, dtype=[("x", "f8"), ("y", "f8"), ("z", "f8")]),
}
WRONG_POSES = {
    "one matrix": np.eye(4),
    "3 x 3": np.zeros((3, 3, 3)),
    "4 x 3": np.zeros((3, 4, 3)),
    "none": np.zeros((0, 4, 4)),
    "text": [["a"]],
    "complex": np.zeros((3, 4, 4), dtype=complex),
    "objects": np.full((3, 4, 4), None),
    "a number": 3,
}


def corner(num_points: int = 900) -> Any:
    """A floor and two walls, a scan from its own origin, of numbers that a float32 holds."""
    rng = np.random.default_rng(3)
    walls = rng.uniform(0.3, 3, (3, num_points // 3, 3))
    for axis in range(3):
        walls[axis, :, axis] = rng.normal(0, 0.01, num_points // 3)
    return (walls.reshape(-1, 3) - 1).astype(np.float32).astype(np.float64)


def eyes(count: int) -> Any:
    poses = np.array([np.eye(4)] * count)
    poses[:, 0, 3] = 0.0625 * np.arange(count)  # a float32 holds it
    return poses


def every_other(array: Any) -> Any:
    """The same values in every other place of a larger array."""
    larger = np.full((2 * len(array), *array.shape[1:]), np.nan)
    larger[::2] = array
    return larger[::2]


#: No queries are all points of the map, and not wrong.
WRONG_CALLS = [
    (name, wrong) for name in POINTS for wrong in WRONG_POINTS if (name, wrong) != ("mpv queries", "nothing")
]


@pytest.mark.parametrize(("function", "wrong"), WRONG_CALLS)
def test_wrong_points_are_named(function: str, wrong: str) -> None:
    name, call = POINTS[function]
    with pytest.raises(ValueError, match=rf"\b{name}|^{name}"):
        call(WRONG_POINTS[wrong])


@pytest.mark.parametrize("wrong", WRONG_POSES)
@pytest.mark.parametrize("function", POSES)
def test_wrong_poses_are_named(function: str, wrong: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    name, call = POSES[function]
    with pytest.raises(ValueError, match=rf"\b{name}|^{name}"):
        call(WRONG_POSES[wrong])


@pytest.mark.parametrize("function", ["mme", "mpv", "mpv queries", "mom", "omme", "evaluate_map"])
def test_no_points_are_named(function: str) -> None:
    name, call = POINTS[function]
    with pytest.raises(ValueError, match=rf"{name}.*no points"):
        call(np.zeros((0, 3)))


ODD: dict[str, Callable[[Any], Any]] = {
    "float32": lambda a: a.astype(np.float32),
    "Fortran order": np.asfortranarray,
    "every other row": every_other,
    "reversed twice": lambda a: a[::-1].copy()[::-1],
    "a list": lambda a: a.tolist(),
    "big endian": lambda a: a.astype(">f8"),
    "read only": lambda a: np.frombuffer(a.tobytes()).reshape(a.shape),
}


@pytest.mark.parametrize("odd", ODD)
@pytest.mark.parametrize("function", POINTS)
def test_odd_points_give_the_same(function: str, odd: str) -> None:
    call = POINTS[function][1]
    np.testing.assert_equal(call(ODD[odd](corner())), call(corner()))


def test_columns_beyond_the_third_do_not_count() -> None:
    with_intensity = np.column_stack([corner(), np.arange(900)])
    for function, (_, call) in POINTS.items():
        np.testing.assert_equal(call(with_intensity), call(corner()), err_msg=function)


@pytest.mark.parametrize("odd", ODD)
@pytest.mark.parametrize("function", POSES)
def test_odd_poses_give_the_same(function: str, odd: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    call = POSES[function][1]
    np.testing.assert_equal(call(ODD[odd](eyes(3))), call(eyes(3)))


def test_every_public_function_that_takes_arrays_is_tested_here() -> None:
    """A function that is new belongs into POINTS or POSES, or takes no arrays."""
    without_arrays = {"default_settings", "load", "open_dataset"} | {name for name in ts.__all__ if name[:5] == "read_"}
    functions = {name for name in ts.__all__ if callable(getattr(ts, name)) and name[0].islower()} - without_arrays
    assert functions == {name.split()[0] for name in (*POINTS, *POSES) if not name.startswith("map_metrics")}


def test_arguments_are_left_as_they_are() -> None:
    points, poses = corner(), eyes(3)
    ts.evaluate([points] * 3, poses, **QUICK)
    map_metrics.mom([points] * 3, poses, [points], CONFIG)
    np.testing.assert_array_equal(points, corner())
    np.testing.assert_array_equal(poses, eyes(3))
