# SPDX-License-Identifier: Apache-2.0
"""What a data set layout finds below a root folder, and the errors that say what it missed."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

POINT_ENDINGS = (".bin", ".pcd", ".ply", ".npy", ".xyz", ".las", ".laz")
"""File name endings of scans. Text files are no part of it: they may be anything."""


class NotThisLayout(Exception):
    """The root lacks what a layout needs. The text names the missing file or folder."""


@dataclass(frozen=True)
class Request:
    """A root folder, and how it is to be looked at."""

    root: Path
    choice: str | None = None
    """The sequence or scene below the root, where there are several: what follows the colon of `layout`."""
    forced: bool = False
    """The user named the layout, so optional marks of it need not be there."""
    poses: Path | None = None
    """Given by the user: those of the data set need not be there."""


@dataclass(frozen=True)
class LayoutFiles:
    """The scans and poses of a data set.

    Either `scans` is a folder, and folder, poses, calibration and extrinsic are what the command would be given; or it
    is a list of files, with the time stamps and poses that belong to them.
    """

    layout: str
    """Name of the layout, a key of LAYOUTS."""
    scans: Path | list[Path]
    """Folder of scans, or the scans one by one, in order."""
    poses: Path | NDArray[np.float64] | None
    """Trajectory (a file, or a folder of matrices), or world_from_sensor of each of the listed scans, (M, 4, 4)."""
    poses_format: str = "auto"
    calib: Path | None = None
    """KITTI calib.txt whose Tr leads from the camera of the poses to the scanner."""
    extrinsic: NDArray[np.float64] | None = None
    """body_from_sensor, (4, 4), as the data set documents it. None: the poses are the sensor's, or see calib."""
    extrinsic_source: str | None = None
    left_handed: bool = False
    stamps_ns: NDArray[np.int64] | None = None
    """Of the listed scans, (M,). None: of a folder they are read from times.txt or the names, as the command does."""
    warnings: list[tuple[str, str]] = field(default_factory=list)
    """Codes and texts."""

    @property
    def poses_name(self) -> str:
        """What messages and reports call the poses."""
        return self.layout if isinstance(self.poses, np.ndarray) else str(self.poses)


def with_own_poses(files: LayoutFiles) -> LayoutFiles:
    """Without what belongs to the poses of the data set: format, extrinsic and calibration."""
    return replace(files, poses_format="auto", calib=None, extrinsic=None, extrinsic_source=None)


def natural_key(path: Path) -> tuple[tuple[int, int | str], ...]:
    """Sort key of a path by its name in which numbers count as numbers: scan2 before scan10."""
    return tuple((0, int(part)) if part.isdigit() else (1, part) for part in re.split(r"(\d+)", path.name) if part)


def files_in(folder: Path) -> list[Path]:
    """The files of a folder in natural order, without hidden ones."""
    return sorted((p for p in folder.iterdir() if p.is_file() and not p.name.startswith(".")), key=natural_key)


def has_scans(folder: Path) -> bool:
    """Whether a folder holds at least one file that ends as a scan does."""
    return folder.is_dir() and any(p.name.lower().endswith(POINT_ENDINGS) for p in files_in(folder))


def absolute(path: Path) -> Path:
    """A path whose parents can be asked for; links stay as they are."""
    return Path(os.path.abspath(path))


def need_file(root: Path, *names: str) -> Path:
    """The first of these files below a root that is there.

    Raises:
        NotThisLayout: none is.
    """
    for name in names:
        if (root / name).is_file():
            return root / name
    raise NotThisLayout(f"no file {_alternatives(names)}")


def need_poses(request: Request, *names: str) -> Path:
    """The poses that the user gave, or the first of these files below the root that is there.

    Raises:
        NotThisLayout: none is.
    """
    return request.poses or need_file(request.root, *names)


def need_scans(root: Path, *names: str) -> Path:
    """The first of these folders below a root that holds scans.

    Raises:
        NotThisLayout: none does.
    """
    for name in names:
        if has_scans(root / name):
            return root / name
    raise NotThisLayout(f"no folder {_alternatives(names)} with scans in it")


def choose(kind: str, names: Sequence[str], request: Request) -> str:
    """One of several sequences or scenes: the chosen one, by name or by index from 0, or the only one.

    Raises:
        NotThisLayout: there is none, the choice is not among them, or there are several and none was chosen.
    """
    if not names:
        raise NotThisLayout(f"no {kind} in it")
    choice = request.choice
    if choice is None:
        if len(names) == 1:
            return names[0]
        raise NotThisLayout(f"it holds {len(names)} {kind}s and none was chosen ({_first(names)})")
    if choice in names:
        return choice
    if choice.isdecimal() and int(choice) < len(names):
        return names[int(choice)]
    raise NotThisLayout(f"no {kind} {choice} among {len(names)} ({_first(names)})")


def _alternatives(names: Iterable[str]) -> str:
    return " or ".join("in the root itself" if name == "." else name for name in names)


def _first(names: Sequence[str], count: int = 5) -> str:
    shown = ", ".join(names[:count])
    return shown if len(names) <= count else f"{shown}, …"
