# SPDX-License-Identifier: Apache-2.0
"""CARLA, as docs/user/carla.md describes its recordings.

    lidar/000412.ply                one PLY a frame, the number of the frame last in its name; also in the root itself
    transforms.csv or .json         the transforms of the LiDAR, by frame number

World, scans and transforms are left-handed (x forward, y right, z up; locations in metres, rotations in degrees): y of
all of them is negated. Scans and transforms meet by the number of the frame. Source: documentation of CARLA 0.9, pages
"Python API" (carla.Transform, carla.Rotation) and "Sensors reference" (sensor.lidar.ray_cast).
"""

from __future__ import annotations

from trysquare.layouts._files import LayoutFiles, NotThisLayout, Request, files_in, need_poses, need_scans


def find_carla(request: Request) -> LayoutFiles:
    """A recording of CARLA.

    Raises:
        NotThisLayout: naming what is missing.
    """
    poses = need_poses(request, "transforms.csv", "transforms.json")
    scans = need_scans(request.root, "lidar", ".")
    if not any(path.name.lower().endswith(".ply") for path in files_in(scans)):
        raise NotThisLayout(f"no PLY files in {scans.name}")
    return LayoutFiles("carla", scans, poses, "carla", left_handed=True)
