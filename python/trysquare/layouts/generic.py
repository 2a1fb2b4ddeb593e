# SPDX-License-Identifier: Apache-2.0
"""A folder of scans and a trajectory beside it or in it, under names that are common.

    scans/, clouds/, pcs/, pcds/, pcd/, lidar/, points/, ply/, or the root itself     one file a scan
    poses.txt, poses.csv, poses.tum, trajectory.txt, traj.txt, groundtruth.txt, …     or a folder poses/ of matrices

The poses must be those of the scans' sensor in a right-handed world: nothing here says otherwise. A calib.txt beside
them is used as the command uses it. A folder called velodyne is left to the layout kitti, whose poses are a camera's.
"""

from __future__ import annotations

from ._files import LayoutFiles, NotThisLayout, Request, need_scans

SCAN_FOLDERS = ("scans", "clouds", "pcs", "pcds", "pcd", "lidar", "points", "ply", ".")
_STEMS = ("poses", "trajectory", "traj", "groundtruth", "ground_truth", "gt")
_ENDINGS = (".txt", ".csv", ".tum", ".kitti", ".g2o")


def find_generic(request: Request) -> LayoutFiles:
    """Scans and poses by their names.

    Raises:
        NotThisLayout: there are no scans, or not exactly one file of poses.
    """
    scans = need_scans(request.root, *SCAN_FOLDERS)
    files = [request.root / f"{stem}{ending}" for stem in _STEMS for ending in _ENDINGS]
    found = [path for path in files if path.is_file()]
    if (request.root / "poses").is_dir():
        found.append(request.root / "poses")
    if not found:
        raise NotThisLayout(
            f"no poses: no file {', '.join(_STEMS)} with the ending {' '.join(_ENDINGS)}, no folder poses"
        )
    if len(found) > 1:
        raise NotThisLayout(f"several poses, {', '.join(path.name for path in found)}: give one of them as `poses`")
    calib = found[0].parent / "calib.txt"
    return LayoutFiles("generic", scans, found[0], calib=calib if calib.is_file() else None)
