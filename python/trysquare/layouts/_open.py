# SPDX-License-Identifier: Apache-2.0
"""From what a layout found to a data set."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from trysquare import _core
from trysquare._dataset import Dataset, DatasetFacts, open_generic
from trysquare._io import PathLike, warn
from trysquare.las import las_scans
from trysquare.layouts import find_layout
from trysquare.layouts._files import LayoutFiles, with_own_poses
from trysquare.layouts._pairing import PairedScans, pair
from trysquare.layouts.generic import files_of


def open_layout(
    scans: PathLike,
    poses: PathLike | None,
    layout: str,
    options: _core.InputOptions,
    left_handed: bool | None = None,
) -> Dataset | None:
    """A data set by its layout, with the selection and whatever else the options ask for.

    left_handed: None: as the layout is.

    Returns:
        None where scans and poses are what the command takes, and no layout is needed.

    Raises:
        IoError: no layout fits, or something cannot be read.
        InvalidArgument: the layout is unknown, or the selection is empty.
    """
    if poses is None or layout not in ("auto", "generic"):
        files = find_layout(scans, layout, poses)
    else:
        listed = las_scans(scans)
        if listed is None:
            return None
        files = files_of(listed, Path(poses))
    if left_handed is None:
        options.left_handed = files.left_handed
    if isinstance(files.scans, Path):
        source = _fill(options, files, files.scans)
        dataset = open_generic(options, files.warnings)
        facts = replace(dataset.facts, layout=files.layout)
        return replace(dataset, facts=facts if source is None else replace(facts, extrinsic_source=source))
    return open_listed(files, options)


def _fill(options: _core.InputOptions, files: LayoutFiles, folder: Path) -> str | None:
    """Tells the command's logic where scans, poses and calibration are; what was asked for stays.

    Returns:
        what the extrinsic is called, where it is the layout's.
    """
    options.scans, options.poses = str(folder), str(files.poses)
    if files.poses_format != "auto":
        options.poses_format = files.poses_format
    if options.extrinsic or options.calib:
        return None
    if files.calib is not None and not options.no_calib:
        options.calib = str(files.calib)
    if files.extrinsic is None:
        return None
    options.extrinsic = " ".join(repr(float(number)) for number in files.extrinsic.ravel())
    return files.extrinsic_source


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
    dataset = dataset_of(paired, options.scans, files.poses_name, options.left_handed)
    facts = replace(dataset.facts, reference=options.reference or None)
    return replace(dataset, reference=reference, facts=facts)


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
