# SPDX-License-Identifier: Apache-2.0
"""What diagnose() finds out. Names, units and reasons are those of docs/schema/diagnosis.schema.json."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trysquare._files import write_text
from trysquare._result import Result

if TYPE_CHECKING:
    import pandas


@dataclasses.dataclass(frozen=True, kw_only=True)
class Evidence(Result):
    """A number and the limit that it crosses."""

    found: float | None
    limit: float | None
    unit: str


@dataclasses.dataclass(frozen=True, kw_only=True)
class Finding(Result):
    """Something that is wrong: what it is, and what to do about it. `severity` is "error", "warning" or "note"."""

    id: str
    severity: str
    message: str
    remedy: str
    evidence: Evidence | None


@dataclasses.dataclass(frozen=True, kw_only=True)
class DiagnosedEstimate(Result):
    """How far off the poses are in all: the RPE estimate [m, deg]."""

    status: str
    reasons: list[str]
    translation_rms_m: float | None
    rotation_rms_deg: float | None


@dataclasses.dataclass(frozen=True, kw_only=True)
class TimeOffset(Result):
    """Each scan belongs to the pose `offset_s` later; None: no offset is named."""

    offset_s: float | None
    resolution_s: float | None
    num_scans: int
    costs: list[dict[str, Any]]


@dataclasses.dataclass(frozen=True, kw_only=True)
class SuspectPose(Result):
    """A pose that stands out from those around it."""

    scan: int
    translation_error_m: float
    translation_interval_m: tuple[float, float]
    rotation_error_deg: float
    rotation_interval_deg: tuple[float, float]
    score: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class PoseGroup(Result):
    """Consecutive poses that stand out together."""

    first_scan: int
    last_scan: int
    is_drift: bool
    translation_error_m: float
    rotation_error_deg: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class PoseJump(Result):
    """A step from one pose to the next that the scans contradict."""

    from_scan: int
    to_scan: int
    translation_error_m: float
    translation_limit_m: float
    rotation_error_deg: float
    rotation_limit_deg: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class PoseOffPath(Result):
    """A pose beside the path of its neighbors."""

    scan: int
    distance_m: float
    limit_m: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class GhostWall(Result):
    """A surface that is there twice, `distance_m` apart, each seen by other scans."""

    center_in_map_m: list[float]
    normal_in_map: list[float]
    distance_m: float
    limit_m: float
    noise_m: float
    extent_m: float
    num_patches: int
    lower_scans: list[int]
    upper_scans: list[int]
    adjusted_distance_m: float | None


@dataclasses.dataclass(frozen=True, kw_only=True)
class Diagnosis(Result):
    """Everything that is wrong with scans and poses, the worst first. None: not judged, `why` says why not."""

    judged: bool
    num_errors: int
    num_warnings: int
    findings: list[Finding]
    rpe_estimate: DiagnosedEstimate | None
    time_offset: TimeOffset
    suspects: list[SuspectPose] | None
    groups: list[PoseGroup] | None
    jumps: list[PoseJump] | None
    poses_off_path: list[PoseOffPath] | None
    ghost_walls: list[GhostWall] | None
    world_from_map: list[list[float]]
    text: str = dataclasses.field(repr=False)

    def to_json(self, path: str | Path | None = None) -> str:
        """The JSON text; written to `path`, whole or not at all, when one is given."""
        if path is not None:
            write_text(path, self.text)
        return self.text

    def to_pandas(self) -> pandas.DataFrame:
        """One row per finding. Needs pandas."""
        from trysquare._pandas import frame_of

        names = "id severity message remedy".split()
        return frame_of([{name: getattr(each, name) for name in names} for each in self.findings])


def diagnosis_of(text: str) -> Diagnosis:
    """The result from the text of the library."""
    return Diagnosis.from_json(json.loads(text), text=text)
