# SPDX-License-Identifier: Apache-2.0
"""Scans that come one by one, and the poses that belong to them: by time, or in order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from trysquare import _core
from trysquare._core import InvalidArgument, IoError
from trysquare._las_files import is_las, read_las_points
from trysquare.layouts._files import LayoutFiles

Load = Callable[[int], NDArray[np.float64]]

_MIRROR = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True)
class PairedScans:
    """Scans that are loaded when asked for, and the pose of each."""

    names: list[str]
    load: Load
    """Index to (N, 3) points as stored, invalid returns included, in the frame of the sensor, metres."""
    poses: NDArray[np.float64]
    """world_from_sensor, (M, 4, 4)."""
    stamps_ns: NDArray[np.int64] | None
    poses_format: str
    layout: str
    extrinsic: NDArray[np.float64] | None = None
    extrinsic_source: str | None = None
    warnings: list[tuple[str, str]] = field(default_factory=list)

    def selected(self, first: int, last: int | None, every: int) -> PairedScans:
        """Every n-th of the scans from `first` to `last`, which is inclusive.

        Raises:
            InvalidArgument: the selection is empty or reaches beyond the scans.
        """
        chosen = selection(len(self.names), first, last, every)
        load, stamps = self.load, self.stamps_ns
        return replace(
            self,
            names=[self.names[i] for i in chosen],
            load=lambda i: load(chosen[i]),
            poses=self.poses[chosen],
            stamps_ns=None if stamps is None else stamps[chosen],
        )


def selection(count: int, first: int, last: int | None, every: int) -> range:
    """The indices that first, last (inclusive) and every select of `count` scans.

    Raises:
        InvalidArgument: likewise as the command says it.
    """
    if every < 1:
        raise InvalidArgument(f"every = {every} is out of range: it must be at least 1")
    end = count - 1 if last is None else last
    if first < 0 or first > end or end >= count:
        raise InvalidArgument(
            f"first = {first} and last = {end} select no range of the {count} scans (0 to {count - 1})"
        )
    return range(first, end + 1, every)


def pair_by_time(
    scans_ns: NDArray[np.int64], poses_ns: NDArray[np.int64], t_max_diff_s: float, poses_name: str
) -> tuple[NDArray[np.intp], NDArray[np.intp], list[tuple[str, str]]]:
    """Which scans have a pose within `t_max_diff_s` of their time, and the nearest pose of each.

    Returns:
        indices of scans, as many indices of poses, and warnings.

    Raises:
        IoError: no scan has one.
    """
    nearest = _core.nearest_in_time(scans_ns, poses_ns, t_max_diff_s)
    scans = np.flatnonzero(nearest >= 0)
    if not scans.size:
        raise IoError(f"{poses_name}: no pose lies within {t_max_diff_s:g} s of a scan, see t_max_diff_s")
    warnings: list[tuple[str, str]] = []
    if scans.size < scans_ns.size:
        warnings.append(
            (
                "scans_without_pose",
                f"{poses_name}: {scans_ns.size - scans.size} of {scans_ns.size} scans have no pose within "
                f"{t_max_diff_s:g} s of their time and are left out",
            )
        )
    return scans, nearest[scans], warnings


def pair(files: LayoutFiles, options: _core.InputOptions) -> PairedScans:
    """Poses of the sensor for the listed scans of a layout, and the selection that the options make.

    Raises:
        IoError: the poses cannot be read, or do not fit the scans.
        InvalidArgument: the selection is empty.
    """
    matched = _matched(files, options)
    poses, extrinsic, source = sensor_poses(matched.poses, files, options)
    load = matched.load
    if options.left_handed:
        poses, load = mirrored(poses), lambda i: matched.load(i) * _MIRROR
        extrinsic = None if extrinsic is None else mirrored(extrinsic)
    paired = replace(matched, load=load, poses=poses, extrinsic=extrinsic, extrinsic_source=source)
    return paired.selected(options.first, options.last, options.every)


def _matched(files: LayoutFiles, options: _core.InputOptions) -> PairedScans:
    """The scans that have a pose, with the poses as they are stored: by time where both sides have it, or in order."""
    paths, stamps = list(files.scans) if isinstance(files.scans, list) else [files.scans], files.stamps_ns
    warnings, poses_format = list(files.warnings), files.poses_format
    if isinstance(files.poses, np.ndarray):
        poses = files.poses
    else:
        file = _core.read_trajectory(str(files.poses), options.poses_format if poses_format == "auto" else poses_format)
        poses, poses_format = file.poses, file.format
        warnings += file.warnings
        if stamps is None:
            stamps = file.stamps_ns
        elif file.stamps_ns is not None:
            scans, nearest, more = pair_by_time(stamps, file.stamps_ns, options.t_max_diff_s, files.poses_name)
            paths, stamps, poses = [paths[i] for i in scans], stamps[scans], poses[nearest]
            warnings += more
    if len(poses) != len(paths):
        raise IoError(
            f"{files.poses_name}: {len(poses)} poses for the {len(paths)} scans of {paths[0].parent}: "
            "expected one per scan"
        )
    names = [str(path) for path in paths]
    return PairedScans(
        names, lambda i: _read_points(names[i]), poses, stamps, poses_format, files.layout, None, None, warnings
    )


def sensor_poses(
    poses: NDArray[np.float64], files: LayoutFiles, options: _core.InputOptions
) -> tuple[NDArray[np.float64], NDArray[np.float64] | None, str | None]:
    """world_from_sensor, and the extrinsic that is in it: the one that was asked for, or else the layout's."""
    if options.extrinsic:
        extrinsic = _core.read_extrinsic(options.extrinsic)
        return poses @ extrinsic, extrinsic, options.extrinsic
    calib = options.calib or ("" if options.no_calib or files.calib is None else str(files.calib))
    if calib:  # the world of KITTI is the first frame of the camera, and becomes that of the scanner
        extrinsic = _core.read_calibration(calib)
        return np.linalg.inv(extrinsic) @ poses @ extrinsic, extrinsic, f"{Path(calib).name}:Tr"
    if files.extrinsic is not None:
        return poses @ files.extrinsic, files.extrinsic, files.extrinsic_source
    return poses, None, files.extrinsic_source


def mirrored(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """From left-handed frames to right-handed ones with y negated, or back."""
    sides = np.append(_MIRROR, 1.0)
    return poses * np.outer(sides, sides)


def _read_points(path: str) -> NDArray[np.float64]:
    return read_las_points(path) if is_las(path) else _core.read_points(path)
