# SPDX-License-Identifier: Apache-2.0
"""Point clouds of several kinds as arrays, and the cloud that `aggregate_map` gives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from trysquare import _core
from trysquare._arrays import as_matrix, as_points

__all__ = ["PointCloud"]

Array = npt.NDArray[np.float64]
Many = Sequence[Any] | npt.NDArray[Any]  # clouds, poses, or directions


class PointCloud:
    """Points and nothing else, under the name that Open3D gives them.

    `numpy.asarray(cloud)` and `cloud.points` are the same (N, 3) float64 array [m]. For a cloud of Open3D:
    `open3d.geometry.PointCloud(open3d.utility.Vector3dVector(cloud.points))`.
    """

    def __init__(self, points: Array) -> None:
        self.points = points

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        return np.array(self.points, dtype=dtype) if copy else np.asarray(self.points, dtype=dtype)

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        return f"PointCloud with {len(self)} points"


def points_of(cloud: Any, name: str) -> Array:
    """(N, 3) float64 [m] of an Open3D cloud of either kind, or of anything that numpy takes; N may be 0.

    InvalidArgument (a ValueError) with `name`.
    """
    points: Array = as_points(cloud, name, allow_empty=True)
    return points


def normals_of(cloud: Any, name: str) -> Array | None:
    """(N, 3) float64 normals that a cloud of Open3D carries, as they are; None when it carries none."""
    tensors = getattr(cloud, "point", None)
    if tensors is not None and "normals" in tensors:
        return points_of(tensors["normals"].numpy(), name)
    has_normals = getattr(cloud, "has_normals", None)
    return points_of(cloud.normals, name) if has_normals is not None and has_normals() else None


def map_from_scan(ts: Many) -> list[Array]:
    """(4, 4) poses relative to the first one. InvalidArgument naming the one that is none."""
    poses = [_as_pose(pose, f"ts[{i}]") for i, pose in enumerate(ts)]
    if not poses:
        raise _core.InvalidArgument("ts: found no pose, expected one (4, 4) matrix for each point cloud")
    return [np.linalg.inv(poses[0]) @ pose for pose in poses]  # the general inverse: poses are orthonormal to 1e-7 only


def moved(pose: Array, points: Array, out: Array | None = None) -> Array:
    """The points (N, 3) in the frame that `pose` (4, 4) leads to; in `out` if it is given."""
    # Not @: the threads of the matrix product wait for each other where other programs run.
    result: Array = np.einsum("ij,kj->ik", points, pose[:3, :3], out=out)
    result += pose[:3, 3]
    return result


def _as_pose(value: Any, name: str) -> Array:
    pose: Array = as_matrix(value, name)
    if not np.isfinite(pose).all() or np.linalg.matrix_rank(pose) < 4:
        raise _core.InvalidArgument(f"{name}: expected a finite matrix that has an inverse")
    return pose
