# SPDX-License-Identifier: Apache-2.0
"""Figures of results: pip install trysquare[plot].

Every function gives a matplotlib Figure that no window and no pyplot knows of: figure.savefig("name.png"). What is
undefined is a gap, never zero.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trysquare._core import InvalidArgument
from trysquare._figures import COLOR, MARK, UNDEFINED, floats, label, new_figure
from trysquare._heat_map import draw_heat_map

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from trysquare._comparison import Comparison
    from trysquare._evaluation import Evaluation, RpeEstimate

__all__ = ["COMPARED", "WINDOW_SERIES", "plot_comparison", "plot_heat_map", "plot_pose_errors", "plot_windows"]

WINDOW_SERIES = {
    "mom": ("MOM", "m²"),
    "rpe_estimate_m": ("RPE estimate", "m"),
    "rpe_m": ("RPE against the reference", "m"),
    "mpv": ("MPV", "m²"),
    "omme": ("OMME", "nats"),
    "mme": ("MME", "nats"),
    "multi_scan_share": ("Neighborhoods with points of several scans", "share"),
}
"""What windows have: name and unit."""

COMPARED = {
    "rpe_m": ("RPE without ground truth, with its interval", "m"),
    "mom_m2": ("MOM", "m²"),
    "mpv_m2": ("MPV", "m²"),
    "omme_nats": ("OMME", "nats"),
    "mme_nats": ("MME", "nats"),
}
"""What compared trajectories have: name and unit."""


def plot_heat_map(result: Evaluation, metric: str | None = None) -> Figure:
    """The trajectory seen along the map axis of its smallest extent, colored by a metric of its windows.

    Where windows overlap, each colors the part around its middle. Dashed gray: the metric is undefined there.

    Args:
        result: of evaluate(), with windows.
        metric: a key of WINDOW_SERIES. None: the first that is defined in some window.

    Raises:
        ImportError: matplotlib is not installed.
        InvalidArgument: there are no windows or no trajectory, or the metric is unknown or defined in no window.
    """
    values = {key: window_values(result, key) for key in WINDOW_SERIES}
    if metric is None:
        metric = next((key for key, each in values.items() if np.isfinite(each).any()), "mom")
    if metric not in WINDOW_SERIES:
        raise InvalidArgument(f'metric = "{metric}" is unknown, expected {", ".join(WINDOW_SERIES)}')
    if not np.isfinite(values[metric]).any():
        reason = result.why.get("windows") or f"it is undefined in all {len(result.windows)} windows"
        raise InvalidArgument(f"there is no heat map of {metric}: {reason}")
    if result.trajectory is None:
        raise InvalidArgument("there is no heat map: the result has no trajectory")
    windows = [(window.first, window.last) for window in result.windows]
    positions = np.asarray(result.trajectory.positions_in_map_m)
    longest, second = np.sort(np.ptp(positions, axis=0))[[2, 1]]
    figure = new_figure(6.4, 1.2 + 4.0 * max(second / longest if longest > 0 else 1.0, 0.3))
    draw_heat_map(figure, positions, windows, values[metric], *WINDOW_SERIES[metric])
    return figure


def plot_windows(result: Evaluation) -> Figure:
    """The metrics of the windows over the scans: a panel for each that is defined in some window.

    A point is a window, at its middle; the line breaks where the metric is undefined. Hollow points: MOM or OMME of
    fewer than three directions, which does not follow the trajectory error.

    Raises:
        ImportError: matplotlib is not installed.
        InvalidArgument: there are no windows, or nothing is defined in them.
    """
    values = {key: window_values(result, key) for key in WINDOW_SERIES}
    shown = [key for key, each in values.items() if np.isfinite(each).any()]
    if not shown:
        raise InvalidArgument(f"there is nothing to plot over windows: {result.why.get('windows', 'all is undefined')}")
    figure = new_figure(6.4, 0.9 + 1.5 * len(shown))
    panels = figure.subplots(len(shown), 1, sharex=True, squeeze=False)[:, 0]
    middles = np.array([(window.first + window.last) / 2 for window in result.windows])
    follows = np.array([window.follows_trajectory_error is not False for window in result.windows])
    for axes, key in zip(panels, shown, strict=True):
        name, unit = WINDOW_SERIES[key]
        axes.plot(middles, values[key], "-", color=COLOR, linewidth=1.5, label=key)
        filled = follows | (key not in ("mom", "omme"))
        for some, face in ((filled, COLOR), (~filled, "white")):
            axes.plot(middles[some], values[key][some], "o", color=COLOR, markerfacecolor=face, markersize=5)
        label(axes, name, y=f"[{unit}]")
        axes.set_xlim(-0.5, max(window.last for window in result.windows) + 0.5)
    panels[-1].set_xlabel("scan")
    panels[-1].xaxis.get_major_locator().set_params(integer=True)
    return figure


def plot_pose_errors(result: Evaluation) -> Figure:
    """By how much each pose is off beyond its neighbors, in position [m] and rotation [deg], without ground truth.

    Bars reach from the length of the error by its standard deviation, which is relative to pose 0, both ways, but not
    below 0. Suspects are marked. The title has the RPE estimate and its interval.

    Raises:
        ImportError: matplotlib is not installed.
        InvalidArgument: the RPE was not estimated, or the estimate was refused: the message has the reasons.
    """
    estimate = result.rpe_estimate
    if estimate is None or not estimate.poses:
        reasons = [result.why.get("rpe_estimate", "RPE was not asked for")] if estimate is None else estimate.reasons
        raise InvalidArgument("there are no errors of poses to plot: " + "; ".join(reasons))
    figure = new_figure(6.4, 5.2)
    panels = figure.subplots(2, 1, sharex=True)
    index = np.array([pose.index for pose in estimate.poses])
    suspect = np.array([pose.suspect for pose in estimate.poses])
    for axes, error, sigma, name, unit in (
        (panels[0], "translation_error_m", "sigma_m", "Error of position", "m"),
        (panels[1], "rotation_error_deg", "sigma_deg", "Error of rotation", "deg"),
    ):
        lengths = np.array([np.linalg.norm(getattr(pose, error)) for pose in estimate.poses])
        half = floats(getattr(pose, sigma) for pose in estimate.poses)
        axes.vlines(index, np.maximum(lengths - half, 0), lengths + half, color=COLOR, alpha=0.45, linewidth=2)
        axes.plot(index, lengths, "o", color=COLOR, markersize=4, label="error ± its standard deviation")
        if suspect.any():
            marked = {"color": MARK, "markersize": 9, "fillstyle": "none", "label": "suspect"}
            axes.plot(index[suspect], lengths[suspect], "o", **marked)
        axes.set_ylim(bottom=0)
        label(axes, name, y=f"[{unit}]")
    panels[0].legend(frameon=False, fontsize="small")
    panels[-1].set_xlabel("pose")
    panels[-1].xaxis.get_major_locator().set_params(integer=True)
    figure.suptitle(_headline(estimate), fontsize="medium")
    return figure


def plot_comparison(comparison: Comparison) -> Figure:
    """The trajectories side by side: the RPE without ground truth with its interval, then each metric. Lower is better.

    The best, all that share rank 1, are bold. "undefined" stands where a trajectory has no value.

    Raises:
        ImportError: matplotlib is not installed.
        InvalidArgument: no metric is defined for any trajectory.
    """
    trajectories = comparison.trajectories
    values = {key: floats(getattr(each, key) for each in trajectories) for key in COMPARED}
    shown = [key for key, each in values.items() if np.isfinite(each).any()]
    if not shown:
        raise InvalidArgument("there is nothing to compare: no metric is defined for any trajectory")
    figure = new_figure(6.4, 0.6 + len(shown) * (0.7 + 0.3 * len(trajectories)))
    panels = figure.subplots(len(shown), 1, squeeze=False)[:, 0]
    rows = np.arange(len(trajectories))
    for axes, key in zip(panels, shown, strict=True):
        name, unit = COMPARED[key]
        if key == "rpe_m":
            low, high = np.array([each.interval_m or (np.nan, np.nan) for each in trajectories]).T
            axes.hlines(rows, low, high, color=COLOR, alpha=0.45, linewidth=5)
        axes.plot(values[key], rows, "o", color=COLOR)
        for row in rows[~np.isfinite(values[key])]:
            axes.annotate("undefined", (0.02, row), xycoords=("axes fraction", "data"), color=UNDEFINED, va="center")
        axes.set_yticks(rows, [each.name for each in trajectories])
        for text, each in zip(axes.get_yticklabels(), trajectories, strict=True):
            text.set_fontweight("bold" if each.name in comparison.verdict.best else "normal")
        axes.set_ylim(len(trajectories) - 0.5, -0.5)
        label(axes, name, x=f"[{unit}]")
    return figure


def window_values(result: Evaluation, key: str) -> NDArray[np.float64]:
    """A series of the windows, (W,); NaN: undefined."""
    if key == "multi_scan_share":
        return floats(window.overlap.multi_scan_share for window in result.windows)
    return floats(getattr(window, key) for window in result.windows)


def _headline(estimate: RpeEstimate) -> str:
    if estimate.translation_rms_m is None:
        return f"RPE estimate: {estimate.status}"
    text = f"RPE estimate ({estimate.status}): {estimate.translation_rms_m:.3g} m"
    if estimate.interval_m is not None:
        text += f", {estimate.interval_m[0]:.3g} to {estimate.interval_m[1]:.3g} m"
    return text
