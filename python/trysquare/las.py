# SPDX-License-Identifier: Apache-2.0
"""LAS and LAZ files: pip install trysquare[las]."""

from __future__ import annotations

import glob
import os
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from trysquare._core import InvalidArgument, IoError
from trysquare._las_files import is_las

if TYPE_CHECKING:
    import laspy

_CHUNK = 1_000_000


def read_las(
    path: str | os.PathLike[str],
    *,
    classifications: Collection[int] | None = None,
    returns: str = "all",
    origin: ArrayLike | None = None,
) -> NDArray[np.float64]:
    """Points of a LAS or LAZ file, (N, 3), in the units and frame of the file: scale * stored integer + offset.

    Doubles hold UTM coordinates to a nanometre, and all of this library works in doubles. `origin` is for what does
    not: it is taken off the offset before anything is rounded.

    Args:
        classifications: keep points of these classes only (2 is ground). None: all.
        returns: "all", "first" or "last" of each pulse.
        origin: (3,) subtracted from every point. None: nothing.

    Raises:
        ImportError: laspy is not installed, or for LAZ lazrs is not.
        InvalidArgument: `returns` or `origin` is no such thing.
        IoError: the file is missing, malformed or truncated; the message names it.

    Source: ASPRS, LAS Specification 1.4-R15.
    """
    if returns not in ("all", "first", "last"):
        raise InvalidArgument(f'returns = "{returns}" is unknown, expected all, first or last')
    shift = np.zeros(3) if origin is None else np.asarray(origin, dtype=float)
    if shift.shape != (3,) or not np.isfinite(shift).all():
        raise InvalidArgument(f"origin has the shape {shift.shape}, expected 3 finite numbers")
    chunks = []
    num_read = 0
    with _opened(path) as reader:
        header = reader.header
        scales, offsets = np.asarray(header.scales), np.asarray(header.offsets) - shift
        try:
            for chunk in reader.chunk_iterator(_CHUNK):
                num_read += len(chunk)
                kept = _kept(chunk, classifications, returns)
                chunks.append(np.stack([chunk.X, chunk.Y, chunk.Z], axis=1)[kept] * scales + offsets)
        except Exception as error:  # whatever laspy and the decompressor raise
            raise IoError(f"{path}: cannot be read after {num_read} points: {error}") from error
    if num_read != header.point_count:
        raise IoError(f"{path}: found {num_read} points, expected {header.point_count} as its header says")
    return np.concatenate(chunks) if chunks else np.empty((0, 3))


def las_scans(spec: str | os.PathLike[str]) -> list[Path] | None:
    """The LAS or LAZ files that a file, folder or pattern stands for in natural order; None: it stands for others."""
    from trysquare.layouts._files import files_in, natural_key

    path = Path(spec)
    if path.is_dir():
        found = [file for file in files_in(path) if is_las(file)]
    elif is_las(path):
        found = [path] if path.is_file() else sorted(map(Path, glob.glob(os.fspath(spec))), key=natural_key)
    else:
        return None
    return found or None


def _opened(path: str | os.PathLike[str]) -> laspy.LasReader:
    try:
        import laspy
    except ImportError as error:
        raise ImportError("reading LAS needs laspy: pip install trysquare[las]") from error
    if not Path(path).is_file():
        raise IoError(f"{path}: no such file")
    if os.fspath(path).lower().endswith(".laz") and not laspy.LazBackend.detect_available():
        raise ImportError("reading LAZ needs lazrs: pip install trysquare[las]")
    try:
        return laspy.open(os.fspath(path))
    except Exception as error:  # whatever laspy raises for what is no LAS file
        raise IoError(f"{path}: cannot be read as LAS: {error}") from error


def _kept(chunk: Any, classifications: Collection[int] | None, returns: str) -> NDArray[np.bool_]:
    kept = np.ones(len(chunk), dtype=bool)
    if classifications is not None:
        kept &= np.isin(np.asarray(chunk.classification), list(classifications))
    if returns == "first":
        kept &= np.asarray(chunk.return_number) == 1
    if returns == "last":
        kept &= np.asarray(chunk.return_number) == np.asarray(chunk.number_of_returns)
    return kept
