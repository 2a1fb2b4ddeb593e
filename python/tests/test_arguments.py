# SPDX-License-Identifier: Apache-2.0
"""Arguments that mean nothing are refused by name."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trysquare as ts


def test_exceptions_are_pythons_own_too() -> None:
    assert issubclass(ts.InvalidArgument, ValueError) and issubclass(ts.InvalidArgument, ts.Error)
    assert issubclass(ts.IoError, OSError) and issubclass(ts.IoError, ts.Error)
    with pytest.raises(OSError, match=r"nowhere\.bin"):
        ts.read_points("nowhere.bin")


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("radius_m", -1.0),
        ("radius_m", "wide"),
        ("min_neighbors", 2),
        ("min_neighbors", 2.5),
        ("definition", "mine"),
        ("metrics", ["mom", "beauty"]),
        ("query_every", 0),
        ("window", 1),
        ("stride", -3),
        ("preset", "sonar"),
        ("subset_method", "guess"),
        ("subset_scans", 0),
        ("max_range_m", 0.0),
        ("subset", [np.zeros((3, 2))]),
        ("subset", [np.zeros((9, 3))] * 4),
        ("reference", np.eye(4)),
        ("extrinsic", np.eye(3)),
    ],
)
def test_evaluate_names_the_argument(room: Any, argument: str, value: Any) -> None:
    with pytest.raises(ValueError, match=argument.removeprefix("min_").removeprefix("max_").split("_m")[0]):
        ts.evaluate(*room, **{argument: value})


def test_counts_that_differ_are_named(room: Any) -> None:
    scans, poses = room
    with pytest.raises(ValueError, match=r"6.*5|5.*6"):
        ts.evaluate(scans, poses[:5])
    with pytest.raises(ValueError, match="poses: expected"):
        ts.evaluate(scans)


def test_a_matrix_that_is_no_pose_is_refused(room: Any) -> None:
    scans, poses = room
    scaled = poses.copy()
    scaled[1, :3, :3] *= 1.5
    with pytest.raises(ValueError, match=r"pose 1|scan 1|rotation"):
        ts.evaluate(scans, scaled)
    bent = poses.copy()
    bent[2, 3, 3] = 2
    with pytest.raises(ValueError, match=r"pose 2.*last row"):
        ts.evaluate(scans, bent)
    not_finite = poses.copy()
    not_finite[1, 0, 3] = np.nan
    with pytest.raises(ValueError, match="pose 1: the translation is not finite"):
        ts.evaluate(scans, not_finite)


def test_three_rows_are_a_pose_too(room: Any) -> None:
    scans, poses = room
    three_rows = ts.evaluate(scans, poses[:, :3], metrics="mpv")
    assert three_rows.to_json() == ts.evaluate(scans, poses, metrics="mpv").to_json()


def test_points_that_measure_nothing_are_dropped_and_counted(room: Any) -> None:
    scans, poses = room
    dirty = [np.vstack([scan, [[np.nan, 0, 0], [0, 0, 0], [1, np.inf, 0]]]) for scan in scans]
    result = ts.evaluate(dirty, poses, metrics="mpv", radius_m=0.5)
    clean = ts.evaluate(scans, poses, metrics="mpv", radius_m=0.5)
    assert result.mpv == clean.mpv
    assert result.inputs.num_not_finite_points == 12 and result.inputs.num_origin_points == 6


def test_every_name_is_there() -> None:
    for name in ts.__all__:
        assert getattr(ts, name) is not None
    assert set(ts.__all__) == set(ts._HOMES) and dir(ts) == sorted(ts.__all__)
    with pytest.raises(AttributeError, match="beauty"):
        ts.beauty  # noqa: B018


def test_importing_it_imports_no_extra() -> None:
    extras = "('pandas', 'matplotlib', 'rosbags', 'laspy', 'open3d')"
    code = "import sys, trysquare; trysquare.evaluate, trysquare.load\n"
    code += f"print([name for name in {extras} if name in sys.modules])"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_the_command_of_the_package_runs(command: Path) -> None:
    run = subprocess.run([command, "--version"], capture_output=True, text=True, check=True)
    assert ts.__version__ in run.stdout


def test_default_settings_can_be_given_back(room: Any) -> None:
    given = ts.evaluate(*room, **ts.default_settings())
    assert given.to_json() == ts.evaluate(*room).to_json()


@pytest.mark.parametrize(("argument", "value"), [("threads", -1), ("threads", 1.0), ("threads", None), ("progress", 1)])
def test_threads_and_progress_are_refused_by_name(room: Any, argument: str, value: Any) -> None:
    with pytest.raises(ValueError, match=argument):
        ts.evaluate(*room, **{argument: value})
    with pytest.raises(ValueError, match="metrics"):
        ts.evaluate(*room, metrics=3)


@pytest.mark.parametrize("scans", ["velodyne", {"a": np.zeros((9, 3))}])
def test_what_only_looks_like_a_sequence_is_refused(scans: Any) -> None:
    with pytest.raises(ValueError, match="scans: expected a list"):
        ts.evaluate(scans, np.stack([np.eye(4)] * 2))


def test_an_orthogonal_metric_can_be_pickled(room: Any) -> None:
    points = np.concatenate(room[0])
    result = ts.mom(points, [points[::50]])
    assert pickle.loads(pickle.dumps(result)).directions == result.directions
    assert result.directions[0].num_points == len(points[::50])
