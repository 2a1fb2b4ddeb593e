# SPDX-License-Identifier: Apache-2.0
"""Layouts of data sets: from a root folder to its scans and to the poses of their sensor.

Whatever a data set stores, load() and open_dataset() give world_from_sensor of its scans, right-handed. Each module
says which frames its data set documents, and where.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from trysquare._core import InvalidArgument, IoError
from trysquare.layouts._files import LayoutFiles, NotThisLayout, Request, with_own_poses
from trysquare.layouts.balm import find_balm
from trysquare.layouts.carla import find_carla
from trysquare.layouts.generic import find_generic
from trysquare.layouts.kitti import find_kitti, find_semantic_kitti
from trysquare.layouts.mulran import find_mulran
from trysquare.layouts.newer_college import find_newer_college
from trysquare.layouts.nuscenes import find_nuscenes

__all__ = ["LAYOUTS", "LayoutFiles", "NotThisLayout", "Request", "find_layout"]

Layout = Callable[[Request], LayoutFiles]

LAYOUTS: dict[str, Layout] = {
    "nuscenes": find_nuscenes,
    "mulran": find_mulran,
    "newer-college": find_newer_college,
    "balm": find_balm,
    "semantickitti": find_semantic_kitti,
    "kitti": find_kitti,
    "carla": find_carla,
    "generic": find_generic,
}
"""By name, in the order in which they are tried. No root that one recognises is another's, but for generic's."""


def find_layout(
    root: str | os.PathLike[str], layout: str = "auto", poses: str | os.PathLike[str] | None = None
) -> LayoutFiles:
    """The scans and poses below a root folder.

    Args:
        root: folder of the data set, or of one sequence.
        layout: "auto", or a name of LAYOUTS. A colon and a name or an index choose a sequence or a scene where there
            are several: "kitti:00", "nuscenes:scene-0061", "auto:3".
        poses: a trajectory of the sensor to use in the place of that of the data set, whose extrinsic is then not.

    Raises:
        InvalidArgument: there is no layout of that name.
        IoError: no such folder; or it is not laid out so: the message says which layouts were tried, and what each
            missed.
    """
    name, _, choice = layout.partition(":")
    if name != "auto" and name not in LAYOUTS:
        raise InvalidArgument(f'layout = "{layout}" is unknown, expected auto, {", ".join(LAYOUTS)}')
    folder = Path(root)
    if not folder.is_dir():
        raise IoError(f"{folder}: no such folder")
    tried = list(LAYOUTS) if name == "auto" else [name]
    request = Request(folder, choice or None, name != "auto", None if poses is None else Path(poses))
    missed = []
    for candidate in tried:
        try:
            files = LAYOUTS[candidate](request)
        except NotThisLayout as reason:
            missed.append(f"{candidate}: {reason}")
            continue
        return files if poses is None or candidate == "generic" else with_own_poses(files)
    if name != "auto":
        raise IoError(f"{folder}: not laid out as {missed[0]}")
    raise IoError(f"{folder}: no data set layout fits:\n  " + "\n  ".join(missed))
