# SPDX-License-Identifier: Apache-2.0
"""Tiny data sets in the layouts of others, with a known world and known poses of the sensor.

Each writer states the frames of its data set once more, from its documentation and with scipy, and turns the same
known sensor poses into what that data set stores. Loaders must find the way back. Every scan sees the whole world, so
the scans agree in the world if, and only if, every frame is right.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]

NUM_SCANS = 4


def rigid(rotation: Rotation, translation: list[float]) -> Array:
    matrix = np.eye(4)
    matrix[:3, :3] = rotation.as_matrix()
    matrix[:3, 3] = translation
    return matrix


def world_points() -> Array:
    """(300, 3): two walls and a floor of different sizes, so that no symmetry hides a wrong frame."""
    rng = np.random.default_rng(7)
    u, v = rng.uniform(1, 9, (2, 100))
    flat = np.full(100, 0.0)
    return np.concatenate([np.stack(p, axis=1) for p in ((u, v, flat), (u, flat + 9.5, v / 3), (flat + 11, u, v / 2))])


def sensor_poses() -> Array:
    """(NUM_SCANS, 4, 4) world_from_sensor with turns about all three axes; the first is not the identity."""
    return np.stack(
        [
            rigid(
                Rotation.from_euler("xyz", [2 - i, 3 * i - 1, 25 + 20 * i], degrees=True), [0.7 * i, 0.4, 1.7 + 0.1 * i]
            )
            for i in range(NUM_SCANS)
        ]
    )


def in_frame(pose: Array, points: Array) -> Array:
    """Points of the world as the sensor sees them."""
    return (points - pose[:3, 3]) @ pose[:3, :3]


def scans_of(poses: Array) -> list[Array]:
    return [in_frame(pose, world_points()) for pose in poses]


def write_bin(path: Path, points: Array, columns: int = 4) -> None:
    """float32 of x y z and more columns, as KITTI (4) and nuScenes (5) store points."""
    table = np.zeros((len(points), columns), dtype="<f4")
    table[:, :3] = points
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(table.tobytes())


def write_pcd(path: Path, points: Array) -> None:
    header = (
        "VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n"
        f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA binary\n"
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(header.encode() + points.astype("<f8").tobytes())


def write_ply(path: Path, points: Array) -> None:
    header = f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n" + "".join(
        f"property float {name}\n" for name in "xyz"
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(header + "end_header\n" + "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points.tolist()))


def rows(matrices: Array) -> list[str]:
    return [" ".join(map(repr, m[:3].ravel().tolist())) for m in matrices]


CAMERA_FROM_VELODYNE = rigid(
    Rotation.from_matrix([[0, -1, 0], [0, 0, -1], [1, 0, 0]]) * Rotation.from_euler("x", 1.0, degrees=True),
    [-0.012, -0.054, -0.292],
)
"""x of the camera to the right, z forward; about that of KITTI 00."""


def write_kitti(root: Path, poses_file: Path, poses: Array) -> None:
    """KITTI odometry: T = camera 0's pose in its first frame. With the sensor's pose W, the camera's is W * Tr^-1."""
    for i, points in enumerate(scans_of(poses)):
        write_bin(root / "velodyne" / f"{i:06}.bin", points)
    tr_inverse = np.linalg.inv(CAMERA_FROM_VELODYNE)
    cameras = poses @ tr_inverse
    poses_file.parent.mkdir(parents=True, exist_ok=True)
    poses_file.write_text("\n".join(rows(np.linalg.inv(cameras[0]) @ cameras)) + "\n")
    (root / "calib.txt").write_text(f"P0: {'1 ' * 12}\nTr: {rows(CAMERA_FROM_VELODYNE[None])[0]}\n")
    (root / "times.txt").write_text("".join(f"{0.1 * i:e}\n" for i in range(len(poses))))


