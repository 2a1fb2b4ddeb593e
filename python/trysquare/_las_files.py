# SPDX-License-Identifier: Apache-2.0
"""Which files are LAS or LAZ; laspy is imported only to read one."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray


def is_las(path: str | os.PathLike[str]) -> bool:
    """By the end of the name."""
    return Path(path).suffix.lower() in (".las", ".laz")


def read_las_points(path: str | os.PathLike[str]) -> NDArray[np.float64]:
    """(N, 3) points [m]. Raises ImportError naming the extra, IoError naming the file."""
    from trysquare.las import read_las

    return read_las(path)
