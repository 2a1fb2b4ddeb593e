# SPDX-License-Identifier: Apache-2.0
"""A trajectory colored by window."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trysquare._figures import UNDEFINED

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def draw_heat_map(
    figure: Figure,
    positions: NDArray[np.float64],
    windows: Sequence[tuple[int, int]],
    values: NDArray[np.float64],
    name: str,
    unit: str,
) -> None:
    """Draws the path (M, 3) [m], one line a window, and the scale of its colors.

    windows: first and last scan, inclusive, by time.  values: (W,); NaN: undefined.
    """
    from matplotlib.collections import LineCollection

    axes = figure.add_subplot()
    right, up = seen_axes(positions)
    path = positions[:, [right, up]]
    axes.plot(path[:, 0], path[:, 1], "-", color=UNDEFINED, linewidth=1, zorder=1, label="path")
    parts = [path[first : last + 1] for first, last in parts_of(windows, len(path))]
    defined = np.isfinite(values)
    lines = LineCollection(
        [part for part, is_defined in zip(parts, defined, strict=True) if is_defined],
        array=values[defined],
        cmap="viridis",
        linewidths=5,
        capstyle="round",
        zorder=2,
    )
    axes.add_collection(lines)
    for part, is_defined in zip(parts, defined, strict=True):
        if not is_defined:
            axes.plot(part[:, 0], part[:, 1], "--", color=UNDEFINED, linewidth=3, zorder=2, label="undefined")
    axes.plot(*path[0], "o", color="black", fillstyle="none", markersize=11, zorder=3, label="start")
    axes.plot(*path[-1], "s", color="black", markersize=5, zorder=3, label="end")
    axes.set_aspect("equal", adjustable="datalim")
    if (right + 1) % 3 != up:  # seen from the other side, so that a left turn stays one
        axes.invert_xaxis()
    axes.set_xlabel(f"map {'xyz'[right]} [m]")
    axes.set_ylabel(f"map {'xyz'[up]} [m]")
    axes.grid(alpha=0.25)
    figure.colorbar(lines, ax=axes, label=f"{name} [{unit}]")
    handles, labels = axes.get_legend_handles_labels()
    by_label = dict(zip(labels, handles, strict=True))
    axes.legend(by_label.values(), by_label.keys(), frameon=False, fontsize="small")


def seen_axes(positions: NDArray[np.float64]) -> tuple[int, int]:
    """The two map axes in which the path extends most, the longer one first."""
    order = np.argsort(-np.ptp(positions, axis=0), kind="stable")
    return int(order[0]), int(order[1])


def parts_of(windows: Sequence[tuple[int, int]], num_scans: int) -> list[tuple[int, int]]:
    """First and last scan of the part of the path that each window colors.

    Windows that touch meet at the first scan of the later one; those that overlap share what they have in common, half
    each; between windows that leave scans out there is a gap.
    """
    starts = [first for first, _ in windows]
    ends = [last for _, last in windows]
    for i in range(len(windows) - 1):
        if windows[i + 1][0] <= windows[i][1] + 1:
            starts[i + 1] = ends[i] = min((windows[i][1] + 1 + windows[i + 1][0]) // 2, num_scans - 1)
    return list(zip(starts, ends, strict=True))
