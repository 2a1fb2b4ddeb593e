# SPDX-License-Identifier: Apache-2.0
"""BALM.

    full0.pcd, full1.pcd, …     scans in the frame of the LiDAR
    alidarPose.csv              4x4 matrices world_from_lidar, four rows each; the last number is the time [s]

Scan i has the i-th matrix. Source: Liu and Zhang, "BALM: Bundle Adjustment for Lidar Mapping", RA-L 2021, and the
benchmark data of its repository (hku-mars/BALM).
"""

from __future__ import annotations

import re

from trysquare.layouts._files import LayoutFiles, NotThisLayout, Request, files_in, need_poses

_NAME = re.compile(r"full(\d+)\.pcd")


def find_balm(request: Request) -> LayoutFiles:
    """A folder of BALM.

    Raises:
        NotThisLayout: naming what is missing; a gap in the numbers is, too, as scans and matrices meet by them.
    """
    poses = need_poses(request, "alidarPose.csv")
    scans = [path for path in files_in(request.root) if _NAME.fullmatch(path.name)]
    if not scans:
        raise NotThisLayout("no files full0.pcd, full1.pcd, …")
    for expected, path in enumerate(scans):
        if path.name != f"full{expected}.pcd":
            raise NotThisLayout(f"no file full{expected}.pcd, but {path.name}")
    return LayoutFiles("balm", scans, poses, "balm")
