# SPDX-License-Identifier: Apache-2.0
"""LAS bytes that the test writes by itself give scale * integer + offset; LAZ files of the same points the same."""

from __future__ import annotations

import struct
from fractions import Fraction
from pathlib import Path
from typing import Any

import laspy
import layout_writers as writers
import numpy as np
import pytest
from numpy.typing import NDArray

import trysquare as ts
from trysquare.las import las_scans, read_las

SCALE = (0.001, 0.001, 0.002)
UTM = (467000.0, 5430000.0, -17.25)
STORED = np.array([[1234567, -7654321, 5], [0, 0, 0], [-2147483648, 2147483647, -1], [17, 4, 900]], dtype=np.int32)
RETURNS = [(1, 1), (1, 3), (2, 3), (3, 3)]
CLASSES = [2, 5, 2, 6]


def write_las(path: Path, stored: NDArray[np.int32], offset: tuple[float, float, float] = UTM, count: int = -1) -> None:
    """LAS 1.2, point format 0, byte by byte as the specification lays it out."""
    header = struct.pack("<4sHH16sBB32s32sHHHIIBHI5I", b"LASF", 0, 0, b"", 1, 2, b"test", b"test", 1, 2024, 227, 227, 0,
                         0, 20, len(stored) if count < 0 else count, 0, 0, 0, 0, 0)  # fmt: skip
    header += struct.pack("<6d", *SCALE, *offset)
    low, high = stored.min(axis=0) * SCALE + offset, stored.max(axis=0) * SCALE + offset
    header += struct.pack("<6d", high[0], low[0], high[1], low[1], high[2], low[2])
    assert len(header) == 227
    body = b""
    for i, (x, y, z) in enumerate(stored.tolist()):
        number, total = RETURNS[i % 4]
        body += struct.pack("<3iHBBbBH", x, y, z, 100, number | total << 3, CLASSES[i % 4], 0, 0, 0)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(header + body)


def write_laz(path: Path, stored: NDArray[np.int32], point_format: int = 0, version: str = "1.2") -> None:
    header = laspy.LasHeader(point_format=point_format, version=version)
    header.scales, header.offsets = np.array(SCALE), np.array(UTM)
    las = laspy.LasData(header)
    las.X, las.Y, las.Z = stored.T
    las.write(str(path))


