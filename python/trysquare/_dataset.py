# SPDX-License-Identifier: Apache-2.0
"""Scans and their poses from files, paired as the command pairs them."""

from __future__ import annotations

import dataclasses
import operator
import os
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare import _core
from trysquare._arrays import as_matrix, as_scans
from trysquare._io import PathLike, TrysquareWarning, warn
from trysquare._settings import set_given

__all__ = ["Dataset", "DatasetFacts", "TrysquareWarning", "load", "open_dataset"]


@dataclasses.dataclass(frozen=True)
class DatasetFacts:
    """Where a data set came from, for reports."""

    scans: str
    poses: str | None = None
    poses_format: str | None = None
    extrinsic_source: str | None = None
    left_handed: bool = False
    reference: str | None = None
    reference_extrinsic: str | None = None
    layout: str = "generic"
    warnings: list[tuple[str, str]] = dataclasses.field(default_factory=list)


@dataclasses.dataclass(frozen=True, eq=False)
class Dataset:
    """N scans, which stay where they are until one is asked for, and their poses.

    Can be given to evaluate(), compare(), refine() and diagnose() in the place of scans.
    """

    scans: Any = dataclasses.field(repr=False)  #: Scans of the library, or any sequence of (K, 3) arrays.
    poses: NDArray[np.float64] = dataclasses.field(repr=False)  #: (N, 4, 4) world_from_scan, right-handed.
    names: list[str] = dataclasses.field(repr=False)
    facts: DatasetFacts
    stamps_ns: NDArray[np.int64] | None = dataclasses.field(default=None, repr=False)  #: (N,) of the poses.
    extrinsic: NDArray[np.float64] | None = None  #: (4, 4) body_from_sensor that is part of the poses.
    reference: NDArray[np.float64] | None = dataclasses.field(default=None, repr=False)  #: (N, 4, 4) true poses.
    all_poses: NDArray[np.float64] | None = dataclasses.field(default=None, repr=False)  #: Also those of no scan.
    all_stamps_ns: NDArray[np.int64] | None = dataclasses.field(default=None, repr=False)

    @property
    def native_scans(self) -> _core.Scans:
        """The scans as the library takes them."""
        return self.scans if isinstance(self.scans, _core.Scans) else as_scans(self.scans)

    def __len__(self) -> int:
        return len(self.names)

    def load(self, index: int) -> NDArray[np.float64]:
        """(K, 3) points [m] of one scan in its own frame, without invalid returns. Raises IndexError, IoError."""
        position = index + len(self) if index < 0 else index
        if not 0 <= position < len(self):
            raise IndexError(f"scan {index} of {len(self)}")
        return self.native_scans.load(position)

    def __getitem__(self, index: int) -> NDArray[np.float64]:
        try:
            return self.load(operator.index(index))
        except TypeError as error:
            raise TypeError(f"the index of a scan is a whole number, not {type(index).__name__}") from error

    def __iter__(self) -> Iterator[NDArray[np.float64]]:
        return (self.load(i) for i in range(len(self)))


def open_dataset(
    scans: PathLike,
    poses: PathLike | None = None,
    *,
    first: int = 0,
    last: int | None = None,
    every: int = 1,
    layout: str = "auto",
    poses_format: str | None = None,
    calib: PathLike | None = None,
    use_calib: bool = True,
    extrinsic: Any = None,
    left_handed: bool | None = None,
    t_max_diff_s: float | None = None,
    reference: PathLike | None = None,
) -> Dataset:
    """Scans and poses of a data set; scans are read when they are asked for.

    scans: a folder or quoted pattern, one file per scan; or the root of a data set whose layout is known.
    poses: a file, or a folder or pattern with one matrix per scan; None: those of the layout.
    first, last, every: select scans, `last` inclusive.
    layout: "auto" or a name of trysquare.layouts.LAYOUTS; a colon and a name or index choose a sequence or scene where
        there are several: "kitti:00", "nuscenes:scene-0061". Poses that are given with a layout are of the sensor.
    poses_format: as in read_trajectory(); None: told by the content.
    calib, use_calib: KITTI's calib.txt; one beside the poses is used unless use_calib is False.
    extrinsic: body_from_sensor: (4, 4), a file, or 12 or 16 numbers.
    left_handed: points, poses and extrinsic are (CARLA): y is negated. None: as the layout is.
    t_max_diff_s: where both have time stamps, a scan takes the nearest pose within this [s].
    reference: true poses of the same scans.

    Raises IoError naming the file, InvalidArgument naming the argument; warns (TrysquareWarning) of what is odd.
    """
    given = {"poses_format": poses_format, "left_handed": left_handed, "t_max_diff_s": t_max_diff_s}
    options = set_given(_core.InputOptions(), first=first, last=last, every=every, **given)
    options.scans = os.fspath(scans)
    options.poses = "" if poses is None else os.fspath(poses)
    options.reference = "" if reference is None else os.fspath(reference)
    options.calib = "" if calib is None else os.fspath(calib)
    options.no_calib = not use_calib
    if extrinsic is not None:
        options.extrinsic = extrinsic_text(extrinsic)
    from trysquare.layouts._open import open_layout  # it needs Dataset

    dataset = open_layout(scans, poses, layout, options, left_handed)
    return open_generic(options) if dataset is None else dataset


def extrinsic_text(extrinsic: Any) -> str:
    """What the library reads: a path, or 16 numbers."""
    if isinstance(extrinsic, (str, os.PathLike)):
        return os.fspath(extrinsic)
    return " ".join(repr(float(number)) for number in as_matrix(extrinsic, "extrinsic").ravel())


def open_generic(options: _core.InputOptions, more_warnings: Sequence[tuple[str, str]] = ()) -> Dataset:
    """Scans and poses as the command reads them. Warns in the name of the caller's caller."""
    inputs = _core.load_inputs(options)
    warnings = [*more_warnings, *inputs.warnings]
    warn(warnings, stacklevel=4)
    scans = inputs.scans
    facts = DatasetFacts(
        scans=options.scans,
        poses=options.poses,
        poses_format=inputs.poses_format,
        extrinsic_source=inputs.extrinsic_source,
        left_handed=options.left_handed,
        reference=options.reference or None,
        reference_extrinsic=inputs.reference_extrinsic_source,
        warnings=warnings,
    )
    has_stamps = inputs.all_stamps_ns is not None
    return Dataset(
        scans=scans,
        poses=inputs.poses,
        names=[scans.name(i) for i in range(len(scans))],
        facts=facts,
        stamps_ns=inputs.stamps_ns,
        extrinsic=inputs.extrinsic,
        reference=inputs.reference,
        all_poses=inputs.all_poses if has_stamps else None,
        all_stamps_ns=inputs.all_stamps_ns,
    )


def load(scans: PathLike, poses: PathLike | None = None, **options: Any) -> tuple[list[Any], NDArray[np.float64]]:
    """All scans of a data set in memory: a list of (K, 3) arrays [m], and their (N, 4, 4) poses world_from_scan.

    Arguments and errors: as open_dataset(), which leaves the scans in their files.
    """
    dataset = open_dataset(scans, poses, **options)
    return list(dataset), dataset.poses
