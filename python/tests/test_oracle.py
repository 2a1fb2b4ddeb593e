# SPDX-License-Identifier: Apache-2.0
"""The expected values of the real data: KITTI 00, scans 0 to 19, and the depth camera's sequence."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import trysquare as ts


@pytest.fixture(scope="module")
def expected(oracle: Path) -> Any:
    return json.loads((oracle / "map_oracle.json").read_text())


@pytest.fixture(scope="module")
def kitti(data: Path) -> Any:
    return ts.load(data / "kitti00" / "velodyne", data / "kitti00" / "poses.txt")


@pytest.mark.parametrize("radius", [0.5, 1.0])
@pytest.mark.parametrize("method", ["reference", "paper"])
def test_kitti_has_the_oracles_numbers(kitti: Any, oracle: Path, expected: Any, radius: float, method: str) -> None:
    subset = [np.load(oracle / f"kitti_orth_{method}_{i}.npy") for i in range(3)]
    metrics = ["mme", "mpv", "mom", "omme"]
    result = ts.evaluate(*kitti, radius_m=radius, query_every=50, metrics=metrics, subset=subset)
    known = expected["kitti"]["gt_calibrated"][f"r{radius}"]
    assert result.mme is not None and result.mpv is not None and result.mom is not None and result.omme is not None
    assert_allclose(result.mme.value, known["mme"], rtol=1e-9)
    assert_allclose(result.mpv.value, known["mpv"], rtol=1e-9)
    assert result.mpv.num_used == known["used"]
    of_subset = known[f"orth_{method}"]
    assert_allclose(result.mom.value, of_subset["mom_paper"], rtol=1e-9)
    assert_allclose(result.mom.sum_of_medians, of_subset["mom_reference"], rtol=1e-9)
    assert_allclose(result.omme.value, of_subset["omme_paper"], rtol=1e-9)


def test_the_depth_set_has_the_oracles_numbers(data: Path, expected: Any) -> None:
    depth = data / "arcore-depth"
    scans, poses = ts.load(depth / "pcs", depth / "poses")
    of_scan = ts.read_trajectory(depth / "poses" / "pose-0091.txt").poses[0]
    map_from_scan = np.linalg.inv(poses[0]) @ of_scan
    files = sorted((depth / "orth_subset").glob("orth-0091-*.npy"))
    subset = [np.load(file) @ map_from_scan[:3, :3].T + map_from_scan[:3, 3] for file in files]
    result = ts.evaluate(scans, poses, preset="depth", metrics=["mme", "mpv", "mom"], subset=subset)
    known = expected["depth"]
    assert result.inputs.num_points == known["n_points"]
    assert result.mme is not None and result.mpv is not None and result.mom is not None
    assert_allclose(result.mme.value, known["mme_paper"]["value"], rtol=1e-9)
    assert_allclose(result.mpv.value, known["mpv_paper"]["value"], rtol=1e-9)
    assert result.mme.num_used == known["mme_paper"]["used"]
    assert_allclose(result.mom.value, known["mom_paper"]["value"], rtol=1e-9)
    assert_allclose(result.mom.sum_of_medians, known["mom_reference"]["value"], rtol=1e-9)


#: evo's names of the relations, and the command's.
RELATIONS = {
    "full_transformation": "full",
    "translation_part": "trans_part",
    "rotation_part": "rot_part",
    "rotation_angle_deg": "angle_deg",
}


def test_ape_has_evos_numbers(data: Path, oracle: Path) -> None:
    trajectories = data / "trajectories"
    reference = ts.read_trajectory(trajectories / "KITTI_00_gt.txt")
    estimate = ts.read_trajectory(trajectories / "KITTI_00_ORB.txt")
    records = json.loads((oracle / "trajectory_oracle.json").read_text())["records"]
    known = [each for each in records if each["case"] == "KITTI_00_ORB" and each["metric"] == "APE"]
    known = [each for each in known if each["relation"] in RELATIONS and each["align"] in ("none", "se3", "sim3")]
    assert len(known) >= 8
    for record in known:
        result = ts.ape(reference, estimate, align=record["align"], relation=RELATIONS[record["relation"]])
        assert result.statistics is not None and result.num_pairs == record["pairs"]
        for name, value in record["stats"].items():
            assert_allclose(getattr(result.statistics, name), value, rtol=1e-9, atol=1e-12, err_msg=str(record))
