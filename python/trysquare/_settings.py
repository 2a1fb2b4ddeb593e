# SPDX-License-Identifier: Apache-2.0
"""Settings of the library, whose defaults have one home: C++. An argument that is None leaves the default."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np

from trysquare import _core

Settings = TypeVar("Settings")

PRESETS = ("lidar", "depth")


def set_given(settings: Settings, **given: Any) -> Settings:
    """Sets what is not None; a value of the wrong type is named."""
    for name, value in given.items():
        if value is None:
            continue
        try:
            setattr(settings, name, value)
        except (TypeError, OverflowError) as error:
            default = getattr(settings, name)
            expected = "a whole number of at least 0" if default is None else f"a value like {default!r}"
            raise _core.InvalidArgument(f"{name} = {value!r}: expected {expected}") from error
    return settings


def _require_preset(preset: str) -> None:
    if preset not in PRESETS:
        raise _core.InvalidArgument(f"preset = {preset!r} is not known: expected lidar or depth")


def evaluation_settings(
    preset: str = "lidar", metrics: Any = None, min_neighbors: int | None = None, **given: Any
) -> _core.EvaluationSettings:
    """Settings of an evaluation; `min_neighbors` holds for all metrics, as on the command line."""
    _require_preset(preset)
    settings = _core.EvaluationSettings.room_scale() if preset == "depth" else _core.EvaluationSettings()
    if isinstance(metrics, str):
        metrics = None if metrics == "all" else metrics.split(",")
    if metrics is not None and not hasattr(metrics, "__iter__"):
        raise _core.InvalidArgument(f"metrics = {metrics!r}: expected names such as mom and rpe")
    set_given(settings, metrics=None if metrics is None else list(metrics), **given)
    set_given(settings, min_neighbors=min_neighbors, min_neighbors_orthogonal=min_neighbors)
    settings.validate()
    return settings


def adjustment_settings(preset: str = "lidar", **given: Any) -> _core.AdjustmentSettings:
    """Settings of the estimate of the trajectory error."""
    _require_preset(preset)
    settings = _core.AdjustmentSettings.room_scale() if preset == "depth" else _core.AdjustmentSettings()
    set_given(settings, **given)
    settings.validate()
    return settings


def default_settings(preset: str = "lidar") -> dict[str, Any]:
    """What evaluate() uses where an argument is None, by the argument's name. Lengths in metres.

    Without min_neighbors, which is 6 for MME and MPV and 4 for MOM and OMME.
    """
    settings = evaluation_settings(preset)
    names = (
        "metrics definition radius_m query_every min_range_m max_range_m "
        "window stride subset_method subset_scans join_colinear"
    )
    return {name: getattr(settings, name) for name in names.split()}


MAX_THREADS = 1024


def as_threads(threads: Any) -> int:
    """A number of threads, 0 for all cores."""
    is_whole = isinstance(threads, (int, np.integer)) and not isinstance(threads, bool)
    if not is_whole or not 0 <= threads <= MAX_THREADS:
        raise _core.InvalidArgument(f"threads = {threads!r}: expected a whole number from 0 to {MAX_THREADS}")
    return int(threads)


def as_progress(progress: Any) -> Any:
    """Something that can be called, or None."""
    if progress is not None and not callable(progress):
        raise _core.InvalidArgument(f"progress: expected a function, found {type(progress).__name__}")
    return progress
