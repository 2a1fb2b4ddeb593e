# SPDX-License-Identifier: Apache-2.0
"""From what a layout found to a data set."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from trysquare._dataset import Dataset, DatasetFacts
from trysquare._io import warn

from trysquare import _core
from trysquare.layouts._files import LayoutFiles, with_own_poses
from trysquare.layouts._pairing import PairedScans, pair


def fill_options(options: _core.InputOptions, files: LayoutFiles) -> None:
    """Tells the command's logic where a layout's folder of scans and its poses are. What was asked for stays."""
    options.scans = os.fspath(files.scans)  # type: ignore[arg-type]
    options.poses = os.fspath(files.poses)  # type: ignore[arg-type]
    if files.poses_format != "auto":
        options.poses_format = files.poses_format
    given = options.extrinsic or options.calib
    if not given and files.calib is not None and not options.no_calib:
        options.calib = os.fspath(files.calib)
    if not given and files.extrinsic is not None:
        options.extrinsic = " ".join(repr(float(number)) for number in files.extrinsic.ravel())


def open_listed(files: LayoutFiles, options: _core.InputOptions) -> Dataset:
    """A data set of a layout that lists its scans, with the selection, the extrinsic and the reference of the options.

    Raises:
        IoError: something cannot be read, or the reference has poses for other scans.
        InvalidArgument: the selection is empty.
    """
    paired = pair(files, options)
    reference = None
    if options.reference:
        paired_reference = pair(with_own_poses(replace(files, poses=Path(options.reference))), options)
        if paired_reference.names != paired.names:
            raise _core.IoError(f"{options.reference}: the reference has poses for other scans than {files.poses_name}")
        reference = paired_reference.poses
    left_handed = options.left_handed or files.left_handed
    return replace(dataset_of(paired, options.scans, files.poses_name, left_handed), reference=reference)


def dataset_of(paired: PairedScans, scans: str, poses: str, left_handed: bool = False) -> Dataset:
    """A data set of scans that are loaded one by one. `scans` and `poses` are what reports call them.

    Warns (TrysquareWarning) of what is odd, in the name of the caller's caller.
    """
    warn(paired.warnings, stacklevel=4)
    return Dataset(
        scans=_core.python_scans(len(paired.names), paired.load),
        poses=paired.poses,
        names=paired.names,
        facts=DatasetFacts(
            scans=scans,
            poses=poses,
            poses_format=paired.poses_format,
            extrinsic_source=paired.extrinsic_source,
            left_handed=left_handed,
            layout=paired.layout,
            warnings=paired.warnings,
        ),
        stamps_ns=paired.stamps_ns,
        extrinsic=paired.extrinsic,
    )
