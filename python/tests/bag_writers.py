# SPDX-License-Identifier: Apache-2.0
"""Bags of every kind, written by rosbags from known arrays."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from scipy.spatial.transform import Rotation

START_NS = 1_700_000_000_123_456_789
STEP_NS = 100_000_000

KINDS = ("ros1", "ros2-db3", "ros2-mcap", "lone-db3", "lone-mcap", "ros2-mcap-zstd", "ros2-db3-zstd-messages")

Message = tuple[str, str, int, Any]
"""Topic, type, time of recording [ns], message."""


class Types:
    """Messages of ROS 1 or ROS 2."""

    def __init__(self, kind: str) -> None:
        self.is_ros1 = kind == "ros1"
        self.store = get_typestore(Stores.ROS1_NOETIC if self.is_ros1 else Stores.ROS2_HUMBLE)
        if self.is_ros1:
            definition = "geometry_msgs/TransformStamped[] transforms"
            self.store.register(get_types_from_msg(definition, "tf2_msgs/msg/TFMessage"))
            self.store.register(get_types_from_msg(definition, "tf/msg/tfMessage"))

    def make(self, name: str, /, *fields: Any, **named: Any) -> Any:
        return self.store.types[name](*fields, **named)

    def header(self, stamp_ns: int, frame: str) -> Any:
        stamp = self.make("builtin_interfaces/msg/Time", stamp_ns // 10**9, stamp_ns % 10**9)
        named = {"stamp": stamp, "frame_id": frame}
        if self.is_ros1:
            named["seq"] = 0
        return self.make("std_msgs/msg/Header", **named)

    def cloud(self, points: NDArray[np.float32], stamp_ns: int, frame: str = "lidar") -> Any:
        """x y z intensity, float32, as most drivers write them."""
        data = np.zeros((len(points), 4), dtype="<f4")
        data[:, :3] = points
        fields = [(name, 4 * i, 7) for i, name in enumerate(("x", "y", "z", "intensity"))]
        return self.raw_cloud(data.tobytes(), fields, 16, (1, len(points)), stamp_ns, frame)

    def raw_cloud(
        self,
        data: bytes,
        fields: Iterable[tuple[str, int, int]],
        point_step: int,
        shape: tuple[int, int],
        stamp_ns: int,
        frame: str = "lidar",
        row_step: int | None = None,
        bigendian: bool = False,
    ) -> Any:
        height, width = shape
        return self.make(
            "sensor_msgs/msg/PointCloud2",
            header=self.header(stamp_ns, frame),
            height=height,
            width=width,
            fields=[
                self.make("sensor_msgs/msg/PointField", name=name, offset=offset, datatype=datatype, count=1)
                for name, offset, datatype in fields
            ],
            is_bigendian=bigendian,
            point_step=point_step,
            row_step=width * point_step if row_step is None else row_step,
            data=np.frombuffer(data, dtype=np.uint8),
            is_dense=False,
        )

    def pose(self, matrix: NDArray[np.float64]) -> Any:
        x, y, z, w = Rotation.from_matrix(matrix[:3, :3]).as_quat().tolist()
        point = self.make("geometry_msgs/msg/Point", *matrix[:3, 3].tolist())
        return self.make("geometry_msgs/msg/Pose", point, self.make("geometry_msgs/msg/Quaternion", x, y, z, w))

    def pose_stamped(self, matrix: NDArray[np.float64], stamp_ns: int, frame: str = "map") -> Any:
        return self.make("geometry_msgs/msg/PoseStamped", self.header(stamp_ns, frame), self.pose(matrix))

    def with_covariance(self, matrix: NDArray[np.float64]) -> Any:
        return self.make("geometry_msgs/msg/PoseWithCovariance", self.pose(matrix), np.zeros(36))

    def pose_with_covariance(self, matrix: NDArray[np.float64], stamp_ns: int) -> Any:
        header = self.header(stamp_ns, "map")
        return self.make("geometry_msgs/msg/PoseWithCovarianceStamped", header, self.with_covariance(matrix))

    def odometry(self, matrix: NDArray[np.float64], stamp_ns: int, child: str = "lidar") -> Any:
        zero = self.make("geometry_msgs/msg/Vector3", 0.0, 0.0, 0.0)
        twist = self.make("geometry_msgs/msg/Twist", zero, zero)
        still = self.make("geometry_msgs/msg/TwistWithCovariance", twist, np.zeros(36))
        return self.make(
            "nav_msgs/msg/Odometry", self.header(stamp_ns, "map"), child, self.with_covariance(matrix), still
        )

    def transform(self, matrix: NDArray[np.float64], stamp_ns: int, parent: str, child: str) -> Any:
        pose = self.pose(matrix)
        vector = self.make("geometry_msgs/msg/Vector3", *matrix[:3, 3].tolist())
        inner = self.make("geometry_msgs/msg/Transform", vector, pose.orientation)
        return self.make("geometry_msgs/msg/TransformStamped", self.header(stamp_ns, parent), child, inner)

    def tf(self, transforms: list[Any], name: str = "tf2_msgs/msg/TFMessage") -> Any:
        return self.make(name, transforms)

    def path(self, poses: list[Any], stamp_ns: int) -> Any:
        return self.make("nav_msgs/msg/Path", self.header(stamp_ns, "map"), poses)


def write_bag(folder: Path, kind: str, messages: Iterable[Message], types: Types | None = None) -> Path:
    """Writes a bag of a kind and returns what is to be opened."""
    types = types or Types(kind)
    path = folder / ("run.bag" if kind == "ros1" else "run")
    if kind == "ros1":
        writer: Any = Writer1(path)
        serialize = types.store.serialize_ros1
    else:
        plugin = StoragePlugin.MCAP if "mcap" in kind else StoragePlugin.SQLITE3
        writer = Writer2(path, version=8, storage_plugin=plugin)
        serialize = types.store.serialize_cdr
        if "zstd" in kind:
            mode = CompressionMode.MESSAGE if "messages" in kind else CompressionMode.STORAGE
            writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        connections: dict[tuple[str, str], Any] = {}
        for topic, name, recorded_ns, message in messages:
            if (topic, name) not in connections:
                connections[topic, name] = writer.add_connection(topic, name, typestore=types.store)
            writer.write(connections[topic, name], recorded_ns, serialize(message, name))
    if kind.startswith("lone"):
        return next(file for file in path.iterdir() if file.suffix in (".db3", ".mcap"))
    return path
