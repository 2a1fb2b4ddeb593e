# SPDX-License-Identifier: Apache-2.0
"""The drop-in of map-metrics on the test data of the original, whose folder is in TRYSQUARE_DATA or ../shared/data.

The values are those of map-metrics 0.0.4 with open3d 0.18.0 and numpy 1.26.4 on the 28 clouds of arcore-depth:

    mme(pcs, ts, DepthConfig), mpv(pcs, ts, DepthConfig)
    orth = read_orthogonal_subset("orth_subset/orth-0091.npy", "poses/pose-0091.txt", ts)
    mom(pcs, ts, orth, DepthConfig), mom(pcs, ts, orth), mom(pcs, ts, orth, CustomConfig(knn_rad=0.3, min_knn=8))
    mme(pcs[:5], ts[:5], CustomConfig(knn_rad=0.3, min_knn=8)), mpv(...)
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trysquare as ts
from trysquare.compat.map_metrics import CustomConfig, DepthConfig, mme, mom, mpv, read_orthogonal_subset

DEPTH = Path(os.environ.get("TRYSQUARE_DATA", Path(__file__).parents[3] / "shared" / "data")) / "arcore-depth"
pytestmark = pytest.mark.skipif(not DEPTH.is_dir(), reason="no arcore-depth in TRYSQUARE_DATA")
CUSTOM = CustomConfig(knn_rad=0.3, min_knn=8)


@pytest.fixture(scope="module")
def clouds() -> list[Any]:
    return [ts.read_points(file) for file in sorted(DEPTH.glob("pcs/*.pcd"))]


@pytest.fixture(scope="module")
def poses() -> list[Any]:
    return [np.loadtxt(file, usecols=range(4)) for file in sorted(DEPTH.glob("poses/*.txt"))]


@pytest.fixture(scope="module")
def subset(poses: list[Any]) -> list[Any]:
    return read_orthogonal_subset(DEPTH / "orth_subset" / "orth-0091-*.npy", DEPTH / "poses" / "pose-0091.txt", poses)


def test_values_of_the_original_on_its_own_data(clouds: Any, poses: Any, subset: Any) -> None:
    assert len(clouds) == len(poses) == 28
    assert mme(clouds, poses, DepthConfig) == pytest.approx(-3.6144387057257523, rel=1e-9)
    assert mpv(clouds, poses, DepthConfig) == pytest.approx(0.0025390347963358557, rel=1e-9)
    assert mom(clouds, poses, subset, DepthConfig) == pytest.approx(0.006183082336713367, rel=1e-9)


def test_other_settings_on_the_data_of_the_original(clouds: Any, poses: Any, subset: Any) -> None:
    assert mom(clouds, poses, subset) == pytest.approx(0.14503660228500864, rel=1e-9)
    assert mom(clouds, poses, subset, CUSTOM) == pytest.approx(0.010053454383736804, rel=1e-9)
    assert mme(clouds[:5], poses[:5], CUSTOM) == pytest.approx(-2.6479367065290007, rel=1e-9)
    assert mpv(clouds[:5], poses[:5], CUSTOM) == pytest.approx(0.004426902629080057, rel=1e-9)


def test_the_pickled_subset_of_the_original_is_refused(poses: Any) -> None:
    with pytest.raises(ts.IoError, match=r"orth-0091\.npy: .*found a pickle.*numpy\.savez"):
        read_orthogonal_subset(DEPTH / "orth_subset" / "orth-0091.npy", DEPTH / "poses" / "pose-0091.txt", poses)
