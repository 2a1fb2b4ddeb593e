# SPDX-License-Identifier: Apache-2.0
"""What a root folder lacks is named, and so is every file that is malformed."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import layout_writers as writers
import numpy as np
import pytest

import trysquare as ts
from trysquare.layouts import LAYOUTS, find_layout

POSES = writers.sensor_poses()


def test_a_root_that_no_layout_fits_is_told_what_each_missed(tmp_path: Path) -> None:
    (tmp_path / "readme.md").write_text("nothing")
    with pytest.raises(ts.IoError) as error:
        ts.open_dataset(tmp_path)
    first, *missed = str(error.value).split("\n")
    assert first == f"{tmp_path}: no data set layout fits:"
    assert [line.split(":")[0].strip() for line in missed] == list(LAYOUTS)
    for text in ("nuscenes: no folder v1.0-*", "mulran: no file global_pose.csv", "balm: no file alidarPose.csv"):
        assert any(text in line for line in missed), text
    assert "carla: no file transforms.csv or transforms.json" in str(error.value)


def test_unknown_layouts_and_folders_are_named(tmp_path: Path) -> None:
    with pytest.raises(ts.InvalidArgument, match='layout = "kity" is unknown, expected auto, nuscenes, '):
        ts.open_dataset(tmp_path, layout="kity")
    with pytest.raises(ts.IoError, match="nowhere: no such folder"):
        ts.open_dataset(tmp_path / "nowhere")


def broken_kitti(root: Path, missing: str) -> None:
    writers.write_kitti(root, root / "poses.txt", POSES)
    path = root / missing
    shutil.rmtree(path) if path.is_dir() else path.unlink()


@pytest.mark.parametrize(
    ("missing", "text"),
    [
        ("velodyne", "kitti: no folder velodyne with scans in it"),
        ("calib.txt", "kitti: no file calib.txt"),
        ("poses.txt", "kitti: no poses: neither "),
    ],
)
def test_what_kitti_lacks_is_named_and_camera_poses_are_never_taken_for_the_scanners(
    missing: str, text: str, tmp_path: Path
) -> None:
    broken_kitti(tmp_path, missing)
    with pytest.raises(ts.IoError) as error:
        ts.open_dataset(tmp_path)
    assert text in str(error.value)
    with pytest.raises(ts.IoError, match=f"not laid out as {text}"):
        ts.open_dataset(tmp_path, layout="kitti")


def test_of_two_files_of_poses_kittis_own_is_taken_and_the_other_named(tmp_path: Path) -> None:
    sequence = tmp_path / "sequences" / "07"
    writers.write_kitti(sequence, tmp_path / "poses" / "07.txt", POSES)
    (sequence / "poses.txt").write_text("\n".join(writers.rows(np.stack([np.eye(4)] * len(POSES)))) + "\n")
    with pytest.warns(ts.TrysquareWarning, match=r"07/poses\.txt is there, too"):
        dataset = ts.open_dataset(sequence)
    np.testing.assert_allclose(dataset.poses, np.linalg.inv(POSES[0]) @ POSES, atol=1e-12)


def test_a_sequence_is_chosen_by_name_or_index(tmp_path: Path) -> None:
    for name in ("03", "07"):
        writers.write_kitti(tmp_path / "sequences" / name, tmp_path / "poses" / f"{name}.txt", POSES)
    with pytest.raises(ts.IoError, match=r"kitti: it holds 2 sequences and none was chosen \(03, 07\)"):
        ts.open_dataset(tmp_path)
    for choice in ("kitti:07", "kitti:1", "auto:07"):
        assert "/07/" in ts.open_dataset(tmp_path, layout=choice).names[0]
    with pytest.raises(ts.IoError, match=r"no sequence 11 among 2 \(03, 07\)"):
        ts.open_dataset(tmp_path, layout="kitti:11")


def test_semantic_kitti_needs_its_own_poses(tmp_path: Path) -> None:
    sequence = tmp_path / "sequences" / "07"
    writers.write_kitti(sequence, tmp_path / "poses" / "07.txt", POSES)
    assert find_layout(sequence).layout == "kitti"
    with pytest.raises(ts.IoError, match=r"semantickitti: no file poses\.txt"):
        find_layout(sequence, "semantickitti")


def test_calib_and_extrinsic_that_are_asked_for_go_before_those_of_a_layout(tmp_path: Path) -> None:
    writers.write_mulran(tmp_path / "mulran", POSES)
    bases = ts.open_dataset(tmp_path / "mulran", extrinsic=np.eye(4)).poses
    in_utm = POSES.copy()
    in_utm[:, :3, 3] += writers.UTM
    np.testing.assert_allclose(bases, in_utm @ np.linalg.inv(writers.BASE_FROM_OUSTER), atol=1e-9)
    writers.write_newer_college(tmp_path / "college", POSES)
    given = writers.rigid(writers.Rotation.from_euler("x", 3, degrees=True), [1.0, 2.0, 3.0])
    with_layouts = ts.open_dataset(tmp_path / "college").poses
    dataset = ts.open_dataset(tmp_path / "college", extrinsic=given)
    lidar = writers.rigid(writers.Rotation.from_euler("z", 135, degrees=True), [-0.084, -0.025, 0.050])
    np.testing.assert_allclose(dataset.poses, with_layouts @ np.linalg.inv(lidar) @ given, atol=1e-12)
    np.testing.assert_array_equal(dataset.extrinsic, given)


def test_poses_of_the_user_are_the_sensors_in_any_layout(tmp_path: Path) -> None:
    writers.write_newer_college(tmp_path / "college", POSES)
    writers.write_nuscenes(tmp_path / "nuscenes", POSES)
    (tmp_path / "mine.txt").write_text("\n".join(writers.rows(POSES)) + "\n")
    for root, layout in (("college", "newer-college"), ("nuscenes", "nuscenes")):
        dataset = ts.open_dataset(tmp_path / root, tmp_path / "mine.txt", layout=layout)
        np.testing.assert_array_equal(dataset.poses, POSES)
        assert dataset.extrinsic is None


def test_poses_of_the_user_meet_newer_college_by_time(tmp_path: Path) -> None:
    stamps = writers.write_newer_college(tmp_path / "college", POSES)
    lines = []
    for stamp, pose in zip(stamps[1:], POSES[1:], strict=True):
        numbers = [*pose[:3, 3], *writers.Rotation.from_matrix(pose[:3, :3]).as_quat()]
        lines.append(f"{stamp // 10**9}.{stamp % 10**9:09} " + " ".join(repr(float(number)) for number in numbers))
    (tmp_path / "mine.tum").write_text("\n".join(lines) + "\n")
    with pytest.warns(ts.TrysquareWarning, match="1 of 4 scans have no pose"):
        dataset = ts.open_dataset(tmp_path / "college", tmp_path / "mine.tum", layout="newer-college")
    np.testing.assert_allclose(dataset.poses, POSES[1:], atol=1e-12)
    np.testing.assert_array_equal(dataset.stamps_ns, stamps[1:])


def test_a_scene_of_nuscenes_is_chosen_and_key_frames_alone(tmp_path: Path) -> None:
    writers.write_nuscenes(tmp_path, POSES, ("scene-0061", "scene-0103"))
    with pytest.raises(ts.IoError, match=r"it holds 2 scenes and none was chosen \(scene-0061, scene-0103\)"):
        ts.open_dataset(tmp_path)
    moved = POSES.copy()
    moved[:, 0, 3] += 100
    for choice in ("scene-0103", "1"):
        dataset = ts.open_dataset(tmp_path, layout=f"nuscenes:{choice}")
        np.testing.assert_allclose(dataset.poses, moved, atol=1e-12)
    keys = ts.open_dataset(tmp_path / "v1.0-mini", layout="nuscenes:scene-0103/samples")
    np.testing.assert_allclose(keys.poses, moved[::2], atol=1e-12)
    assert all("/samples/" in name for name in keys.names)


def change_table(root: Path, name: str, change: Any) -> None:
    path = root / "v1.0-mini" / f"{name}.json"
    rows = json.loads(path.read_text())
    change(rows)
    path.write_text(json.dumps(rows))


NUSCENES: dict[str, tuple[str, Any, str]] = {
    "ego pose gone": ("ego_pose", lambda rows: rows.pop(0), r"ego_pose\.json: no row e0-0, which samples/LIDAR_TOP/"),
    "odd quaternion": (
        "ego_pose",
        lambda rows: rows[1].update(rotation=[2, 0, 0, 0]),
        r"ego_pose\.json: row e0-1: the quaternion .* has the norm 2, expected 1",
    ),
    "no translation": (
        "calibrated_sensor",
        lambda rows: rows[0].pop("translation"),
        r"calibrated_sensor\.json: row cl",
    ),
    "no LiDAR": ("sensor", lambda rows: rows.pop(0), r"sensor\.json: no sensor with the channel LIDAR_TOP"),
    "time as text": (
        "sample_data",
        lambda rows: rows[0].update(timestamp="soon"),
        r"sample_data\.json: row d0-3: timestamp is 'soon', expected whole",
    ),
    "no samples": (
        "sample",
        lambda rows: rows.clear(),
        r"sample_data\.json: scene scene-0061 has no scan of LIDAR_TOP",
    ),
}


@pytest.mark.parametrize("name", NUSCENES)
def test_a_malformed_table_of_nuscenes_is_named(name: str, tmp_path: Path) -> None:
    table, change, text = NUSCENES[name]
    writers.write_nuscenes(tmp_path, POSES)
    change_table(tmp_path, table, change)
    with pytest.raises(ts.IoError, match=text):
        ts.open_dataset(tmp_path)


def test_broken_files_of_nuscenes_are_named(tmp_path: Path) -> None:
    writers.write_nuscenes(tmp_path, POSES)
    (tmp_path / "v1.0-mini" / "scene.json").write_text("[{")
    with pytest.raises(ts.IoError, match=r"scene\.json: it is no JSON"):
        ts.open_dataset(tmp_path)
    writers.write_nuscenes(tmp_path, POSES)
    lost = next((tmp_path / "sweeps" / "LIDAR_TOP").iterdir())
    lost.unlink()
    with pytest.raises(ts.IoError, match=rf"{lost.name}: no such file, but .*sample_data\.json names it"):
        ts.open_dataset(tmp_path)
    (tmp_path / "v1.0-mini" / "sensor.json").unlink()
    with pytest.raises(ts.IoError, match=r"nuscenes: no file v1\.0-mini/sensor\.json"):
        ts.open_dataset(tmp_path)


def test_a_scan_of_balm_that_is_missing_is_named(tmp_path: Path) -> None:
    writers.write_balm(tmp_path, POSES)
    (tmp_path / "full2.pcd").unlink()
    with pytest.raises(ts.IoError, match=r"balm: no file full2\.pcd, but full3\.pcd"):
        ts.open_dataset(tmp_path)
    writers.write_balm(tmp_path, POSES)
    writers.write_pcd(tmp_path / "full4.pcd", writers.world_points())
    with pytest.raises(ts.IoError, match=r"alidarPose\.csv: 4 poses for the 5 scans of .*: expected one per scan"):
        ts.open_dataset(tmp_path)


def test_balm_takes_full10_after_full9_and_leaves_other_clouds(tmp_path: Path) -> None:
    many = np.stack([POSES[i % 4] for i in range(11)])
    writers.write_balm(tmp_path, many)
    writers.write_pcd(tmp_path / "map.pcd", writers.world_points())
    names = [Path(name).name for name in ts.open_dataset(tmp_path).names]
    assert names == [f"full{i}.pcd" for i in range(11)]


@pytest.mark.parametrize(
    ("layout", "poses", "line"),
    [
        ("mulran", "global_pose.csv", "1561000444390857630,1,2,3\n"),
        ("newer-college", "ground_truth/registered_poses.csv", "1583836591,0,1,2,3\n"),
        ("balm", "alidarPose.csv", "1,0,0\n"),
        ("carla", "transforms.csv", "frame,x,y,z\n1,2,3,4\n"),
        ("kitti", "poses.txt", "1 2 3\n"),
    ],
)
def test_malformed_poses_name_the_file_and_the_line(layout: str, poses: str, line: str, tmp_path: Path) -> None:
    if layout == "carla":
        writers.write_carla(tmp_path)
    elif layout == "kitti":
        writers.write_kitti(tmp_path, tmp_path / "poses.txt", POSES)
    else:
        {"mulran": writers.write_mulran, "newer-college": writers.write_newer_college, "balm": writers.write_balm}[
            layout
        ](tmp_path, POSES)
    (tmp_path / poses).write_text(line)
    with pytest.raises(ts.IoError, match=rf"{Path(poses).name}: line 1: "):
        ts.open_dataset(tmp_path)


def test_a_malformed_scan_is_named_when_it_is_loaded(tmp_path: Path) -> None:
    writers.write_newer_college(tmp_path, POSES)
    dataset = ts.open_dataset(tmp_path)
    Path(dataset.names[2]).write_bytes(b"no cloud")
    assert len(dataset.load(1)) == 300
    with pytest.raises(ts.IoError, match=Path(dataset.names[2]).name):
        dataset.load(2)


def test_generic_names_several_poses(tmp_path: Path) -> None:
    for i, points in enumerate(writers.scans_of(POSES)):
        writers.write_pcd(tmp_path / f"{i}.pcd", points)
    for name in ("poses.txt", "gt.txt"):
        (tmp_path / name).write_text("\n".join(writers.rows(POSES)) + "\n")
    with pytest.raises(ts.IoError, match=r"generic: several poses, poses\.txt, gt\.txt: give one of them as `poses`"):
        ts.open_dataset(tmp_path)


def test_carla_is_left_handed_unless_the_user_says_it_is_not(tmp_path: Path) -> None:
    right_handed = writers.write_carla(tmp_path)
    mirror = np.diag([1.0, -1.0, 1.0, 1.0])
    with pytest.warns(ts.TrysquareWarning, match="left-handed"):
        as_stored = ts.open_dataset(tmp_path, left_handed=False)
    np.testing.assert_allclose(as_stored.poses, mirror @ right_handed @ mirror, atol=1e-12)
    assert ts.open_dataset(tmp_path).facts.left_handed
    assert not as_stored.facts.left_handed


def test_a_reference_meets_the_same_scans(tmp_path: Path) -> None:
    writers.write_newer_college(tmp_path, POSES)
    (tmp_path / "truth.txt").write_text("\n".join(writers.rows(POSES[::-1])) + "\n")
    dataset = ts.open_dataset(tmp_path, reference=tmp_path / "truth.txt", first=1)
    np.testing.assert_allclose(dataset.reference, POSES[::-1][1:], atol=1e-12)


def test_a_reference_for_other_scans_is_refused(tmp_path: Path) -> None:
    stamps = writers.write_newer_college(tmp_path, POSES)
    (tmp_path / "truth.tum").write_text("".join(f"{t // 10**9}.{t % 10**9:09} 0 0 0 0 0 0 1\n" for t in stamps[:3]))
    with pytest.raises(ts.IoError, match=r"truth\.tum: the reference has poses for other scans than "):
        ts.open_dataset(tmp_path, reference=tmp_path / "truth.tum")