BASE_FROM_OUSTER = np.array(
    [
        [-9.9998295e-01, -5.8398386e-03, -5.2257060e-06, 1.7042],
        [5.8398386e-03, -9.9998295e-01, 1.7758769e-06, -0.0210],
        [-5.2359878e-06, 1.7453292e-06, 1.0, 1.8047],
        [0.0, 0.0, 0.0, 1.0],
    ]
)
"""calib_base2ouster of MulRan, printed as a matrix to eight digits."""

UTM = np.array([354000.25, 4035000.5, 20.0])


def write_mulran(root: Path, poses: Array, folder: str = "Ouster") -> Array:
    """MulRan: the base in UTM, 100 poses a second, one of which is 2 ms from each scan. Returns the stamps."""
    start = 1561000444390857630
    stamps = start + 100_000_000 * np.arange(len(poses))
    for stamp, points in zip(stamps, scans_of(poses), strict=True):
        write_bin(root / folder / f"{stamp}.bin", points)
    in_utm = poses.copy()
    in_utm[:, :3, 3] += UTM
    bases = in_utm @ np.linalg.inv(BASE_FROM_OUSTER)
    lines = []
    for stamp, base in zip(stamps, bases, strict=True):
        elsewhere = base.copy()
        elsewhere[:3, 3] += 5.0
        for offset, pose in ((-8_000_000, elsewhere), (2_000_000, base), (12_000_000, elsewhere)):
            lines.append(f"{stamp + offset}," + ",".join(map(repr, pose[:3].ravel().tolist())))
    (root / "global_pose.csv").write_text("\n".join(lines) + "\n")
    return stamps


def write_newer_college(root: Path, poses: Array) -> Array:
    """Newer College 2020: poses of `base`; tf says base -> os_lidar: -0.084 -0.025 0.050, RPY 0 0 135 degrees.

    The nanoseconds in the names have no leading zeros, so their order as text is not that of time. Returns the stamps.
    """
    base_from_lidar = rigid(Rotation.from_euler("z", 135, degrees=True), [-0.084, -0.025, 0.050])
    bases = poses @ np.linalg.inv(base_from_lidar)
    nanoseconds = [902590976, 2590976, 102590976, 202590976]
    seconds = [1583836591, 1583836592, 1583836592, 1583836592]
    lines = ["#sec,nsec,x,y,z,qx,qy,qz,qw"]
    for s, ns, base, points in zip(seconds, nanoseconds, bases, scans_of(poses), strict=True):
        write_pcd(root / "raw_format" / "ouster_scan" / f"cloud_{s}_{ns}.pcd", points)
        elsewhere = base.copy()
        elsewhere[:3, 3] += 5.0
        for after, pose in ((-40_000, elsewhere), (1_000, base)):  # two poses a scan
            numbers = [*pose[:3, 3], *Rotation.from_matrix(pose[:3, :3]).as_quat()]
            lines.append(f"{s},{ns + after}," + ",".join(repr(float(number)) for number in numbers))
    (root / "ground_truth").mkdir()
    (root / "ground_truth" / "registered_poses.csv").write_text("\n".join(lines) + "\n")
    return np.array(seconds) * 1_000_000_000 + np.array(nanoseconds)


def _wxyz(rotation: Rotation) -> list[float]:
    x, y, z, w = rotation.as_quat().tolist()
    return [w, x, y, z]


