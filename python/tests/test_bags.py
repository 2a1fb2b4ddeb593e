# SPDX-License-Identifier: Apache-2.0
"""Bags of every kind give, bit for bit, the points of the same scans in .bin files, and the known poses."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import bag_writers as bags
import layout_writers as writers
import numpy as np
import pytest
from bag_writers import START_NS, STEP_NS, Types
from numpy.typing import NDArray

import trysquare as ts
from trysquare.bags import read_bag

POSES = writers.sensor_poses()
STAMPS = [START_NS + STEP_NS * i for i in range(writers.NUM_SCANS)]


def scans() -> list[NDArray[np.float32]]:
    """Known scans as float32; the first has an invalid return of each kind."""
    found = [points.astype(np.float32) for points in writers.scans_of(POSES)]
    invalid = np.array([[0, 0, 0], [np.nan, 1, 2], [3, np.inf, 4]], dtype=np.float32)
    found[0] = np.concatenate([found[0][:5], invalid, found[0][5:]])
    return found


def cloud_messages(types: Types, late_ns: int = 3_000_000) -> list[bags.Message]:
    """Recorded a little later than measured."""
    return [
        ("/points", "sensor_msgs/msg/PointCloud2", stamp + late_ns, types.cloud(points, stamp))
        for stamp, points in zip(STAMPS, scans(), strict=True)
    ]


def odometry_messages(types: Types, poses: NDArray[np.float64] = POSES, **more: Any) -> list[bags.Message]:
    """2 ms after each scan the pose, and 48 ms after it one that belongs to no scan."""
    messages = []
    for stamp, pose in zip(STAMPS, poses, strict=True):
        elsewhere = pose.copy()
        elsewhere[:3, 3] += 9
        for offset, matrix in ((2_000_000, pose), (48_000_000, elsewhere)):
            message = types.odometry(matrix, stamp + offset, **more)
            messages.append(("/odom", "nav_msgs/msg/Odometry", stamp + offset, message))
    return messages


def in_order(messages: list[bags.Message]) -> list[bags.Message]:
    return sorted(messages, key=lambda message: message[2])


def write_run(folder: Path, kind: str) -> Path:
    types = Types(kind)
    return bags.write_bag(folder, kind, in_order(cloud_messages(types) + odometry_messages(types)), types)


def write_bins(folder: Path) -> None:
    for i, points in enumerate(scans()):
        writers.write_bin(folder / "scans" / f"{i}.bin", points)


@pytest.mark.parametrize("kind", bags.KINDS)
def test_points_and_poses_are_the_known_ones(kind: str, tmp_path: Path) -> None:
    dataset = read_bag(write_run(tmp_path, kind))
    write_bins(tmp_path)
    assert len(dataset) == writers.NUM_SCANS
    for i in (2, 0, 3, 1):  # in any order
        np.testing.assert_array_equal(dataset.load(i), ts.read_scan(tmp_path / "scans" / f"{i}.bin"))
    np.testing.assert_allclose(dataset.poses, POSES, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(dataset.stamps_ns, STAMPS)


@pytest.mark.parametrize("kind", bags.KINDS)
def test_metrics_are_those_of_the_bin_files(kind: str, tmp_path: Path) -> None:
    write_bins(tmp_path)
    dataset = read_bag(write_run(tmp_path, kind))
    files = [ts.read_points(tmp_path / "scans" / f"{i}.bin") for i in range(writers.NUM_SCANS)]
    from_bag = json.loads(ts.evaluate(dataset).to_json())
    from_files = json.loads(ts.evaluate(files, dataset.poses).to_json())
    assert from_bag["metrics"]["mpv"]["value"] is not None
    for key in ("metrics", "overlap", "rpe_estimate", "windows", "verdict", "trajectory"):
        assert from_bag[key] == from_files[key], key
    assert from_bag["inputs"]["num_dropped_points"] == 3 == from_files["inputs"]["num_dropped_points"]


def pose_messages(types: Types, msgtype: str) -> list[bags.Message]:
    """The known poses as messages of a type."""
    made: list[Any]
    if msgtype == "nav_msgs/msg/Path":  # each message corrects those before it; the last is right
        made = []
        for i in range(len(POSES)):
            poses = POSES.copy()
            poses[:, 0, 3] += 3 - i
            stamped = [types.pose_stamped(pose, stamp) for pose, stamp in zip(poses, STAMPS, strict=True)]
            made.append(types.path(stamped[: i + 1], STAMPS[i]))
    elif msgtype.startswith("tf"):
        imu = types.transform(np.eye(4), START_NS, "lidar", "imu")
        made = [
            types.tf([types.transform(pose, stamp, "map", "lidar"), imu], msgtype)
            for pose, stamp in zip(POSES, STAMPS, strict=True)
        ]
    elif msgtype == "geometry_msgs/msg/TransformStamped":
        made = [types.transform(pose, stamp, "map", "lidar") for pose, stamp in zip(POSES, STAMPS, strict=True)]
    elif msgtype == "geometry_msgs/msg/PoseStamped":
        made = [types.pose_stamped(pose, stamp) for pose, stamp in zip(POSES, STAMPS, strict=True)]
    else:
        made = [types.pose_with_covariance(pose, stamp) for pose, stamp in zip(POSES, STAMPS, strict=True)]
    return [("/pose", msgtype, stamp, message) for stamp, message in zip(STAMPS, made, strict=True)]


@pytest.mark.parametrize(
    ("msgtype", "kind"),
    [
        (msgtype, kind)
        for kind in ("ros1", "ros2-mcap")
        for msgtype in (
            "geometry_msgs/msg/PoseStamped",
            "geometry_msgs/msg/PoseWithCovarianceStamped",
            "geometry_msgs/msg/TransformStamped",
            "nav_msgs/msg/Path",
            "tf2_msgs/msg/TFMessage",
        )
    ]
    + [("tf/msg/tfMessage", "ros1")],
)
def test_every_type_of_poses_is_read(msgtype: str, kind: str, tmp_path: Path) -> None:
    types = Types(kind)
    path = bags.write_bag(tmp_path, kind, in_order(cloud_messages(types) + pose_messages(types, msgtype)), types)
    frames = {"frame_id": "/map", "child_frame_id": "lidar"} if msgtype.startswith("tf") else {}
    np.testing.assert_allclose(read_bag(path, **frames).poses, POSES, rtol=0, atol=1e-14)


def test_several_frames_of_tf_must_be_chosen_from(tmp_path: Path) -> None:
    types = Types("ros1")
    messages = in_order(cloud_messages(types) + pose_messages(types, "tf2_msgs/msg/TFMessage"))
    path = bags.write_bag(tmp_path, "ros1", messages, types)
    with pytest.raises(ts.IoError, match=r"run\.bag: /pose: .*lidar -> imu \(4\), map -> lidar \(4\)"):
        read_bag(path)
    with pytest.raises(ts.IoError, match=r"no pose with frame_id odom .*map -> lidar \(4\)"):
        read_bag(path, frame_id="odom")


CLOUDS: dict[str, dict[str, Any]] = {
    "reversed fields": {"dtype": [("i", "<u2"), ("z", "<f4"), ("y", "<f4"), ("x", "<f4")]},
    "doubles": {"dtype": [("t", "<f8"), ("x", "<f8"), ("y", "<f8"), ("z", "<f8")]},
    "mixed types": {"dtype": [("x", "<f8"), ("ring", "u1"), ("y", "<f4"), ("z", "<f8")]},
    "integers": {"dtype": [("x", "<i2"), ("y", "<i4"), ("z", "i1")], "integers": True},
    "big-endian": {"dtype": [("x", ">f4"), ("y", ">f4"), ("z", ">f4"), ("i", ">f4")], "bigendian": True},
    "organized with padded rows": {"dtype": [("x", "<f4"), ("y", "<f4"), ("z", "<f4")], "height": 4, "padding": 20},
    "last row without padding": {
        "dtype": [("x", "<f4"), ("y", "<f4"), ("z", "<f4")], "height": 4, "padding": 20, "cut": 20
    },
}  # fmt: skip
DATATYPES = {"i1": 1, "u1": 2, "i2": 3, "u2": 4, "i4": 5, "u4": 6, "f4": 7, "f8": 8}


def odd_cloud(types: Types, dtype: list[tuple[str, str]], points: NDArray[np.float64], **how: Any) -> Any:
    """A PointCloud2 of a structured array, packed by numpy, with rows padded by bytes that are no zeros."""
    table = np.zeros(len(points), dtype=dtype)
    for axis, name in enumerate("xyz"):
        table[name] = points[:, axis]
    height, padding = how.get("height", 1), how.get("padding", 0)
    rows = [part.tobytes() + b"\x55" * padding for part in np.split(table, height)]
    data = b"".join(rows)
    fields = [(name, table.dtype.fields[name][1], DATATYPES[table.dtype[name].str[1:]]) for name in table.dtype.names]
    return types.raw_cloud(
        data[: len(data) - how.get("cut", 0)], fields, table.itemsize, (height, len(points) // height), STAMPS[0],
        row_step=len(rows[0]), bigendian=how.get("bigendian", False),
    )  # fmt: skip


@pytest.mark.parametrize("name", CLOUDS)
def test_points_of_any_layout_are_read(name: str, tmp_path: Path) -> None:
    how = dict(CLOUDS[name])
    dtype = how.pop("dtype")
    rng = np.random.default_rng(3)
    points = rng.uniform(-100, 100, (12, 3)).astype(np.float32).astype(np.float64)
    if how.pop("integers", False):
        points = np.round(points)
    types = Types("ros1")
    message = odd_cloud(types, dtype, points, **how)
    messages = [
        ("/points", "sensor_msgs/msg/PointCloud2", STAMPS[0], message),
        *pose_messages(types, "geometry_msgs/msg/PoseStamped")[:1],
    ]
    np.testing.assert_array_equal(read_bag(bags.write_bag(tmp_path, "ros1", messages, types)).load(0), points)


BROKEN: dict[str, tuple[dict[str, Any], str]] = {
    "no z": ({"fields": [("x", 0, 7), ("y", 4, 7)]}, r"found 0 fields called z, expected one \(fields: x y\)"),
    "two x": ({"fields": [("x", 0, 7), ("x", 0, 7), ("y", 4, 7), ("z", 8, 7)]}, "found 2 fields called x"),
    "beyond the point": ({"fields": [("x", 0, 7), ("y", 4, 7), ("z", 10, 7)]}, "field z ends at byte 14 of 12"),
    "unknown type": ({"fields": [("x", 0, 7), ("y", 4, 7), ("z", 8, 9)]}, "field z has the datatype 9"),
    "too short": ({"data": b"\0" * 23}, "data has 23 bytes, expected 24 for 1 x 2 points"),
    "short rows": ({"shape": (2, 1), "row_step": 8}, "row_step is 8, expected 12 or more"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_malformed_points_name_the_topic_and_the_message(name: str, tmp_path: Path) -> None:
    changed, text = BROKEN[name]
    fields = [("x", 0, 7), ("y", 4, 7), ("z", 8, 7)]
    types = Types("ros1")
    arguments = {"data": b"\0" * 24, "fields": fields, "point_step": 12, "shape": (1, 2), "stamp_ns": STAMPS[0]}
    messages = [
        ("/points", "sensor_msgs/msg/PointCloud2", STAMPS[0], types.raw_cloud(**{**arguments, **changed})),
        *pose_messages(types, "geometry_msgs/msg/PoseStamped")[:1],
    ]
    dataset = read_bag(bags.write_bag(tmp_path, "ros1", messages, types))
    with pytest.raises(ts.IoError, match=rf"run\.bag: /points: message 0: {text}"):
        dataset.load(0)


def test_scans_recorded_at_the_same_time_are_told_apart(tmp_path: Path) -> None:
    types = Types("ros2-mcap")
    messages = [(topic, name, STAMPS[0], message) for topic, name, _, message in cloud_messages(types)]
    messages += pose_messages(types, "geometry_msgs/msg/PoseStamped")
    dataset = read_bag(bags.write_bag(tmp_path, "ros2-mcap", messages, types))
    assert len(dataset) == 4
    for i in (3, 1):
        np.testing.assert_array_equal(dataset.load(i), scans()[i])


def test_several_topics_are_listed_with_type_and_count(tmp_path: Path) -> None:
    types = Types("ros2-db3")
    messages = cloud_messages(types) + odometry_messages(types)
    messages += [("/other", *message[1:]) for message in cloud_messages(types)[:2]]
    messages += pose_messages(types, "geometry_msgs/msg/PoseStamped")
    path = bags.write_bag(tmp_path, "ros2-db3", in_order(messages), types)
    with pytest.raises(ts.IoError, match="choose points_topic") as error:
        read_bag(path)
    assert "\n  /other (sensor_msgs/msg/PointCloud2, 2)" in str(error.value)
    assert "\n  /points (sensor_msgs/msg/PointCloud2, 4)" in str(error.value)
    with pytest.raises(ts.IoError, match="choose poses_topic") as error:
        read_bag(path, points_topic="/points")
    assert "\n  /odom (nav_msgs/msg/Odometry, 8)\n  /pose (geometry_msgs/msg/PoseStamped, 4)" in str(error.value)
    assert len(read_bag(path, points_topic="/other", poses_topic="/pose")) == 2
    with pytest.raises(ts.IoError, match="poses_topic = /nothing is no topic"):
        read_bag(path, points_topic="/points", poses_topic="/nothing")


def test_tf_is_taken_only_where_there_are_no_other_poses(tmp_path: Path) -> None:
    types = Types("ros1")
    tf = [("/tf", *message[1:]) for message in pose_messages(types, "tf2_msgs/msg/TFMessage")]
    messages = in_order(cloud_messages(types) + odometry_messages(types) + tf)
    dataset = read_bag(bags.write_bag(tmp_path, "ros1", messages, types))
    assert dataset.facts.poses is not None and dataset.facts.poses.endswith(":/odom")


def body_poses(body_from_sensor: NDArray[np.float64]) -> NDArray[np.float64]:
    return POSES @ np.linalg.inv(body_from_sensor)


def test_a_mount_in_tf_static_is_used_and_reported(tmp_path: Path) -> None:
    mast = writers.rigid(writers.Rotation.from_euler("z", 40, degrees=True), [0.3, 0.0, 1.1])
    lidar = writers.rigid(writers.Rotation.from_euler("y", 10, degrees=True), [0.0, 0.2, 0.4])
    types = Types("ros2-mcap")
    # base -> mast, and the mast in the frame of the lidar: one forwards, one backwards
    static = types.tf(
        [
            types.transform(mast, 0, "base", "mast"),
            types.transform(np.linalg.inv(lidar), 0, "lidar", "mast"),
        ]
    )
    messages = [("/tf_static", "tf2_msgs/msg/TFMessage", START_NS - 5, static), *cloud_messages(types)]
    messages += odometry_messages(types, body_poses(mast @ lidar), child="base")
    path = bags.write_bag(tmp_path, "ros2-mcap", in_order(messages), types)
    dataset = read_bag(path)
    np.testing.assert_allclose(dataset.poses, POSES, rtol=0, atol=1e-13)
    assert dataset.facts.extrinsic_source == "/tf_static:base_from_lidar"
    given = read_bag(path, extrinsic=mast @ lidar)
    np.testing.assert_allclose(given.poses, POSES, rtol=0, atol=1e-13)
    assert given.facts.extrinsic_source == "extrinsic"


def test_frames_that_nothing_joins_are_warned_of(tmp_path: Path) -> None:
    types = Types("ros1")
    messages = in_order(cloud_messages(types) + odometry_messages(types, child="base"))
    path = bags.write_bag(tmp_path, "ros1", messages, types)
    with pytest.warns(ts.TrysquareWarning, match="poses are of the frame base, scans in lidar"):
        dataset = read_bag(path)
    assert dataset.extrinsic is None


def test_scans_without_a_pose_are_left_out_with_a_warning(tmp_path: Path) -> None:
    types = Types("ros1")
    messages = in_order(cloud_messages(types) + odometry_messages(types)[2:])
    path = bags.write_bag(tmp_path, "ros1", messages, types)
    with pytest.warns(ts.TrysquareWarning, match="1 of 4 scans have no pose within 0.01 s"):
        dataset = read_bag(path)
    np.testing.assert_array_equal(dataset.load(0), scans()[1])
    np.testing.assert_array_equal(dataset.stamps_ns, STAMPS[1:])
    with pytest.raises(ts.IoError, match=r"run\.bag: /odom: no pose lies within 0\.0001 s"):
        read_bag(path, t_max_diff_s=1e-4)


def test_times_of_recording_are_used_when_asked_for(tmp_path: Path) -> None:
    """Headers say that scan i was at i; the clock of the recorder says that the poses came one step later."""
    types = Types("ros1")
    messages = cloud_messages(types, late_ns=2 * STEP_NS)
    for stamp, pose in zip(STAMPS, POSES, strict=True):
        stamped = types.pose_stamped(pose, stamp)
        messages.append(("/pose", "geometry_msgs/msg/PoseStamped", stamp + 3 * STEP_NS, stamped))
    path = bags.write_bag(tmp_path, "ros1", in_order(messages), types)
    np.testing.assert_allclose(read_bag(path).poses, POSES, atol=1e-14)
    with pytest.warns(ts.TrysquareWarning, match="1 of 4 scans"):
        by_recorder = read_bag(path, stamps="bag")
    np.testing.assert_allclose(by_recorder.poses, POSES[:3], atol=1e-14)
    np.testing.assert_array_equal(by_recorder.load(0), scans()[1])


def test_first_last_and_every_select(tmp_path: Path) -> None:
    path = write_run(tmp_path, "ros2-mcap")
    dataset = read_bag(path, first=1, last=3, every=2)
    np.testing.assert_allclose(dataset.poses, POSES[[1, 3]], atol=1e-14)
    np.testing.assert_array_equal(dataset.load(1), scans()[3])
    with pytest.raises(ts.InvalidArgument, match="last = 4 select no range of the 4 scans"):
        read_bag(path, last=4)


def test_a_split_recording_is_one(tmp_path: Path) -> None:
    types = Types("ros1")
    first, second = tmp_path / "a", tmp_path / "b"
    messages = in_order(cloud_messages(types) + odometry_messages(types))
    half = len(messages) // 2
    for folder, part in ((first, messages[:half]), (second, messages[half:])):
        folder.mkdir()
        bags.write_bag(folder, "ros1", part, types).rename(tmp_path / f"{folder.name}.bag")
    for path in (tmp_path, [tmp_path / "a.bag", tmp_path / "b.bag"]):
        np.testing.assert_allclose(read_bag(path).poses, POSES, atol=1e-14)


@pytest.mark.parametrize("name", ["run.bag", "run.mcap", "run.db3"])
def test_what_is_no_bag_is_named(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(b"no bag at all" * 10)
    with pytest.raises(ts.IoError, match=rf"{name}: cannot be read as a bag: "):
        read_bag(tmp_path / name)
    with pytest.raises(ts.IoError, match="nowhere: no such file or folder"):
        read_bag(tmp_path / "nowhere")


def test_a_bad_quaternion_names_the_message(tmp_path: Path) -> None:
    types = Types("ros1")
    messages = pose_messages(types, "geometry_msgs/msg/PoseStamped")
    messages[2][3].pose.orientation.w = 5.0
    path = bags.write_bag(tmp_path, "ros1", in_order(cloud_messages(types) + messages), types)
    with pytest.raises(ts.IoError, match=r"run\.bag: /pose: message 2: the quaternion .* expected 1"):
        read_bag(path)


def test_importing_the_package_imports_no_rosbags_and_says_what_is_missing(tmp_path: Path) -> None:
    code = f"""
import sys
import trysquare, trysquare.bags
assert not [name for name in sys.modules if name.split(".")[0] in ("rosbags", "matplotlib", "laspy")]
sys.modules["rosbags"] = None
try:
    trysquare.bags.read_bag({str(write_run(tmp_path, "ros1"))!r})
except ImportError as error:
    assert "pip install trysquare[bags]" in str(error), error
else:
    raise SystemExit("no ImportError")
"""
    subprocess.run([sys.executable, "-c", code], check=True)
