# SPDX-License-Identifier: Apache-2.0
"""KITTI odometry and SemanticKITTI.

    sequences/XX/velodyne/000000.bin    x y z intensity, float32, in the frame of the Velodyne
    sequences/XX/calib.txt              Tr: camera0_from_velodyne
    sequences/XX/times.txt              seconds, one a line; optional
    poses/XX.txt                        KITTI: pose of the left gray camera (camera 0) in its own first frame
    sequences/XX/poses.txt              SemanticKITTI: likewise, of its own SLAM; labels/ beside it is not read

Poses of both are of camera 0, so Tr takes them to the scanner: world_from_scan = Tr^-1 * T * Tr, the world being the
first scan. Source: Geiger, Lenz and Urtasun, CVPR 2012, and readme.txt of devkit_odometry ("poses", "calibration");
Behley et al., ICCV 2019, and the data set page of semantic-kitti.org (poses.txt in the format of KITTI).
"""

from __future__ import annotations

from pathlib import Path

from trysquare.layouts._files import (
    LayoutFiles,
    NotThisLayout,
    Request,
    absolute,
    choose,
    has_scans,
    need_file,
    need_scans,
)


def find_kitti(request: Request) -> LayoutFiles:
    """A sequence of KITTI odometry: the folder sequences/XX, or the root above `sequences`.

    Raises:
        NotThisLayout: naming what is missing.
    """
    sequence = _sequence(request)
    velodyne = need_scans(sequence, "velodyne")
    calib = need_file(sequence, "calib.txt")
    beside = sequence / "poses.txt"
    above = sequence.parent.parent / "poses" / f"{sequence.name}.txt"
    found = [request.poses] if request.poses else [path for path in (above, beside) if path.is_file()]
    if not found:
        raise NotThisLayout(f"no poses: neither {beside} nor {above}")
    warnings = []
    if found == [above, beside]:
        text = f"poses are those of {above}; {beside} is there, too: give it as `poses` to use it"
        warnings.append(("two_files_of_poses", text))
    return LayoutFiles("kitti", velodyne, found[0], "kitti", calib, warnings=warnings)


def find_semantic_kitti(request: Request) -> LayoutFiles:
    """A sequence of SemanticKITTI: the folder sequences/XX, or the root above `sequences`.

    Raises:
        NotThisLayout: naming what is missing. Unless the layout is asked for by name, a folder labels must be there.
    """
    sequence = _sequence(request)
    velodyne = need_scans(sequence, "velodyne")
    if not request.forced and not (sequence / "labels").is_dir():
        raise NotThisLayout("no folder labels")
    calib = need_file(sequence, "calib.txt")
    poses = request.poses or need_file(sequence, "poses.txt")
    return LayoutFiles("semantickitti", velodyne, poses, "kitti", calib)


def _sequence(request: Request) -> Path:
    root = absolute(request.root)
    folder = next((f for f in (root / "sequences", root / "dataset" / "sequences") if f.is_dir()), None)
    if folder is None:
        return root
    names = sorted(f.name for f in folder.iterdir() if has_scans(f / "velodyne"))
    return folder / choose("sequence", names, request)
