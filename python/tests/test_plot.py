# SPDX-License-Identifier: Apache-2.0
"""Figures show the numbers of the result: the drawn data are read back and compared."""

from __future__ import annotations

import math
import subprocess
import sys
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

import trysquare as ts
from trysquare import plot
from trysquare._heat_map import parts_of, seen_axes


def window(first: int, last: int, **values: Any) -> SimpleNamespace:
    names = dict.fromkeys(("mom", "omme", "mpv", "mme", "rpe_estimate_m", "rpe_m"))
    overlap = SimpleNamespace(multi_scan_share=values.pop("share", 0.9))
    known = {"follows_trajectory_error": True, **names, **values}
    return SimpleNamespace(first=first, last=last, overlap=overlap, **known)


def evaluation(windows: list[SimpleNamespace], **more: Any) -> Any:
    """A result with what the figures ask for; twelve scans along a left turn in x and z of the map."""
    angles = np.linspace(0, np.pi / 2, 12)
    positions = np.stack([10 * np.sin(angles), 0.01 * angles, 6 * (1 - np.cos(angles))], axis=1)
    known = {"trajectory": SimpleNamespace(positions_in_map_m=positions.tolist()), "why": {}, "rpe_estimate": None}
    return SimpleNamespace(windows=windows, **{**known, **more})


THREE = [window(0, 3, mom=2e-4), window(4, 7), window(8, 11, mom=5e-4, mpv=3e-4)]


def lines_labelled(figure: Figure, text: str) -> list[Any]:
    return [line for axes in figure.axes for line in axes.get_lines() if line.get_label() == text]


def saved(figure: Figure, tmp_path: Any) -> None:
    figure.savefig(tmp_path / "figure.png")
    assert (tmp_path / "figure.png").stat().st_size > 5000


def test_heat_map_colors_each_defined_window_and_leaves_the_others_uncolored(tmp_path: Any) -> None:
    result = evaluation(THREE)
    figure = plot.plot_heat_map(result)
    saved(figure, tmp_path)
    axes = figure.axes[0]
    (collection,) = [each for each in axes.collections if isinstance(each, LineCollection)]
    np.testing.assert_array_equal(collection.get_array(), [2e-4, 5e-4])
    path = np.asarray(result.trajectory.positions_in_map_m)[:, [0, 2]]
    first, last = collection.get_segments()
    np.testing.assert_array_equal(first, path[0:5])  # to the first scan of the next
    np.testing.assert_array_equal(last, path[8:12])
    (undefined,) = lines_labelled(figure, "undefined")
    np.testing.assert_array_equal(undefined.get_xydata(), path[4:9])
    assert undefined.get_linestyle() == "--"
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("map x [m]", "map z [m]")
    assert figure.axes[1].get_ylabel() == "MOM [m²]"
    assert axes.get_aspect() == 1.0


def test_heat_map_keeps_a_left_turn_a_left_turn() -> None:
    """Seen from where the third axis comes: x to the right and z up shows -y to the viewer, so x is reversed."""
    assert plot.plot_heat_map(evaluation(THREE)).axes[0].xaxis_inverted()
    result = evaluation(THREE)
    result.trajectory.positions_in_map_m = [[x, z, y] for x, y, z in result.trajectory.positions_in_map_m]
    axes = plot.plot_heat_map(result).axes[0]
    assert axes.get_ylabel() == "map y [m]" and not axes.xaxis_inverted()


def test_heat_map_of_a_named_metric() -> None:
    figure = plot.plot_heat_map(evaluation(THREE), "multi_scan_share")
    (collection,) = [each for each in figure.axes[0].collections if isinstance(each, LineCollection)]
    np.testing.assert_array_equal(collection.get_array(), [0.9, 0.9, 0.9])


def test_there_is_no_heat_map_without_values() -> None:
    with pytest.raises(ts.InvalidArgument, match="no heat map of mme: it is undefined in all 3 windows"):
        plot.plot_heat_map(evaluation(THREE), "mme")
    with pytest.raises(ts.InvalidArgument, match='metric = "speed" is unknown, expected mom, '):
        plot.plot_heat_map(evaluation(THREE), "speed")
    with pytest.raises(ts.InvalidArgument, match="no heat map of mom: fewer than 20 scans"):
        plot.plot_heat_map(evaluation([], why={"windows": "fewer than 20 scans"}))
    with pytest.raises(ts.InvalidArgument, match="no trajectory"):
        plot.plot_heat_map(evaluation(THREE, trajectory=None))


