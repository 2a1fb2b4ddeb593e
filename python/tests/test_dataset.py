# SPDX-License-Identifier: Apache-2.0
"""Files of scans and poses come in as the command reads them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import pose

import trysquare as ts


def write_bins(folder: Path, scans: list[Any]) -> None:
    folder.mkdir(parents=True)
    for i, scan in enumerate(scans):
        np.hstack([scan, np.zeros((len(scan), 1))]).astype(np.float32).tofile(folder / f"{i:06}.bin")


@pytest.fixture
def files(tmp_path: Path, room: Any) -> Path:
    scans, poses = room
    write_bins(tmp_path / "velodyne", scans)
    ts.write_trajectory(tmp_path / "poses.txt", poses)
    return tmp_path


def test_load_gives_scans_and_poses(files: Path, room: Any) -> None:
    scans, poses = ts.load(files / "velodyne", files / "poses.txt", first=1, last=5, every=2)
    assert len(scans) == 3 and scans[0].dtype == np.float64
    for loaded, written in zip(scans, room[0][1::2], strict=True):
        assert np.array_equal(loaded, written.astype(np.float32))
    assert np.array_equal(poses, room[1][1::2])


def test_a_dataset_reads_scans_when_they_are_asked_for(files: Path, room: Any) -> None:
    dataset = ts.open_dataset(files / "velodyne", files / "poses.txt")
    assert len(dataset) == 6 and dataset.names[2].endswith("000002.bin")
    (files / "velodyne" / "000002.bin").write_bytes(b"12345")
    assert len(dataset[-1]) == len(room[0][5])
    with pytest.raises(ts.IoError, match=r"000002\.bin"):
        dataset[2]
    with pytest.raises(IndexError, match="scan 6 of 6"):
        dataset[6]


def test_a_calibration_beside_the_poses_is_used(files: Path, room: Any) -> None:
    camera_from_velodyne = pose(0.5, [0.1, 0.2, 0.3])
    numbers = " ".join(map(repr, camera_from_velodyne[:3].ravel().tolist()))
    (files / "calib.txt").write_text(f"P0: {numbers}\nTr: {numbers}\n")
    poses = room[1]
    dataset = ts.open_dataset(files / "velodyne", files / "poses.txt")
    expected = np.linalg.inv(camera_from_velodyne) @ poses @ camera_from_velodyne
    np.testing.assert_allclose(dataset.poses, expected, atol=1e-12)
    assert dataset.extrinsic is not None and np.array_equal(dataset.extrinsic, camera_from_velodyne)
    assert dataset.facts.extrinsic_source == "calib.txt:Tr"
    assert np.array_equal(ts.read_calibration(files / "calib.txt"), camera_from_velodyne)
    without = ts.open_dataset(files / "velodyne", files / "poses.txt", use_calib=False)
    assert np.array_equal(without.poses, poses) and without.extrinsic is None


def test_an_extrinsic_is_a_matrix_or_a_text(files: Path, room: Any) -> None:
    body_from_sensor = pose(0.3, [1, 2, 3])
    text = " ".join(map(repr, body_from_sensor.ravel().tolist()))
    for extrinsic in (body_from_sensor, text):
        dataset = ts.open_dataset(files / "velodyne", files / "poses.txt", extrinsic=extrinsic)
        np.testing.assert_allclose(dataset.poses, room[1] @ body_from_sensor, atol=1e-12)
    assert np.array_equal(ts.read_extrinsic(text), body_from_sensor)


def test_left_handed_files_become_right_handed(files: Path, room: Any) -> None:
    mirror = np.diag([1.0, -1, 1, 1])
    dataset = ts.open_dataset(files / "velodyne", files / "poses.txt", left_handed=True)
    np.testing.assert_allclose(dataset.poses, mirror @ room[1] @ mirror, atol=1e-15)
    assert np.array_equal(dataset[0], room[0][0].astype(np.float32) * [1, -1, 1])


def test_what_cannot_be_read_is_named(files: Path) -> None:
    (files / "three.txt").write_text("\n".join(["1 0 0 0 0 1 0 0 0 0 1 0"] * 3))
    with pytest.raises(ts.IoError, match=r"three\.txt.*3 poses.*6 scans"):
        ts.open_dataset(files / "velodyne", files / "three.txt")
    with pytest.raises(ts.IoError, match="nothing"):
        ts.open_dataset(files / "nothing", files / "poses.txt")
    with pytest.raises(ValueError, match="first = 4, last = 2"):
        ts.open_dataset(files / "velodyne", files / "poses.txt", first=4, last=2)
    with pytest.raises(ValueError, match="first"):
        ts.open_dataset(files / "velodyne", files / "poses.txt", first=-1)


def test_odd_files_warn(files: Path, room: Any) -> None:
    rounded = "\n".join(" ".join(f"{number:.2f}" for number in np.eye(4)[:3].ravel()) for _ in range(6))
    moved = rounded.splitlines()
    moved[1] = "1.00 0.00 0.00 0.25 0.00 1.00 0.00 0.13 0.00 0.00 1.00 0.01"
    (files / "rounded.txt").write_text("\n".join(moved))
    with pytest.warns(ts.TrysquareWarning, match="rounded_poses"):
        dataset = ts.open_dataset(files / "velodyne", files / "rounded.txt")
    result = ts.evaluate(dataset, metrics="mpv")
    assert "rounded_poses" in [warning.code for warning in result.warnings]


def test_trajectories_come_back_as_they_were_written(tmp_path: Path, room: Any) -> None:
    poses = room[1]
    stamps = np.arange(6) * 100_000_001 + 1_700_000_000_000_000_000
    for name in ("kitti", "tum", "euroc", "matrix"):
        ts.write_trajectory(tmp_path / name, poses, format=name, stamps_ns=stamps)
        back = ts.read_trajectory(tmp_path / name)
        assert back.format == name
        np.testing.assert_allclose(back.poses, poses, atol=1e-12)
        if name in ("tum", "euroc"):
            assert back.stamps_ns is not None and np.array_equal(back.stamps_ns, stamps)
    with pytest.raises(ValueError, match="format"):
        ts.write_trajectory(tmp_path / "x", poses, format="sonar")


def test_points_and_scans_of_a_file(tmp_path: Path) -> None:
    points = np.array([[1.0, 2, 3], [0, 0, 0], [np.nan, 1, 1], [4, 5, 6]])
    np.save(tmp_path / "scan.npy", points)
    assert np.array_equal(ts.read_points(tmp_path / "scan.npy"), points, equal_nan=True)
    assert np.array_equal(ts.read_scan(tmp_path / "scan.npy"), points[[0, 3]])


def test_odd_trajectories_warn(tmp_path: Path) -> None:
    lines = [f"{i} 0.25 {0.5 * i:.2f} 0.13 0 0 0 1.01" for i in range(4)]
    (tmp_path / "odd.tum").write_text("\n".join(lines) + "\n")
    with pytest.warns(ts.TrysquareWarning, match="non_unit_quaternion"):
        ts.read_trajectory(tmp_path / "odd.tum")


def test_a_format_that_is_not_known_is_refused(files: Path) -> None:
    with pytest.raises(ValueError, match="poses_format = 'tmu'"):
        ts.open_dataset(files / "velodyne", files / "poses.txt", poses_format="tmu")


def test_any_step_selects_scans_once(files: Path) -> None:
    assert len(ts.open_dataset(files / "velodyne", files / "poses.txt", first=3, every=2**64 - 1)) == 1
    with pytest.raises(TypeError, match="whole number"):
        ts.open_dataset(files / "velodyne", files / "poses.txt")[1.0]  # type: ignore[index]
