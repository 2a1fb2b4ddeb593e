# SPDX-License-Identifier: Apache-2.0
"""Poses of ROS messages. Knows no rosbags: a message is anything with its fields."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare.layouts._rotations import pose_from_quaternion

POSE_TYPES = (
    "nav_msgs/msg/Odometry",
    "geometry_msgs/msg/PoseStamped",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "geometry_msgs/msg/TransformStamped",
    "nav_msgs/msg/Path",
)
TF_TYPES = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")


@dataclass(frozen=True)
class StampedPose:
    """parent_from_child at a time."""

    stamp_ns: int
    matrix: NDArray[np.float64]
    """(4, 4), metres."""
    parent: str
    child: str | None
    """None: the type of message does not name it."""


def stamp_of(header: Any) -> int:
    """Nanoseconds of a header."""
    return int(header.stamp.sec) * 1_000_000_000 + int(header.stamp.nanosec)


def poses_of(message: Any, msgtype: str) -> Iterator[StampedPose]:
    """The poses that one message holds: several of a path or of tf, else one.

    Raises:
        ValueError: a number is not finite or a quaternion has not the norm 1.
    """
    if msgtype in TF_TYPES:
        for each in message.transforms:
            yield from poses_of(each, "geometry_msgs/msg/TransformStamped")
    elif msgtype == "nav_msgs/msg/Path":
        for each in message.poses:
            yield _stamped(each.header, each.pose, None, message.header.frame_id)
    elif msgtype == "geometry_msgs/msg/TransformStamped":
        t, q = message.transform.translation, message.transform.rotation
        matrix = pose_from_quaternion((t.x, t.y, t.z), (q.w, q.x, q.y, q.z))
        yield StampedPose(
            stamp_of(message.header), matrix, _frame(message.header.frame_id), _frame(message.child_frame_id)
        )
    elif msgtype == "geometry_msgs/msg/PoseStamped":
        yield _stamped(message.header, message.pose, None)
    elif msgtype == "nav_msgs/msg/Odometry":
        yield _stamped(message.header, message.pose.pose, _frame(message.child_frame_id))
    else:
        yield _stamped(message.header, message.pose.pose, None)


def between(poses: Iterable[StampedPose], parent: str | None, child: str | None) -> list[StampedPose]:
    """The poses with these frames; None stands for any.

    Raises:
        ValueError: there are none, or several pairs of frames remain: the message lists them with their counts.
    """
    everything = list(poses)
    kept = [
        pose
        for pose in everything
        if (parent is None or pose.parent == _frame(parent))
        and (child is None or pose.child is None or pose.child == _frame(child))
    ]
    pairs = Counter((pose.parent, pose.child) for pose in kept or everything)
    listed = ", ".join(f"{p} -> {c or 'unnamed'} ({n})" for (p, c), n in sorted(pairs.items(), key=str))
    if not kept:
        raise ValueError(f"no pose with frame_id {parent} and child_frame_id {child}; found {listed or 'none'}")
    if len(pairs) > 1:
        raise ValueError(f"poses between several frames, choose frame_id and child_frame_id: {listed}")
    return kept


def static_transform(edges: Iterable[StampedPose], parent: str, child: str) -> NDArray[np.float64] | None:
    """parent_from_child through fixed transforms, each passed forwards or backwards, by the fewest of them."""
    steps: dict[str, dict[str, NDArray[np.float64]]] = {}
    for edge in edges:
        if edge.child is not None:
            steps.setdefault(edge.parent, {})[edge.child] = edge.matrix
            steps.setdefault(edge.child, {})[edge.parent] = np.asarray(np.linalg.inv(edge.matrix), dtype=np.float64)
    reached = {parent: np.eye(4)}
    queue = deque([parent])
    while queue and child not in reached:
        here = queue.popleft()
        for there, matrix in steps.get(here, {}).items():
            if there not in reached:
                reached[there] = reached[here] @ matrix
                queue.append(there)
    return reached.get(child)


def _stamped(header: Any, pose: Any, child: str | None, parent: str | None = None) -> StampedPose:
    p, q = pose.position, pose.orientation
    matrix = pose_from_quaternion((p.x, p.y, p.z), (q.w, q.x, q.y, q.z))
    return StampedPose(stamp_of(header), matrix, _frame(parent or header.frame_id), child)


def _frame(name: str) -> str:
    """ROS 1 wrote frames with and without a slash in front."""
    return name.removeprefix("/")
