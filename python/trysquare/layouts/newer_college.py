# SPDX-License-Identifier: Apache-2.0
"""Newer College, the stereo camera and Ouster OS1-64 collection of 2020.

    raw_format/ouster_scan/cloud_1583836591_182590976.pcd    the name is the time: seconds, nanoseconds
    ground_truth/registered_poses.csv                        sec,nsec,x,y,z,qx,qy,qz,qw

Poses are of the frame `base`, which is the left camera's body frame (x forward, z up); the scans are in os_lidar. The
robot description gives base_from_os_lidar: translation -0.084 -0.025 0.050 m, yaw 135 degrees. Source: Ramezani et al.,
"The Newer College Dataset: Handheld LiDAR, Inertial and Vision with Ground Truth", IROS 2020, and its page on the
platform. The collection of 2021 comes as bags and has another mount: read_bag, with its extrinsic.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from trysquare.layouts._files import LayoutFiles, NotThisLayout, Request, files_in, need_poses
from trysquare.layouts._rotations import pose_from_rpy

BASE_FROM_OS_LIDAR: NDArray[np.float64] = pose_from_rpy((-0.084, -0.025, 0.050), (0.0, 0.0, 135.0))
"""base_from_sensor, (4, 4), metres."""

_FOLDERS = ("raw_format/ouster_scan", "raw_format/ouster_zip_files/ouster_scan", "ouster_scan", ".")
_NAME = re.compile(r"cloud_(\d+)_(\d{1,9})\.(pcd|ply|npy|bin)")


def find_newer_college(request: Request) -> LayoutFiles:
    """An experiment of Newer College: the folder above raw_format and ground_truth.

    Raises:
        NotThisLayout: naming what is missing.
    """
    for name in _FOLDERS:
        stamped = _stamped_clouds(request.root / name)
        if stamped:
            break
    else:
        raise NotThisLayout(f"no files cloud_SEC_NSEC.pcd in {', '.join(_FOLDERS[:-1])} or the root itself")
    poses = need_poses(request, "ground_truth/registered_poses.csv", "registered_poses.csv")
    stamps = np.array([stamp for stamp, _ in stamped], dtype=np.int64)
    return LayoutFiles(
        "newer-college",
        [path for _, path in stamped],
        poses,
        "newer-college",
        extrinsic=BASE_FROM_OS_LIDAR,
        extrinsic_source="Newer College:base_from_os_lidar",
        stamps_ns=stamps,
    )


def _stamped_clouds(folder: Path) -> list[tuple[int, Path]]:
    """Time [ns] and path of the clouds in a folder, by time. The nanoseconds are printed without leading zeros."""
    if not folder.is_dir():
        return []
    named = [(_NAME.fullmatch(path.name), path) for path in files_in(folder)]
    return sorted((int(m[1]) * 1_000_000_000 + int(m[2]), path) for m, path in named if m)
