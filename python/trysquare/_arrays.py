# SPDX-License-Identifier: Apache-2.0
"""From whatever holds points or poses to the arrays of the library. Nothing is copied that already has their type."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare import _core

Points = NDArray[np.float64]
Poses = NDArray[np.float64]


def _as_floats(value: Any, name: str, expected: str) -> NDArray[np.float64]:
    """An array of doubles, row by row; `expected` is what the message asks for."""
    if hasattr(value, "points") and not isinstance(value, np.ndarray):  # an Open3D cloud, or anything like it
        value = value.points
    elif hasattr(value, "point") and not isinstance(value, np.ndarray):  # an Open3D tensor cloud
        value = value.point["positions"].numpy()
    try:
        array = np.asarray(value)
    except (TypeError, ValueError) as error:
        raise _core.InvalidArgument(f"{name}: expected {expected}, found {type(value).__name__}") from error
    if array.dtype.kind not in "fiu":
        raise _core.InvalidArgument(f"{name}: expected {expected} of numbers, found the type {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.float64)


def as_points(value: Any, name: str = "points", *, allow_empty: bool = False) -> Points:
    """(N, 3) doubles [m] from an array of three or more columns, of which the first are x, y, z, or a cloud.

    Raises InvalidArgument (a ValueError) that calls the argument `name`.
    """
    expected = "an (N, 3) array"
    array = _as_floats(value, name, expected)
    if array.ndim != 2 or array.shape[1] < 3:
        if array.size == 0 and allow_empty:
            return np.empty((0, 3))
        raise _core.InvalidArgument(f"{name}: expected {expected}, found the shape {array.shape}")
    if array.shape[0] == 0 and not allow_empty:
        raise _core.InvalidArgument(f"{name}: expected {expected}, found no points")
    return np.ascontiguousarray(array[:, :3])


def as_poses(value: Any, name: str = "poses", *, allow_empty: bool = False) -> Poses:
    """(M, 4, 4) doubles from a stack of 4×4 or 3×4 matrices, or a trajectory with `poses`."""
    if hasattr(value, "poses") and not isinstance(value, np.ndarray):
        value = value.poses
    expected = "an (M, 4, 4) array"
    array = _as_floats(value, name, expected)
    if array.ndim != 3 or array.shape[1:] not in ((4, 4), (3, 4)):
        raise _core.InvalidArgument(f"{name}: expected {expected}, found the shape {array.shape}")
    if array.shape[0] == 0 and not allow_empty:
        raise _core.InvalidArgument(f"{name}: expected {expected}, found no poses")
    if array.shape[1] == 3:
        last_rows = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (len(array), 1, 4))
        array = np.ascontiguousarray(np.concatenate([array, last_rows], axis=1))
    return array


def as_matrix(value: Any, name: str) -> NDArray[np.float64]:
    """(4, 4) doubles from one 4×4 or 3×4 matrix."""
    array = _as_floats(value, name, "a 4x4 matrix")
    if array.shape not in ((4, 4), (3, 4)):
        raise _core.InvalidArgument(f"{name}: expected a 4x4 matrix, found the shape {array.shape}")
    matrix: NDArray[np.float64] = as_poses(array[np.newaxis], name)[0]
    return matrix


def as_stamps(value: Any, name: str) -> NDArray[np.int64] | None:
    """(M,) whole nanoseconds, or None."""
    if value is None:
        return None
    array = np.asarray(value)
    if array.ndim != 1 or array.dtype.kind not in "iu":
        raise _core.InvalidArgument(
            f"{name}: expected an (M,) array of whole nanoseconds, found the shape {array.shape} of {array.dtype}"
        )
    return np.ascontiguousarray(array, dtype=np.int64)


def as_subset(value: Any, name: str = "subset") -> list[Points] | None:
    """Points by direction, at most three, from a list of arrays or an OrthogonalSubset; None stays None."""
    if value is None:
        return None
    directions = value.directions if hasattr(value, "directions") else value
    arrays = [as_points(points, f"{name}[{i}]", allow_empty=True) for i, points in enumerate(directions)]
    if len(arrays) > 3:
        raise _core.InvalidArgument(f"{name}: expected at most 3 directions, found {len(arrays)}")
    return arrays


def as_scans(value: Any, name: str = "scans") -> _core.Scans:
    """Scans of the library: a list of arrays is kept as it is, any other sequence is asked for one scan at a time."""
    if isinstance(value, _core.Scans):
        return value
    native = getattr(value, "native_scans", None)
    if native is not None:
        return native  # type: ignore[no-any-return]
    if isinstance(value, (str, bytes, Mapping)):
        raise _core.InvalidArgument(f"{name}: expected a list of (N, 3) arrays, found {type(value).__name__}")
    if isinstance(value, np.ndarray) and value.ndim != 3:
        raise _core.InvalidArgument(f"{name}: expected a list of (N, 3) arrays, found one of the shape {value.shape}")
    if isinstance(value, (list, tuple, np.ndarray)):
        if len(value) == 0:
            raise _core.InvalidArgument(f"{name}: expected a list of (N, 3) arrays, found none")
        return _core.array_scans([as_points(scan, f"{name}[{i}]", allow_empty=True) for i, scan in enumerate(value)])
    if hasattr(value, "__len__") and hasattr(value, "__getitem__"):
        return _core.python_scans(len(value), _loader(value, name))
    raise _core.InvalidArgument(f"{name}: expected a list of (N, 3) arrays, found {type(value).__name__}")


def _loader(scans: Sequence[Any], name: str) -> Callable[[int], Points]:
    """One scan at a time: a sequence of the user's need not stand several threads, which ask for scans here."""
    lock = threading.Lock()

    def load(index: int) -> Points:
        with lock:
            return as_points(scans[index], f"{name}[{index}]", allow_empty=True)

    return load
