# SPDX-License-Identifier: Apache-2.0
"""Files of an orthogonal subset. Nothing here opens a pickle."""

from __future__ import annotations

import glob
import warnings
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from trysquare import IoError
from trysquare._arrays import as_points
from trysquare.compat.map_metrics._clouds import Array

_HOW_TO_CONVERT = (
    "a pickle runs code when it is read, so it is not; where you trust it, "
    'numpy.savez("subset.npz", *numpy.load("subset.npy", allow_pickle=True)) makes a file that is read here'
)


def read_directions(name: Path | str) -> list[Array]:
    """One (K, 3) array for each direction; IoError names the file."""
    files = [Path(name)] if Path(name).exists() else [Path(found) for found in sorted(glob.glob(str(name)))]
    if not files:
        raise IoError(f"{name}: no such file, and no file that fits this pattern")
    return [_points(direction, file) for file in files for direction in _arrays_of(file)]


def read_pose(name: Path | str) -> Array:
    """The (4, 4) matrix in the first four columns of a text file; IoError names the file."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)  # numpy only warns of an empty file
            pose: Array = np.loadtxt(str(name), usecols=range(4), ndmin=2)
    except OSError as error:
        raise IoError(f"{name}: {error.strerror or error}") from None
    except (ValueError, IndexError, UserWarning) as error:
        raise IoError(f"{name}: expected four rows of four numbers: {error}") from None
    if pose.shape != (4, 4):
        raise IoError(f"{name}: found {pose.shape[0]} rows of four numbers, expected 4")
    return pose


def _arrays_of(file: Path) -> list[Any]:
    """What a .npz holds, or the rows of a .npy of three dimensions, or its one array."""
    try:
        with file.open("rb") as stream:
            loaded = np.load(stream, allow_pickle=False)
            if isinstance(loaded, np.ndarray):
                return list(loaded) if loaded.ndim == 3 else [loaded]
            return [loaded[member] for member in loaded.files]
    except OSError as error:
        raise IoError(f"{file}: {error.strerror or error}") from None
    except (ValueError, EOFError, zipfile.BadZipFile) as error:
        is_pickle = "pickle" in str(error)
        what = f"found a pickle; {_HOW_TO_CONVERT}" if is_pickle else f"found {error}"
        raise IoError(f"{file}: expected a .npy or .npz file of numbers, {what}") from None


def _points(direction: Any, file: Path) -> Array:
    try:
        return as_points(direction, "direction")
    except ValueError as error:
        raise IoError(f"{file}: expected (K, 3) numbers for each direction: {error}") from None
