# SPDX-License-Identifier: Apache-2.0
"""Full-reference errors of trajectories, with evo's options and numbers."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trysquare import _core
from trysquare._arrays import as_poses, as_stamps
from trysquare._evaluation import Statistics, Warning
from trysquare._files import write_text
from trysquare._result import Result
from trysquare._settings import as_threads, set_given


@dataclasses.dataclass(frozen=True, kw_only=True, eq=False)
class TrajectoryErrors(Result):
    """APE or RPE. `statistics` is None with a `reason` when no error exists, as without any common pair."""

    metric: str
    unit: str
    num_pairs: int
    statistics: Statistics | None
    quantiles: dict[str, float] | None
    scale: float | None
    num_zero_distances: int | None = None  #: Pairs without a distance, which have no ratio.
    settings: dict[str, Any]
    inputs: dict[str, Any]
    warnings: list[Warning]
    reason: str | None = None
    kitti_drift: dict[str, Any] | None = None  #: With kitti=True: drift in % and deg/100 m.
    every_pair: dict[str, Any] | None = None  #: With every_pair=True: statistics over all pairs i < j.
    paper_rpe_m2: float | None = None  #: With every_pair=True: the paper's RPE.
    errors: NDArray[np.float64] = dataclasses.field(repr=False)  #: (K,) per pose (APE) or pair (RPE), in `unit`.
    pairs: NDArray[np.int64] = dataclasses.field(repr=False)  #: RPE: (K, 2) poses of each error. APE: (0, 2).
    text: str = dataclasses.field(repr=False)

    def to_json(self, path: str | Path | None = None) -> str:
        """The JSON text, schema trysquare.trajectory/1; written to `path` when one is given."""
        if path is not None:
            write_text(path, self.text)
        return self.text


def _association(
    t_max_diff_s: float | None, t_offset_s: float | None, one_to_one: bool, interpolate: bool
) -> _core.AssociationSettings:
    if t_max_diff_s is not None and not t_max_diff_s >= 0:
        raise _core.InvalidArgument(f"t_max_diff_s = {t_max_diff_s!r}: expected a time of at least 0 s")
    return set_given(
        _core.AssociationSettings(),
        max_difference_s=t_max_diff_s,
        offset_s=t_offset_s,
        one_to_one=one_to_one,
        interpolate=interpolate,
    )


def _inputs(value: Any, stamps_ns: Any, name: str) -> tuple[Any, Any]:
    """Poses and stamps; a Trajectory brings its own stamps."""
    if stamps_ns is None:
        stamps_ns = getattr(value, "stamps_ns", None)
    return as_poses(value, name), as_stamps(stamps_ns, f"{name}_stamps_ns")


def _result_of(compared: _core.ComparedPoses) -> TrajectoryErrors:
    return TrajectoryErrors.from_json(
        json.loads(compared.json),
        errors=compared.errors,
        pairs=compared.pairs.reshape(-1, 2),
        text=compared.json,
    )


def ape(
    reference: Any,
    estimate: Any,
    *,
    align: str = "none",
    relation: str = "trans_part",
    n_to_align: int = 0,
    plane: str | None = None,
    reference_stamps_ns: Any = None,
    estimate_stamps_ns: Any = None,
    t_max_diff_s: float | None = None,
    t_offset_s: float | None = None,
    one_to_one: bool = False,
    interpolate: bool = False,
) -> TrajectoryErrors:
    """Absolute pose error: how far each estimated pose is from the reference pose, after an alignment.

    reference, estimate: (M, 4, 4) poses, or a Trajectory. With stamps on both sides [ns] poses are paired by time
        (`t_max_diff_s`, `t_offset_s`, `one_to_one`, `interpolate`), else pose i belongs to pose i.
    align: "none", "origin", "scale", "se3" or "sim3"; n_to_align: by the first poses only, 0: all.
    relation: "full", "trans_part", "rot_part", "angle_deg", "angle_rad" or "point_distance", as in evo.
    plane: "xy", "xz" or "yz": both are projected after the alignment.

    Raises InvalidArgument. Source: Sturm et al., 2012; evo; docs/definitions.md#ape.
    """
    return _result_of(
        _core.ape(
            *_inputs(reference, reference_stamps_ns, "reference"),
            *_inputs(estimate, estimate_stamps_ns, "estimate"),
            relation,
            align,
            n_to_align,
            plane,
            _association(t_max_diff_s, t_offset_s, one_to_one, interpolate),
        )
    )


def rpe(
    reference: Any,
    estimate: Any,
    *,
    delta: float | None = None,
    delta_unit: str | None = None,
    delta_tol: float | None = None,
    all_pairs: bool = False,
    pairs_from_reference: bool = False,
    align: str = "none",
    relation: str = "trans_part",
    n_to_align: int = 0,
    plane: str | None = None,
    kitti: bool = False,
    every_pair: bool = False,
    reference_stamps_ns: Any = None,
    estimate_stamps_ns: Any = None,
    t_max_diff_s: float | None = None,
    t_offset_s: float | None = None,
    one_to_one: bool = False,
    interpolate: bool = False,
    threads: int = 0,
) -> TrajectoryErrors:
    """Relative pose error: how much the motion from pose i to pose j differs between estimate and reference.

    delta, delta_unit: distance of the poses of a pair, in "f" frames, "m" metres, "d" degrees, "r" radians; None: 1 f.
    all_pairs: all pairs that far apart, not consecutive ones only; delta_tol: how far a pair may be off, relative.
    pairs_from_reference: distances are measured along the reference, not the estimate.
    kitti: also the drift of KITTI's benchmark. every_pair: also the errors of all pairs i < j, and the paper's RPE.
    Other arguments and errors: as ape(); relation also "point_distance_error_ratio".
    Source: Sturm et al., 2012; evo; docs/definitions.md#rpe.
    """
    pairs = set_given(
        _core.PosePairSettings(), delta=delta, delta_unit=delta_unit, delta_tol=delta_tol, all_pairs=all_pairs
    )
    return _result_of(
        _core.rpe(
            *_inputs(reference, reference_stamps_ns, "reference"),
            *_inputs(estimate, estimate_stamps_ns, "estimate"),
            relation,
            align,
            n_to_align,
            plane,
            _association(t_max_diff_s, t_offset_s, one_to_one, interpolate),
            pairs,
            pairs_from_reference,
            kitti,
            every_pair,
            as_threads(threads),
        )
    )


def perturb(
    poses: Any, *, translation_m: float = 0, rotation_deg: float = 0, model: str = "white", seed: int = 0
) -> NDArray[np.float64]:
    """(M, 4, 4) poses with normal errors, per axis: "white" for every pose, or a random "walk".

    translation_m: standard deviation along each axis of the world [m]; rotation_deg: of the rotation vector, in the
    frame of the scan. The same seed gives the same errors. Raises InvalidArgument. Source: the paper, section V-A.
    """
    return _core.perturb(as_poses(poses, "poses"), translation_m, rotation_deg, model, seed)