def test_parts_of_windows() -> None:
    assert parts_of([(0, 4), (5, 9)], 10) == [(0, 5), (5, 9)]  # touch
    assert parts_of([(0, 9), (4, 13), (8, 17)], 18) == [(0, 7), (7, 11), (11, 17)]  # overlap
    assert parts_of([(0, 4), (7, 11)], 12) == [(0, 4), (7, 11)]  # leave scans out
    assert seen_axes(np.array([[0, 0, 0], [1, 5, 3]])) == (1, 2)


def test_windows_break_the_line_where_a_metric_is_undefined(tmp_path: Any) -> None:
    third = window(8, 11, mom=5e-4, mpv=3e-4, follows_trajectory_error=False)
    figure = plot.plot_windows(evaluation([THREE[0], THREE[1], third]))
    saved(figure, tmp_path)
    assert [axes.get_title(loc="left") for axes in figure.axes] == [
        "MOM",
        "MPV",
        "Neighborhoods with points of several scans",
    ]
    assert [axes.get_ylabel() for axes in figure.axes] == ["[m²]", "[m²]", "[share]"]
    assert figure.axes[-1].get_xlabel() == "scan"
    (mom,) = lines_labelled(figure, "mom")
    np.testing.assert_array_equal(mom.get_xdata(), [1.5, 5.5, 9.5])
    np.testing.assert_array_equal(mom.get_ydata(), [2e-4, math.nan, 5e-4])
    _, filled, hollow = figure.axes[0].get_lines()
    assert hollow.get_xdata().tolist() == [9.5] and hollow.get_markerfacecolor() == "white"
    assert filled.get_xdata().tolist() == [1.5, 5.5]
    assert figure.axes[1].get_lines()[2].get_xdata().tolist() == []  # MPV is never hollow
    with pytest.raises(ts.InvalidArgument, match="nothing to plot over windows: fewer than 20 scans"):
        plot.plot_windows(evaluation([], why={"windows": "fewer than 20 scans"}))


def estimate(**more: Any) -> SimpleNamespace:
    def pose(index: int, error: list[float], sigma: float | None, suspect: bool = False) -> SimpleNamespace:
        turned = [0.1 * each for each in error]
        return SimpleNamespace(
            index=index,
            translation_error_m=error,
            rotation_error_deg=turned,
            sigma_m=sigma,
            sigma_deg=sigma,
            suspect=suspect,
        )

    poses = [pose(0, [0.0, 0.0, 0.0], 0.0), pose(1, [0.03, 0.04, 0.0], 0.02), pose(3, [0.0, 0.0, 0.3], None, True)]
    known = {
        "status": "measured",
        "reasons": [],
        "translation_rms_m": 0.1234,
        "interval_m": (0.1, 0.15),
        "poses": poses,
    }
    return SimpleNamespace(**{"poses": poses, **known, **more})


def test_errors_of_poses_have_their_lengths_and_intervals(tmp_path: Any) -> None:
    figure = plot.plot_pose_errors(evaluation(THREE, rpe_estimate=estimate()))
    saved(figure, tmp_path)
    position, rotation = figure.axes
    errors, suspects = position.get_lines()
    np.testing.assert_allclose(errors.get_xydata(), [[0, 0], [1, 0.05], [3, 0.3]])
    np.testing.assert_allclose(suspects.get_xydata(), [[3, 0.3]])
    np.testing.assert_allclose(rotation.get_lines()[0].get_ydata(), [0, 0.005, 0.03])
    (bars,) = position.collections
    segments = bars.get_segments()
    np.testing.assert_allclose(segments[1], [[1, 0.03], [1, 0.07]])
    assert np.isnan(np.ma.filled(np.ma.asarray(segments[2]), np.nan)).any() or len(segments[2]) == 0  # no sigma, no bar
    (bars,) = rotation.collections
    np.testing.assert_allclose(bars.get_segments()[1], [[1, 0], [1, 0.025]])  # not below 0
    assert (position.get_ylabel(), rotation.get_ylabel(), rotation.get_xlabel()) == ("[m]", "[deg]", "pose")
    assert figure.get_suptitle() == "RPE estimate (measured): 0.123 m, 0.1 to 0.15 m"


