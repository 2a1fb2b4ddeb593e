# SPDX-License-Identifier: Apache-2.0
"""What compare() finds out. Names, units and reasons are those of docs/schema/comparison.schema.json."""

from __future__ import annotations

import csv
import dataclasses
import io
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trysquare._evaluation import Warning
from trysquare._files import write_text
from trysquare._result import Result

if TYPE_CHECKING:
    import pandas


@dataclasses.dataclass(frozen=True, kw_only=True)
class EstimateStatus(Result):
    """What the estimate of one trajectory by itself is worth."""

    status: str
    reasons: list[str]


@dataclasses.dataclass(frozen=True, kw_only=True)
class ComparedTrajectory(Result):
    """One trajectory: its RPE against the poses in which the scans agree, and the metrics of its map."""

    name: str
    poses: str
    poses_format: str
    extrinsic: str | None
    rpe_m: float | None
    interval_m: tuple[float, float] | None
    rpe_deg: float | None
    mom_m2: float | None
    omme_nats: float | None
    mpv_m2: float | None
    mme_nats: float | None
    multi_scan_share: float | None
    rpe_estimate: EstimateStatus | None
    warnings: list[Warning]


@dataclasses.dataclass(frozen=True, kw_only=True)
class PairedDifference(Result):
    """Two trajectories, window by window; `better` is None when they cannot be told apart."""

    first: str
    second: str
    num_windows: int
    num_first_better: int
    windows_can_tell: bool
    mean_difference: float | None
    interval: tuple[float, float] | None
    p_value: float | None
    p_adjusted: float | None
    better: str | None


@dataclasses.dataclass(frozen=True, kw_only=True)
class Rank(Result):
    """1 is best; trajectories that cannot be told apart share a rank."""

    name: str
    rank: int


@dataclasses.dataclass(frozen=True, kw_only=True)
class MetricComparison(Result):
    """All pairs by one metric, and the order that follows."""

    metric: str
    unit: str
    pairs: list[PairedDifference]
    ranks: list[Rank]


@dataclasses.dataclass(frozen=True, kw_only=True)
class ComparisonVerdict(Result):
    """Which trajectories are best by `metric`; several: a tie."""

    meaningful: bool
    reasons: list[str]
    metric: str | None
    best: list[str]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Comparison(Result):
    """Everything compare() finds out. `to_json()` is the text that the command prints for the same input."""

    settings: dict[str, Any]
    trajectories: list[ComparedTrajectory]
    adjusted_from: str | None
    adjusted_agreement_m: float | None
    comparisons: list[MetricComparison]
    verdict: ComparisonVerdict
    windows: list[dict[str, Any]] = dataclasses.field(repr=False)  #: One row per trajectory and window.
    text: str = dataclasses.field(repr=False)

    def __getitem__(self, name: str) -> ComparedTrajectory:
        """The trajectory of that name. Raises KeyError."""
        for trajectory in self.trajectories:
            if trajectory.name == name:
                return trajectory
        raise KeyError(name)

    def ranks(self, metric: str | None = None) -> dict[str, int]:
        """Rank by name; by the decisive metric when none is given. Raises KeyError for one that was not compared."""
        wanted = self.verdict.metric if metric is None else metric
        for comparison in self.comparisons:
            if comparison.metric == wanted:
                return {each.name: each.rank for each in comparison.ranks}
        raise KeyError(wanted)

    def to_json(self, path: str | Path | None = None) -> str:
        """The JSON text; written to `path`, whole or not at all, when one is given."""
        if path is not None:
            write_text(path, self.text)
        return self.text

    def to_pandas(self) -> pandas.DataFrame:
        """One row per trajectory. Needs pandas."""
        from trysquare._pandas import frame_of

        names = "name rpe_m interval_m rpe_deg mom_m2 omme_nats mpv_m2 mme_nats multi_scan_share".split()
        return frame_of([{name: getattr(each, name) for name in names} for each in self.trajectories])


def comparison_of(text: str, windows_csv: str) -> Comparison:
    """The result from the texts of the library."""
    windows = [_row_of(row) for row in csv.DictReader(io.StringIO(windows_csv))]
    return Comparison.from_json(json.loads(text), windows=windows, text=text)


def _row_of(row: dict[str, str]) -> dict[str, Any]:
    """Numbers of a row of the CSV; an empty cell is None."""
    converted: dict[str, Any] = {"trajectory": row.pop("trajectory")}
    for key, cell in row.items():
        converted[key] = None if cell == "" else int(cell) if key in ("first", "last") else float(cell)
    return converted
