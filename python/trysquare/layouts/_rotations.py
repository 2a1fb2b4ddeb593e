# SPDX-License-Identifier: Apache-2.0
"""Poses as data sets write them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray


def pose_from_rpy(translation: Sequence[float], rpy_deg: Sequence[float]) -> NDArray[np.float64]:
    """(4, 4) with the rotation Rz(yaw) * Ry(pitch) * Rx(roll), angles in degrees, translation in metres."""
    roll, pitch, yaw = np.radians(rpy_deg)
    (sr, cr), (sp, cp), (sy, cy) = ((np.sin(a), np.cos(a)) for a in (roll, pitch, yaw))
    pose = np.eye(4)
    pose[:3, :3] = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    pose[:3, 3] = translation
    return pose


def pose_from_quaternion(translation: Sequence[float], wxyz: Sequence[float]) -> NDArray[np.float64]:
    """(4, 4) from a translation in metres and a quaternion, w first.

    Raises:
        ValueError: not three and four finite numbers, or |q| differs from 1 by more than 0.02, as in the C++ library.
    """
    t, q = np.asarray(translation, dtype=float), np.asarray(wxyz, dtype=float)
    if t.shape != (3,) or q.shape != (4,) or not (np.isfinite(t).all() and np.isfinite(q).all()):
        raise ValueError(f"translation {translation} and quaternion {wxyz}: expected 3 and 4 finite numbers")
    norm = float(np.sqrt(q @ q))
    if abs(norm - 1) > 0.02:
        raise ValueError(f"the quaternion {wxyz} has the norm {norm:.6g}, expected 1")
    w, x, y, z = q * (np.sqrt(2.0) / norm)
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - y * y - z * z, x * y - z * w, x * z + y * w],
        [x * y + z * w, 1 - x * x - z * z, y * z - x * w],
        [x * z - y * w, y * z + x * w, 1 - x * x - y * y],
    ]
    pose[:3, 3] = t
    return pose
