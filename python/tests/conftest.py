# SPDX-License-Identifier: Apache-2.0
"""What the tests share: real data where it is, and a small world with known answers."""

from __future__ import annotations

import os
import warnings
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

ROOT = Path(__file__).parents[2]


def data_folder() -> Path | None:
    """Real scans: TRYSQUARE_DATA, else ../shared/data beside the project."""
    folder = Path(os.environ.get("TRYSQUARE_DATA", ROOT.parent / "shared" / "data"))
    return folder if (folder / "kitti00").is_dir() else None


def pytest_report_header() -> str:
    found = data_folder()
    return f"real data: {found}" if found else "REAL DATA: NOT FOUND, its tests are SKIPPED; set TRYSQUARE_DATA"


@pytest.fixture(scope="session")
def data() -> Path:
    folder = data_folder()
    if folder is None:
        if os.environ.get("CI") == "true" and (ROOT.parent / "shared" / "data").is_dir():
            pytest.fail("CI has real data, but it was not found")
        pytest.skip("real data not found: set TRYSQUARE_DATA")
    return folder


@pytest.fixture(scope="session")
def oracle() -> Path:
    folder = ROOT.parent / "shared" / "oracle"
    if not folder.is_dir():
        pytest.skip("oracle not found")
    return folder


@pytest.fixture(scope="session")
def command() -> Path:
    """The command that lies in the package under test."""
    import trysquare

    program = Path(trysquare.__file__).parent / "bin" / "trysquare"
    if not program.is_file():
        pytest.fail(f"{program} is missing")
    return program


def corner(num_points: int, rng: np.random.Generator, noise_m: float = 0.01) -> NDArray[np.float64]:
    """Points on the floor and two walls of a room of 8 m, with normal noise along the normals."""
    points = []
    for axis in range(3):
        plane = rng.uniform(0.3, 8, (num_points // 3, 3))
        plane[:, axis] = rng.normal(0, noise_m, len(plane))
        points.append(plane)
    return np.concatenate(points)


def rotation_about_z(angle_rad: float) -> NDArray[np.float64]:
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def pose(angle_rad: float, position: list[float]) -> NDArray[np.float64]:
    matrix = np.eye(4)
    matrix[:3, :3] = rotation_about_z(angle_rad)
    matrix[:3, 3] = position
    return matrix


@pytest.fixture(scope="session")
def room() -> tuple[list[NDArray[np.float64]], NDArray[np.float64]]:
    """Six scans of a corner with their true poses; the sensor walks through the room."""
    rng = np.random.default_rng(7)
    poses = np.array([pose(0.1 * i, [3 + 0.2 * i, 3 + 0.1 * i, 1.5]) for i in range(6)])
    scans = []
    for world_from_scan in poses:
        in_world = corner(12000, rng)
        rotation, position = world_from_scan[:3, :3], world_from_scan[:3, 3]
        scans.append((in_world - position) @ rotation)
    return scans, poses


@pytest.fixture(autouse=True)
def warnings_are_seen() -> None:
    warnings.simplefilter("always")
