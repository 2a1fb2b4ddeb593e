# SPDX-License-Identifier: Apache-2.0
"""Files of points and poses."""

from __future__ import annotations

import dataclasses
import os
import warnings as python_warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare import _core
from trysquare._arrays import as_poses, as_stamps

PathLike = str | os.PathLike[str]


class TrysquareWarning(UserWarning):
    """Something odd about a file, such as positions that were rounded."""


@dataclasses.dataclass(frozen=True)
class Trajectory:
    """Poses of one body or sensor, in the frame of the file."""

    poses: NDArray[np.float64]  #: (M, 4, 4) world_from_body.
    stamps_ns: NDArray[np.int64] | None = None  #: (M,) [ns]; None: the format has none.
    format: str = "matrix"

    def __len__(self) -> int:
        return len(self.poses)


def warn(found: list[tuple[str, str]], stacklevel: int = 3) -> None:
    """What readers have to say, as Python's warnings."""
    for code, message in found:
        python_warnings.warn(f"{message} [{code}]", TrysquareWarning, stacklevel=stacklevel)


def read_points(path: PathLike) -> NDArray[np.float64]:
    """(N, 3) points [m] of a file, invalid returns included: KITTI .bin, .pcd.bin, PCD, PLY, XYZ, CSV, NPY.

    LAS and LAZ need laspy: pip install 'trysquare[las]'. Raises IoError naming the file and the line or byte.
    """
    from trysquare._las_files import is_las, read_las_points

    return read_las_points(path) if is_las(path) else _core.read_points(os.fspath(path))


def read_scan(path: PathLike) -> NDArray[np.float64]:
    """The same without points that measure nothing: not finite, or exactly at the origin."""
    points = read_points(path)
    measured = np.isfinite(points).all(axis=1) & points.any(axis=1)
    return points if measured.all() else points[measured]


def read_trajectory(spec: PathLike, format: str | None = None) -> Trajectory:
    """Poses of a file, or of one matrix file per pose (a folder or a quoted pattern).

    format: "tum", "kitti", "euroc", "matrix", "carla", "nclt", "mulran", "newer-college", "g2o" or "balm"; None: told
    by the content. Raises IoError naming the file and line; warns (TrysquareWarning) of what is odd.
    """
    file = _core.read_trajectory(os.fspath(spec), format)
    warn(file.warnings)
    return Trajectory(file.poses, file.stamps_ns, file.format)


def write_trajectory(path: PathLike, poses: Any, *, format: str = "kitti", stamps_ns: Any = None) -> None:
    """Writes (M, 4, 4) poses as "kitti", "tum", "euroc" or "matrix", whole or not at all.

    stamps_ns: (M,) [ns], for "tum" and "euroc"; None: those of a Trajectory, or whole seconds.
    """
    if stamps_ns is None:
        stamps_ns = getattr(poses, "stamps_ns", None)
    _core.write_trajectory(os.fspath(path), as_poses(poses, "poses"), as_stamps(stamps_ns, "stamps_ns"), format)


def read_calibration(path: PathLike) -> NDArray[np.float64]:
    """(4, 4) camera0_from_velodyne: the line Tr of a KITTI calib.txt. Raises IoError."""
    return _core.read_calibration(os.fspath(path))


def read_extrinsic(file_or_numbers: PathLike) -> NDArray[np.float64]:
    """(4, 4) body_from_sensor from a file, or from a text of 12 or 16 numbers. Raises IoError."""
    return _core.read_extrinsic(os.fspath(file_or_numbers))
