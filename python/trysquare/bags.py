# SPDX-License-Identifier: Apache-2.0
"""Scans and poses of ROS 1 and ROS 2 bags: pip install trysquare[bags]."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare import _core
from trysquare._bag import Bag
from trysquare._bag_points import points_of
from trysquare._bag_poses import POSE_TYPES, TF_TYPES, StampedPose, between, poses_of, stamp_of, static_transform
from trysquare._core import InvalidArgument, IoError
from trysquare._dataset import Dataset, extrinsic_text
from trysquare.layouts._open import dataset_of
from trysquare.layouts._pairing import PairedScans, pair_by_time

POINTS_TYPE = "sensor_msgs/msg/PointCloud2"


def read_bag(
    path: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    points_topic: str | None = None,
    poses_topic: str | None = None,
    frame_id: str | None = None,
    child_frame_id: str | None = None,
    extrinsic: Any = None,
    use_tf_static: bool = True,
    stamps: str = "header",
    first: int = 0,
    last: int | None = None,
    every: int = 1,
    t_max_diff_s: float = 0.01,
) -> Dataset:
    """Scans (PointCloud2) and the pose of each from a bag.

    Reads ROS 1 .bag files, folders of ROS 2 with metadata.yaml (sqlite3 or MCAP, compressed or not), and lone .mcap and
    .db3 files. Scans stay in the bag, which stays open as long as the data set lives, and are read when asked for; the
    bag is gone through once at the beginning, for the times of the scans.

    Args:
        path: the bag, or the files of one recording that was split.
        points_topic: topic of the scans. None: the only one of type PointCloud2.
        poses_topic: topic of Odometry, PoseStamped, PoseWithCovarianceStamped, TransformStamped, Path (its last
            message) or TFMessage. None: the only one, where /tf counts only if there is no other.
        frame_id, child_frame_id: frames of the poses, world and body. None: the only ones on the topic. Messages that
            do not name the body count as of `child_frame_id`.
        extrinsic: body_from_sensor, as in open_dataset(): (4, 4), a file, or a text of 12 or 16 numbers, metres.
        use_tf_static: without `extrinsic`, and where the body is named and is not the frame of the scans, take
            body_from_sensor from /tf_static.
        stamps: "header" pairs scans and poses by the time in their headers, "bag" by when they were recorded.
        first, last, every: which of the paired scans to take; `last` is inclusive.
        t_max_diff_s: a scan takes the nearest pose within this, seconds; those without one are left out with a warning.

    Returns:
        Scans, and world_from_sensor of each, (M, 4, 4).

    Raises:
        ImportError: rosbags is not installed.
        InvalidArgument: an argument is out of range.
        IoError: the bag cannot be read; a topic is missing or several would do: the message lists them with type and
            number of messages; a message is malformed: it names topic and message.
    """
    if stamps not in ("header", "bag"):
        raise InvalidArgument(f'stamps = "{stamps}" is unknown, expected header or bag')
    bag = Bag(path)
    points = bag.topic("points_topic", points_topic, (POINTS_TYPE,))
    pose_types = POSE_TYPES if poses_topic is None and bag.connections(POSE_TYPES) else (*POSE_TYPES, *TF_TYPES)
    poses = bag.topic("poses_topic", poses_topic, pose_types)
    scans = _BagScans(bag, points, stamps)
    trajectory = _trajectory(bag, poses, frame_id, child_frame_id, stamps)
    chosen, nearest, warnings = pair_by_time(
        np.array(scans.stamps_ns), np.array([p.stamp_ns for p in trajectory]), t_max_diff_s, f"{bag.name}: {poses}"
    )
    body = trajectory[0].child or child_frame_id
    body_from_sensor, source, more = _extrinsic(bag, extrinsic, body, scans.frame, use_tf_static)
    matrices = np.stack([trajectory[i].matrix for i in nearest])
    paired = PairedScans(
        [f"{bag.name}:{points}[{i}]" for i in chosen],
        lambda i: scans.load(int(chosen[i])),
        matrices if body_from_sensor is None else matrices @ body_from_sensor,
        np.array(scans.stamps_ns)[chosen],
        str(bag.topics[poses].msgtype),
        "bag",
        body_from_sensor,
        source,
        warnings + more,
    )
    return dataset_of(paired.selected(first, last, every), bag.name, f"{bag.name}:{poses}")


class _BagScans:
    """Where the scans of a topic are."""

    def __init__(self, bag: Bag, topic: str, stamps: str) -> None:
        self.bag, self.topic = bag, topic
        self.recorded: list[tuple[int, int]] = []
        """Time of recording [ns], and the how-manieth message of that time."""
        self.stamps_ns: list[int] = []
        self.frame = ""
        repeats: dict[int, int] = {}
        for recorded_ns, message, _ in bag.messages(topic, (POINTS_TYPE,)):
            repeat = repeats.get(recorded_ns, 0)
            repeats[recorded_ns] = repeat + 1
            self.recorded.append((recorded_ns, repeat))
            self.stamps_ns.append(stamp_of(message.header) if stamps == "header" else recorded_ns)
            self.frame = message.header.frame_id.removeprefix("/")

    def load(self, index: int) -> NDArray[np.float64]:
        recorded_ns, repeat = self.recorded[index]
        with self.bag.lock:
            same_time = self.bag.messages(self.topic, (POINTS_TYPE,), recorded_ns)
            _, message, _ = next(islice(same_time, repeat, None))
        try:
            return points_of(message)
        except ValueError as error:
            raise IoError(f"{self.bag.name}: {self.topic}: message {index}: {error}") from None


def _poses_on(bag: Bag, topic: str, stamps: str) -> list[StampedPose]:
    """All poses of a topic; of paths those of the last message."""
    poses: list[StampedPose] = []
    for index, (recorded_ns, message, msgtype) in enumerate(bag.messages(topic, (*POSE_TYPES, *TF_TYPES))):
        try:
            new = list(poses_of(message, msgtype))
        except ValueError as error:
            raise IoError(f"{bag.name}: {topic}: message {index}: {error}") from None
        if msgtype == "nav_msgs/msg/Path":
            poses.clear()  # it corrects the one before
        elif stamps == "bag":
            new = [replace(pose, stamp_ns=recorded_ns) for pose in new]
        poses += new
    return poses


def _trajectory(bag: Bag, topic: str, parent: str | None, child: str | None, stamps: str) -> list[StampedPose]:
    """The poses of a topic between two frames."""
    poses = _poses_on(bag, topic, stamps)
    try:
        return between(poses, parent, child)
    except ValueError as error:
        raise IoError(f"{bag.name}: {topic}: {error}") from None


def _extrinsic(
    bag: Bag, given: Any, body: str | None, sensor: str, use_tf_static: bool
) -> tuple[NDArray[np.float64] | None, str | None, list[tuple[str, str]]]:
    """body_from_sensor, where it came from, and a warning where it is needed and not to be found."""
    if given is not None:
        text = extrinsic_text(given)
        return _core.read_extrinsic(text), text if isinstance(given, (str, os.PathLike)) else "extrinsic", []
    if body is None or body.removeprefix("/") == sensor:
        return None, None, []
    body = body.removeprefix("/")
    if use_tf_static:
        joined = static_transform(_poses_on(bag, "/tf_static", "header"), body, sensor)
        if joined is not None:
            return joined, f"/tf_static:{body}_from_{sensor}", []
    return (
        None,
        None,
        [
            (
                "frames_differ",
                f"{bag.name}: poses are of the frame {body}, scans in {sensor}, and /tf_static does not join them: "
                "they are taken for the same; see extrinsic",
            )
        ],
    )
