# SPDX-License-Identifier: Apache-2.0
"""The settings of map-metrics, under its names. A class and an object of it serve alike."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from trysquare import _core

__all__ = ["BaseConfig", "CustomConfig", "DepthConfig", "LidarConfig"]


class BaseConfig:
    """Names of the settings, without values. Subclasses, and any object with these attributes, will do as a config."""

    KNN_RAD: Any = None  # radius of the neighborhoods [m]
    MIN_KNN: Any = None  # neighborhoods of more points than this are used; the query counts
    MAX_NN: Any = None  # normals come from at most so many nearest points
    MIN_CLUST_SIZE: Any = None  # clusters of more normals than this may become a direction


class LidarConfig(BaseConfig):
    """For scans of a street: 1 m."""

    KNN_RAD = 1.0
    MIN_KNN = 5
    MAX_NN = 30
    MIN_CLUST_SIZE = 5


class DepthConfig(BaseConfig):
    """For depth cameras in a room: 0.2 m."""

    KNN_RAD = 0.2
    MIN_KNN = 5
    MAX_NN = 30
    MIN_CLUST_SIZE = 5


class CustomConfig(BaseConfig):
    """Settings of your own; what is left out is as in `LidarConfig`."""

    def __init__(self, knn_rad: float = 1.0, min_knn: int = 5, max_nn: int = 30, min_clust_size: int = 5) -> None:
        self.KNN_RAD = knn_rad
        self.MIN_KNN = min_knn
        self.MAX_NN = max_nn
        self.MIN_CLUST_SIZE = min_clust_size


def radius_of(config: Any) -> float:
    """KNN_RAD [m], > 0 and finite. InvalidArgument otherwise."""
    return _number(config, "KNN_RAD", "a finite number > 0", lambda value: 0 < value < math.inf)


def more_than(config: Any, name: str) -> int:
    """The least whole number above the setting `name`, a bound that must be passed. InvalidArgument if that is < 0."""
    return math.floor(_number(config, name, "a number >= 0", lambda value: 0 <= value < 2**31)) + 1


def max_nearest_of(config: Any) -> int:
    """MAX_NN, >= 3. InvalidArgument otherwise."""
    return int(_number(config, "MAX_NN", "a whole number >= 3", lambda value: 3 <= value < 2**31 and value % 1 == 0))


def _number(config: Any, name: str, expected: str, is_fine: Callable[[float], bool]) -> float:
    value: Any = getattr(config, name, None)
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if isinstance(value, bool) or not is_fine(number):
        raise _core.InvalidArgument(f"config.{name} = {value!r}: expected {expected}")
    return number