def test_refused_estimates_are_not_plotted() -> None:
    refused = estimate(status="refused", reasons=["too few patches", "no overlap"], poses=[])
    with pytest.raises(ts.InvalidArgument, match="no errors of poses to plot: too few patches; no overlap"):
        plot.plot_pose_errors(evaluation(THREE, rpe_estimate=refused))
    with pytest.raises(ts.InvalidArgument, match="RPE was not asked for"):
        plot.plot_pose_errors(evaluation(THREE))


def comparison(**best: Any) -> Any:
    def trajectory(name: str, rpe_m: float | None, interval_m: Any, mom_m2: float | None) -> SimpleNamespace:
        others = {"mpv_m2": None, "omme_nats": None, "mme_nats": None}
        return SimpleNamespace(name=name, rpe_m=rpe_m, interval_m=interval_m, mom_m2=mom_m2, **others)

    trajectories = [
        trajectory("slam", 0.2, (0.15, 0.25), 3e-4),
        trajectory("odometry", None, None, 9e-4),
        trajectory("truth", 0.1, (0.05, 0.15), 2e-4),
    ]
    return SimpleNamespace(trajectories=trajectories, verdict=SimpleNamespace(best=["truth"]), **best)


def test_comparison_shows_values_and_intervals_and_says_what_is_undefined(tmp_path: Any) -> None:
    figure = plot.plot_comparison(comparison())
    saved(figure, tmp_path)
    rpe, mom = figure.axes
    np.testing.assert_array_equal(rpe.get_lines()[0].get_xdata(), [0.2, math.nan, 0.1])
    np.testing.assert_array_equal(mom.get_lines()[0].get_xdata(), [3e-4, 9e-4, 2e-4])
    segments = rpe.collections[0].get_segments()
    np.testing.assert_allclose([segments[0], segments[2]], [[[0.15, 0], [0.25, 0]], [[0.05, 2], [0.15, 2]]])
    assert [(text.get_text(), text.xy[1]) for text in rpe.texts] == [("undefined", 1)]
    assert not mom.texts and not mom.collections
    weights = [text.get_fontweight() for text in rpe.get_yticklabels()]
    assert [text.get_text() for text in rpe.get_yticklabels()] == ["slam", "odometry", "truth"]
    assert weights == ["normal", "normal", "bold"]
    assert (rpe.get_xlabel(), mom.get_xlabel()) == ("[m]", "[m²]")
    assert rpe.yaxis_inverted()  # the first is on top


def test_nothing_to_compare_is_an_error() -> None:
    nothing = comparison()
    for each in nothing.trajectories:
        each.rpe_m = each.mom_m2 = None
    with pytest.raises(ts.InvalidArgument, match="nothing to compare"):
        plot.plot_comparison(nothing)


def test_pyplot_is_not_touched_and_a_missing_matplotlib_is_named() -> None:
    code = """
import sys
import trysquare.plot
from trysquare._figures import new_figure
assert "matplotlib" not in sys.modules
new_figure(1, 1).subplots()
assert "matplotlib.pyplot" not in sys.modules
for name in [name for name in sys.modules if name.split(".")[0] == "matplotlib"]:
    sys.modules[name] = None
try:
    new_figure(1, 1)
except ImportError as error:
    assert "pip install trysquare[plot]" in str(error), error
else:
    raise SystemExit("no ImportError")
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_results_of_the_library_are_drawn(room: Any) -> None:
    """The same with real results: what is drawn is what their tables say."""
    scans, poses = room
    result = ts.evaluate(scans, poses, metrics=["mom", "mpv", "rpe"], window=3, stride=3)
    (mpv,) = lines_labelled(plot.plot_windows(result), "mpv")
    np.testing.assert_array_equal(mpv.get_ydata(), [each.mpv for each in result.windows])
    heat = plot.plot_heat_map(result, "mpv").axes[0]
    (collection,) = [each for each in heat.collections if isinstance(each, LineCollection)]
    np.testing.assert_array_equal(collection.get_array(), [each.mpv for each in result.windows])
    assert result.rpe_estimate is not None
    errors = plot.plot_pose_errors(result).axes[0].get_lines()[0]
    lengths = [np.linalg.norm(pose.translation_error_m) for pose in result.rpe_estimate.poses]
    np.testing.assert_array_equal(errors.get_ydata(), lengths)
    compared = ts.compare(scans, {"a": poses, "b": ts.perturb(poses, translation_m=0.05, rotation_deg=0.1)})
    figure = plot.plot_comparison(compared)
    np.testing.assert_array_equal(
        figure.axes[0].get_lines()[0].get_xdata(), [each.rpe_m for each in compared.trajectories]
    )
