# SPDX-License-Identifier: Apache-2.0
"""A folder of scans and a trajectory beside it or in it, under names that are common.

    scans/, clouds/, pcs/, pcds/, pcd/, lidar/, points/, ply/, or the root itself     one file a scan
    poses.txt, poses.csv, poses.tum, trajectory.txt, traj.txt, groundtruth.txt, …     or a folder poses/ of matrices

The poses must be those of the scans' sensor in a right-handed world: nothing here says otherwise. A calib.txt beside
them is used as the command uses it. A folder called velodyne is left to the layout kitti, whose poses are a camera's.
"""

from __future__ import annotations

from pathlib import Path

from trysquare.las import las_scans
from trysquare.layouts._files import LayoutFiles, NotThisLayout, Request, need_scans

SCAN_FOLDERS = ("scans", "clouds", "pcs", "pcds", "pcd", "lidar", "points", "ply", ".")
_STEMS = ("poses", "trajectory", "traj", "groundtruth", "ground_truth", "gt")
_ENDINGS = (".txt", ".csv", ".tum", ".kitti", ".g2o")


def find_generic(request: Request) -> LayoutFiles:
    """Scans and poses by their names.

    Raises:
        NotThisLayout: there are no scans, or not exactly one file of poses.
    """
    folder = need_scans(request.root, *SCAN_FOLDERS)
    return files_of(las_scans(folder) or folder, request.poses or _poses_of(request.root))


def files_of(scans: Path | list[Path], poses: Path) -> LayoutFiles:
    """Scans and poses as they are, with the calib.txt beside the poses if there is one."""
    calib = (poses if poses.is_dir() else poses.parent) / "calib.txt"
    return LayoutFiles("generic", scans, poses, calib=calib if calib.is_file() else None)


def _poses_of(root: Path) -> Path:
    files = [root / f"{stem}{ending}" for stem in _STEMS for ending in _ENDINGS]
    found = [path for path in files if path.is_file()]
    if (root / "poses").is_dir():
        found.append(root / "poses")
    if not found:
        raise NotThisLayout(f"no poses: no folder poses, no file {', '.join(_STEMS)} ending with {' '.join(_ENDINGS)}")
    if len(found) > 1:
        raise NotThisLayout(f"several poses, {', '.join(path.name for path in found)}: give one of them as `poses`")
    return found[0]
