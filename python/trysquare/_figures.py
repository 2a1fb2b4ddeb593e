# SPDX-License-Identifier: Apache-2.0
"""What the figures have in common."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOR, MARK, UNDEFINED = "#1f5fa8", "#c03a2b", "#8a8a8a"


def new_figure(width: float, height: float) -> Figure:
    """A figure, in inches, that pyplot does not know of. Raises ImportError naming the extra."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError("plotting needs matplotlib: pip install trysquare[plot]") from error
    return Figure(figsize=(width, height), layout="constrained")


def label(axes: Axes, title: str, x: str = "", y: str = "") -> None:
    """Title and labels, and a faint grid."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.set_title(title, loc="left", fontsize="medium")
    axes.grid(alpha=0.25)


def floats(numbers: Iterable[float | None]) -> NDArray[np.float64]:
    """(N,); None becomes NaN, which matplotlib leaves out."""
    return np.array([np.nan if number is None else number for number in numbers], dtype=float)