def write_nuscenes(root: Path, poses: Array, scenes: tuple[str, ...] = ("scene-0061",)) -> None:
    """nuScenes: each scene is the same drive, 100 m on; key frames are the even scans. There is a camera, too."""
    ego_from_lidar = rigid(Rotation.from_euler("xyz", [0.5, -1.0, -90.0], degrees=True), [0.94, 0.0, 1.84])
    tables: dict[str, list[dict[str, object]]] = {name: [] for name in ("scene", "sample", "sample_data", "ego_pose")}
    tables["sensor"] = [{"token": "l", "channel": "LIDAR_TOP"}, {"token": "c", "channel": "CAM_FRONT"}]
    tables["calibrated_sensor"] = [
        {
            "token": "cl",
            "sensor_token": "l",
            "translation": ego_from_lidar[:3, 3].tolist(),
            "rotation": _wxyz(Rotation.from_matrix(ego_from_lidar[:3, :3])),
        },
        {"token": "cc", "sensor_token": "c", "translation": [0, 0, 0], "rotation": [1, 0, 0, 0]},
    ]
    for n, scene in enumerate(scenes):
        tables["scene"].append({"token": f"scene{n}", "name": scene})
        for i, (pose, points) in enumerate(zip(poses, scans_of(poses), strict=True)):
            key = i % 2 == 0
            if key:
                tables["sample"].append({"token": f"s{n}-{i}", "scene_token": f"scene{n}"})
            ego = pose @ np.linalg.inv(ego_from_lidar)
            ego[0, 3] += 100 * n
            name = f"{'samples' if key else 'sweeps'}/LIDAR_TOP/{scene}__LIDAR_TOP__{i}.pcd.bin"
            write_bin(root / name, points, columns=5)
            row = {"timestamp": 1532402927647951 + 50_000 * i, "is_key_frame": key, "sample_token": f"s{n}-{i - i % 2}"}
            lidar = {**row, "token": f"d{n}-{i}", "ego_pose_token": f"e{n}-{i}", "calibrated_sensor_token": "cl"}
            camera = {**row, "token": f"x{n}-{i}", "ego_pose_token": f"e{n}-{i}", "calibrated_sensor_token": "cc"}
            # The rows of real tables are in no order of time.
            tables["sample_data"].insert(0, {**lidar, "filename": name})
            tables["sample_data"].append({**camera, "filename": f"samples/CAM_FRONT/{i}.jpg"})
            tables["ego_pose"].append(
                {
                    "token": f"e{n}-{i}",
                    "translation": ego[:3, 3].tolist(),
                    "rotation": _wxyz(Rotation.from_matrix(ego[:3, :3])),
                }
            )
    for name, table in tables.items():
        path = root / "v1.0-mini" / f"{name}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(table))


def write_balm(root: Path, poses: Array) -> None:
    """BALM: 4x4 matrices world_from_lidar whose last number is the time."""
    lines = []
    for i, (pose, points) in enumerate(zip(poses, scans_of(poses), strict=True)):
        write_pcd(root / f"full{i}.pcd", points)
        matrix = pose.copy()
        matrix[3, 3] = 1600000000.25 + 0.1 * i
        lines += [",".join(map(repr, row)) + "," for row in matrix.tolist()]
    (root / "alidarPose.csv").write_text("\n".join(lines) + "\n")


def carla_matrix(roll: float, pitch: float, yaw: float, location: list[float]) -> Array:
    """carla.Transform.get_matrix() of Unreal's left-handed frame, degrees: a positive pitch lifts x."""
    sr, sp, sy = np.sin(np.radians([roll, pitch, yaw]))
    cr, cp, cy = np.cos(np.radians([roll, pitch, yaw]))
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [cp * cy, cy * sp * sr - sy * cr, -cy * sp * cr - sy * sr],
        [cp * sy, sy * sp * sr + cy * cr, -sy * sp * cr + cy * sr],
        [sp, -cp * sr, cp * cr],
    ]
    matrix[:3, 3] = location
    return matrix


def write_carla(root: Path) -> Array:
    """CARLA: left-handed transforms and scans, frames 412 to 415 and a transform more. Returns right-handed poses."""
    mirror = np.diag([1.0, -1.0, 1.0, 1.0])
    poses, lines = [], ["frame,x,y,z,roll,pitch,yaw", "400,9,9,9,0,0,0"]
    for i in range(NUM_SCANS):
        angles, location = (1.0 + i, 2.0 * i - 1, -30.0 - 15 * i), [0.7 * i, -0.4, 1.7 + 0.1 * i]
        lines.append(",".join(map(repr, [412 + i, *location, *angles])))
        poses.append(mirror @ carla_matrix(*angles, location) @ mirror)
        seen = in_frame(poses[-1], world_points())
        write_ply(root / "lidar" / f"{412 + i:06}.ply", seen * [1, -1, 1])
    (root / "transforms.csv").write_text("\n".join(lines) + "\n")
    return np.stack(poses)