def exact(stored: NDArray[np.int32], minus: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> NDArray[np.float64]:
    """scale * integer + offset - minus in rational numbers, rounded once."""
    return np.array(
        [
            [float(Fraction(SCALE[a]) * int(row[a]) + Fraction(UTM[a]) - Fraction(minus[a])) for a in range(3)]
            for row in stored
        ]
    )


def test_coordinates_are_exact_to_a_nanometre_in_utm(tmp_path: Path) -> None:
    write_las(tmp_path / "a.las", STORED)
    np.testing.assert_allclose(read_las(tmp_path / "a.las"), exact(STORED), rtol=0, atol=1e-9)
    np.testing.assert_array_equal(ts.read_points(tmp_path / "a.las"), read_las(tmp_path / "a.las"))


def test_an_origin_is_taken_off_before_anything_is_rounded(tmp_path: Path) -> None:
    write_las(tmp_path / "a.las", STORED)
    near = read_las(tmp_path / "a.las", origin=UTM)
    np.testing.assert_allclose(near, exact(STORED, UTM), rtol=3e-16, atol=0)
    assert near[3].tolist() == [17 * 0.001, 4 * 0.001, 900 * 0.002]
    with pytest.raises(ts.InvalidArgument, match="origin has the shape"):
        read_las(tmp_path / "a.las", origin=[1, 2])


@pytest.mark.parametrize(("point_format", "version"), [(0, "1.2"), (3, "1.2"), (6, "1.4"), (7, "1.4")])
def test_laz_gives_the_same(point_format: int, version: str, tmp_path: Path) -> None:
    write_laz(tmp_path / "a.laz", STORED, point_format, version)
    write_las(tmp_path / "a.las", STORED)
    np.testing.assert_array_equal(read_las(tmp_path / "a.laz"), read_las(tmp_path / "a.las"))


def test_classes_and_returns_are_chosen(tmp_path: Path) -> None:
    write_las(tmp_path / "a.las", STORED)
    everything = read_las(tmp_path / "a.las")
    for options, rows in (
        ({"classifications": [2]}, [0, 2]),
        ({"classifications": {6, 5}}, [1, 3]),
        ({"classifications": []}, []),
        ({"returns": "first"}, [0, 1]),
        ({"returns": "last"}, [0, 3]),
        ({"returns": "last", "classifications": [2]}, [0]),
    ):
        np.testing.assert_array_equal(read_las(tmp_path / "a.las", **options), everything[rows])  # type: ignore[arg-type]
    with pytest.raises(ts.InvalidArgument, match='returns = "second" is unknown, expected all, first or last'):
        read_las(tmp_path / "a.las", returns="second")


def test_a_file_larger_than_a_chunk_is_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trysquare.las._CHUNK", 3)
    stored = np.arange(30, dtype=np.int32).reshape(10, 3)
    write_las(tmp_path / "a.las", stored)
    np.testing.assert_allclose(read_las(tmp_path / "a.las"), exact(stored), rtol=0, atol=1e-9)


def test_malformed_files_are_named(tmp_path: Path) -> None:
    path = tmp_path / "a.las"
    with pytest.raises(ts.IoError, match=r"a\.las: no such file"):
        read_las(path)
    path.write_bytes(b"no LAS at all" * 50)
    with pytest.raises(ts.IoError, match=r"a\.las: cannot be read as LAS: "):
        read_las(path)
    write_las(path, STORED, count=9)
    with pytest.raises(ts.IoError, match=r"a\.las: .*(found 4 points, expected 9|cannot be read)"):
        read_las(path)
    write_las(path, STORED)
    path.write_bytes(path.read_bytes()[:-5])
    with pytest.raises(ts.IoError, match=r"a\.las: "):
        read_las(path)


def test_a_truncated_laz_is_named(tmp_path: Path) -> None:
    write_laz(tmp_path / "a.laz", np.random.default_rng(1).integers(0, 10**6, (5000, 3), dtype=np.int32))
    whole = (tmp_path / "a.laz").read_bytes()
    (tmp_path / "a.laz").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(ts.IoError, match=r"a\.laz: "):
        read_las(tmp_path / "a.laz")


def write_las_scans(folder: Path, poses: NDArray[np.float64]) -> None:
    for i, points in enumerate(writers.scans_of(poses)):
        write_las(folder / f"scan{i * 5}.las", np.round(points / SCALE).astype(np.int32), (0.0, 0.0, 0.0))


def test_files_of_a_folder_a_pattern_and_a_name(tmp_path: Path) -> None:
    write_las_scans(tmp_path, writers.sensor_poses())
    expected = [tmp_path / f"scan{i}.las" for i in (0, 5, 10, 15)]
    assert las_scans(tmp_path) == expected
    assert las_scans(tmp_path / "scan*.las") == expected
    assert las_scans(tmp_path / "scan5.las") == expected[1:2]
    assert las_scans(tmp_path / "scan*.pcd") is None


@pytest.mark.parametrize("given", [False, True], ids=["found", "given"])
def test_a_folder_of_las_scans_with_poses_is_a_data_set(given: bool, tmp_path: Path) -> None:
    poses = writers.sensor_poses()
    write_las_scans(tmp_path / "scans", poses)
    (tmp_path / "poses.txt").write_text("\n".join(writers.rows(poses)) + "\n")
    if given:
        dataset = ts.open_dataset(tmp_path / "scans", tmp_path / "poses.txt", first=1)
    else:
        dataset = ts.open_dataset(tmp_path, first=1)
    np.testing.assert_array_equal(dataset.poses, poses[1:])
    world = dataset.load(2) @ poses[3, :3, :3].T + poses[3, :3, 3]
    np.testing.assert_allclose(world, writers.world_points(), rtol=0, atol=2e-3)  # half a scale, turned
    assert np.isfinite(ts.evaluate(dataset, metrics=["mpv"]).mpv.value)


def test_a_calib_beside_the_poses_and_left_hands_hold_for_las_as_for_others(tmp_path: Path) -> None:
    """The same scans as LAS and as PCD: what the command makes of the PCD files is what is expected."""
    poses = writers.sensor_poses()
    write_las_scans(tmp_path / "las", poses)
    for i in range(writers.NUM_SCANS):
        writers.write_pcd(tmp_path / "pcd" / f"{i}.pcd", read_las(tmp_path / "las" / f"scan{i * 5}.las"))
    (tmp_path / "poses.txt").write_text("\n".join(writers.rows(poses)) + "\n")
    (tmp_path / "calib.txt").write_text(f"Tr: {writers.rows(writers.CAMERA_FROM_VELODYNE[None])[0]}\n")
    options: list[dict[str, Any]] = [
        {},
        {"use_calib": False},
        {"left_handed": True},
        {"extrinsic": writers.CAMERA_FROM_VELODYNE, "use_calib": False, "left_handed": True},
        {"calib": tmp_path / "calib.txt", "every": 2},
    ]
    for each in options:
        ours, expected = (ts.open_dataset(tmp_path / kind, tmp_path / "poses.txt", **each) for kind in ("las", "pcd"))
        np.testing.assert_allclose(ours.poses, expected.poses, rtol=0, atol=1e-12)
        np.testing.assert_array_equal(ours.load(1), expected.load(1))
        if expected.extrinsic is None:
            assert ours.extrinsic is None
        else:
            np.testing.assert_allclose(ours.extrinsic, expected.extrinsic, rtol=0, atol=0)
        assert ours.facts.extrinsic_source == expected.facts.extrinsic_source
        assert ours.facts.left_handed == expected.facts.left_handed


def test_other_las_points_at_the_origin_are_invalid_returns_of_a_scan(tmp_path: Path) -> None:
    write_las(tmp_path / "a.las", STORED, (0.0, 0.0, 0.0))
    assert len(ts.read_points(tmp_path / "a.las")) == 4
    assert len(ts.read_scan(tmp_path / "a.las")) == 3
