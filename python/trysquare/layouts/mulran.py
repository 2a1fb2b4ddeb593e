# SPDX-License-Identifier: Apache-2.0
"""MulRan.

    Ouster/1561000444390857630.bin      x y z intensity, float32; the name is the time [ns]; also below sensor_data/
    global_pose.csv                     time [ns] and the 3x4 matrix of the car's base in UTM, 100 a second

The Ouster sits on the base as calib_base2ouster.txt of the data set says: translation 1.7042 -0.021 1.8047 m, roll,
pitch and yaw 0.0001 0.0003 179.6654 degrees about fixed axes, so it looks backwards. Source: Kim et al., "MulRan:
Multimodal Range Dataset for Urban Place Recognition", ICRA 2020, and the calibration file that comes with it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from trysquare.layouts._files import LayoutFiles, Request, need_poses, need_scans
from trysquare.layouts._rotations import pose_from_rpy

BASE_FROM_OUSTER: NDArray[np.float64] = pose_from_rpy((1.7042, -0.021, 1.8047), (0.0001, 0.0003, 179.6654))
"""base_from_sensor, (4, 4), metres."""


def find_mulran(request: Request) -> LayoutFiles:
    """A sequence of MulRan: the folder that holds global_pose.csv.

    Raises:
        NotThisLayout: naming what is missing.
    """
    poses = need_poses(request, "global_pose.csv")
    scans = need_scans(request.root, "Ouster", "sensor_data/Ouster")
    return LayoutFiles(
        "mulran", scans, poses, "mulran", extrinsic=BASE_FROM_OUSTER, extrinsic_source="MulRan:calib_base2ouster"
    )
