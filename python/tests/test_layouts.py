# SPDX-License-Identifier: Apache-2.0
"""Loading a data set root gives the known poses of its sensor, and its scans agree in the known world."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import layout_writers as writers
import numpy as np
import pytest
from numpy.typing import NDArray

import trysquare as ts

Array = NDArray[np.float64]
POSES = writers.sensor_poses()


def from_first(poses: Array) -> Array:
    """The same poses where the world is the first scan, as in KITTI."""
    return np.linalg.inv(poses[0]) @ poses


def write_kitti_above(root: Path) -> tuple[Path, Array]:
    sequence = root / "dataset" / "sequences" / "07"
    writers.write_kitti(sequence, root / "dataset" / "poses" / "07.txt", POSES)
    return sequence, from_first(POSES)


def write_kitti_beside(root: Path) -> tuple[Path, Array]:
    writers.write_kitti(root, root / "poses.txt", POSES)
    return root, from_first(POSES)


def write_semantic_kitti(root: Path) -> tuple[Path, Array]:
    writers.write_kitti(root, root / "poses.txt", POSES)
    (root / "labels").mkdir()
    (root / "labels" / "000000.label").write_bytes(b"\0" * 1200)
    return root, from_first(POSES)


def write_mulran(root: Path) -> tuple[Path, Array]:
    writers.write_mulran(root, POSES)
    in_utm = POSES.copy()
    in_utm[:, :3, 3] += writers.UTM
    return root, in_utm


def write_mulran_sensor_data(root: Path) -> tuple[Path, Array]:
    _, expected = write_mulran(root)
    (root / "sensor_data").mkdir()
    (root / "Ouster").rename(root / "sensor_data" / "Ouster")
    return root, expected


def write_newer_college(root: Path) -> tuple[Path, Array]:
    writers.write_newer_college(root, POSES)
    return root, POSES


def write_nuscenes(root: Path) -> tuple[Path, Array]:
    writers.write_nuscenes(root, POSES)
    return root, POSES


def write_balm(root: Path) -> tuple[Path, Array]:
    writers.write_balm(root, POSES)
    return root, POSES


def write_carla(root: Path) -> tuple[Path, Array]:
    return root, writers.write_carla(root)


def write_generic(root: Path) -> tuple[Path, Array]:
    for i, points in enumerate(writers.scans_of(POSES)):
        writers.write_pcd(root / "clouds" / f"scan{i}.pcd", points)
    (root / "trajectory.txt").write_text("\n".join(writers.rows(POSES)) + "\n")
    return root, POSES


def write_generic_matrices(root: Path) -> tuple[Path, Array]:
    for i, points in enumerate(writers.scans_of(POSES)):
        writers.write_ply(root / "pcs" / f"{i}.ply", points)
        (root / "poses").mkdir(exist_ok=True)
        np.savetxt(root / "poses" / f"{i}.txt", POSES[i], fmt="%.17g")
    return root, POSES


Case = tuple[str, Callable[[Path], tuple[Path, Array]], float]
CASES: list[Case] = [
    ("kitti", write_kitti_above, 1e-12),
    ("kitti", write_kitti_beside, 1e-12),
    ("semantickitti", write_semantic_kitti, 1e-12),
    ("mulran", write_mulran, 2e-7),  # of the eight digits of the matrix in the writer
    ("mulran", write_mulran_sensor_data, 2e-7),
    ("newer-college", write_newer_college, 1e-12),
    ("nuscenes", write_nuscenes, 1e-12),
    ("balm", write_balm, 0.0),
    ("carla", write_carla, 1e-12),
    ("generic", write_generic, 0.0),
    ("generic", write_generic_matrices, 0.0),
]
IDS = [case[1].__name__.removeprefix("write_") for case in CASES]


@pytest.mark.parametrize("how", ["auto", "forced"])
@pytest.mark.parametrize("case", CASES, ids=IDS)
def test_poses_are_those_of_the_sensor_and_scans_agree_in_the_world(case: Case, how: str, tmp_path: Path) -> None:
    name, write, tolerance = case
    root, expected = write(tmp_path)
    dataset = ts.open_dataset(root, layout="auto" if how == "auto" else name)
    assert dataset.facts.layout == name
    assert len(dataset) == writers.NUM_SCANS
    np.testing.assert_allclose(dataset.poses, expected, rtol=0, atol=tolerance + 1e-15 * np.abs(expected).max())
    known = expected if name == "carla" else POSES
    world_from_known = expected[0] @ np.linalg.inv(known[0])
    world = writers.world_points() @ world_from_known[:3, :3].T + world_from_known[:3, 3]
    for i in range(len(dataset)):
        in_world = dataset.load(i) @ dataset.poses[i, :3, :3].T + dataset.poses[i, :3, 3]
        np.testing.assert_allclose(in_world, world, rtol=0, atol=2e-6)  # float32 of 11 m


@pytest.mark.parametrize("case", CASES, ids=IDS)
def test_load_gives_the_same_as_open_dataset(case: Case, tmp_path: Path) -> None:
    root, expected = case[1](tmp_path)
    scans, poses = ts.load(root, first=1, last=3, every=2)
    assert len(scans) == 2
    np.testing.assert_allclose(poses, expected[[1, 3]], rtol=0, atol=2e-7)
    dataset = ts.open_dataset(root)
    np.testing.assert_array_equal(scans[1], dataset.load(3))


def test_stamps_are_those_of_the_scans(tmp_path: Path) -> None:
    college = writers.write_newer_college(tmp_path / "college", POSES)
    np.testing.assert_array_equal(ts.open_dataset(tmp_path / "college").stamps_ns, college)
    np.testing.assert_array_equal(ts.open_dataset(tmp_path / "college", every=2).stamps_ns, college[::2])
    writers.write_nuscenes(tmp_path / "nuscenes", POSES)
    first = 1532402927647951000
    np.testing.assert_array_equal(
        ts.open_dataset(tmp_path / "nuscenes").stamps_ns, first + 50_000_000 * np.arange(writers.NUM_SCANS)
    )


def test_the_extrinsic_and_its_source_are_reported(tmp_path: Path) -> None:
    writers.write_mulran(tmp_path / "mulran", POSES)
    mulran = ts.open_dataset(tmp_path / "mulran")
    np.testing.assert_allclose(mulran.extrinsic, writers.BASE_FROM_OUSTER, atol=5e-9)
    assert mulran.facts.extrinsic_source == "MulRan:calib_base2ouster"
    writers.write_kitti(tmp_path / "kitti", tmp_path / "kitti" / "poses.txt", POSES)
    assert ts.open_dataset(tmp_path / "kitti").facts.extrinsic_source == "calib.txt:Tr"
    writers.write_newer_college(tmp_path / "college", POSES)
    assert ts.open_dataset(tmp_path / "college").facts.extrinsic_source == "Newer College:base_from_os_lidar"


def test_without_the_calibration_the_poses_stay_the_cameras(tmp_path: Path) -> None:
    sequence, _ = write_kitti_above(tmp_path)
    cameras = POSES @ np.linalg.inv(writers.CAMERA_FROM_VELODYNE)
    dataset = ts.open_dataset(sequence, use_calib=False)
    np.testing.assert_allclose(dataset.poses, from_first(cameras), atol=1e-12)
    assert dataset.extrinsic is None
