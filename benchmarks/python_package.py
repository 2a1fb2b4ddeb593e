#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the Python package and writes README-python.md: speed against map-metrics, memory, import.

Speed is mme and mpv of one whole scan through trysquare.compat.map_metrics, against the loops of map-metrics 0.0.4
written here with Open3D's tree and numpy, in this process. Both must give the same before a ratio is written.

    python benchmarks/python_package.py KITTI_FOLDER --output benchmarks/README-python.md

KITTI_FOLDER has velodyne/000000.bin. Needs open3d, numpy and trysquare.
"""

from __future__ import annotations

import argparse
import dataclasses
import functools
import importlib.metadata
import os
import platform
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import open3d as o3d

import trysquare as ts
from trysquare.compat import map_metrics

RELATIVE_TOLERANCE = 1e-9
GOAL = 300


@dataclasses.dataclass
class Row:
    """One metric: our wall-clock times and the median of our CPU times, those of the loop [s], relative difference."""

    name: str
    wall: list[float]
    cpu: float
    loop_wall: float
    loop_cpu: float
    difference: float

    @property
    def median(self) -> float:
        return statistics.median(self.wall)

    def __str__(self) -> str:
        ours = f"{self.median:.3f} ({min(self.wall):.3f} to {max(self.wall):.3f})"
        return (
            f"| {self.name} | {ours} | {self.loop_wall:.1f} | {self.loop_wall / self.median:.0f}× | {self.cpu:.3f} | "
            f"{self.loop_cpu:.1f} | {self.loop_cpu / self.cpu:.0f}× | {self.difference:.0e} |"
        )


def neighborhoods(points: Any, radius_m: float) -> Any:
    """map-metrics' loop: a tree, a search for each point, and the neighborhoods of more than five points."""
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
    tree = o3d.geometry.KDTreeFlann(cloud)
    points = np.asarray(cloud.points)
    for point in points:
        _, index, _ = tree.search_radius_vector_3d(point, radius_m)
        if len(index) > 5:
            yield points[index]


def loop_mpv(points: Any, radius_m: float) -> float:
    variances = [min(np.linalg.eig(np.cov(near.T))[0]) for near in neighborhoods(points, radius_m)]
    return float(np.mean(variances))


def loop_mme(points: Any, radius_m: float) -> float:
    determinants = [np.linalg.det(2 * np.pi * np.e * np.cov(near.T)) for near in neighborhoods(points, radius_m)]
    return float(np.mean([0.5 * np.log(determinant) for determinant in determinants if determinant > 0]))


def timed(call: Callable[[], float]) -> tuple[float, float, float]:
    """Value, wall-clock seconds and CPU seconds of all threads."""
    start, cpu_start = time.perf_counter(), time.process_time()
    value = call()
    return value, time.perf_counter() - start, time.process_time() - cpu_start


def require_equal(name: str, ours: float, theirs: float) -> float:
    """Relative difference; ends the program when it is too large to speak of the same number."""
    difference = abs(ours / theirs - 1)
    if not difference < RELATIVE_TOLERANCE:
        sys.exit(f"{name}: trysquare {ours!r}, loop {theirs!r}: they differ by {difference:.1e}, no ratio is written")
    return difference


def speed(scan: Path, radius_m: float, repeats: int) -> dict[str, Any]:
    points = np.fromfile(scan, np.float32).reshape(-1, 4)[:, :3].astype(np.float64)
    config, poses = map_metrics.CustomConfig(knn_rad=radius_m), [np.eye(4)]
    calls = {"mme": (map_metrics.mme, loop_mme), "mpv": (map_metrics.mpv, loop_mpv)}
    ours: dict[str, list[tuple[float, float, float]]] = {name: [] for name in calls}
    load = [os.getloadavg()[0]]
    for _ in range(repeats):
        for name, (call, _) in calls.items():
            ours[name].append(timed(functools.partial(call, [points], poses, config)))
    load.append(os.getloadavg()[0])
    rows = []
    for name, (_, loop) in calls.items():
        theirs = timed(functools.partial(loop, points, radius_m))
        difference = require_equal(name, ours[name][0][0], theirs[0])
        wall, cpu = ([each[i] for each in ours[name]] for i in (1, 2))
        rows.append(Row(name, wall, statistics.median(cpu), theirs[1], theirs[2], difference))
    load.append(os.getloadavg()[0])
    return {"num_points": len(points), "rows": rows, "load": load}


def resident_mb() -> float:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def memory(num_calls: int = 1000) -> dict[str, float]:
    """Growth of the process over evaluations of two small scans, after a tenth as many to fill pools."""
    rng = np.random.default_rng(5)
    walls = rng.uniform(0.3, 3, (3, 500, 3))
    for axis in range(3):
        walls[axis, :, axis] = rng.normal(0, 0.01, 500)
    scans, poses = [walls.reshape(-1, 3) - 1] * 2, np.array([np.eye(4)] * 2)

    def repeat(count: int) -> float:
        for _ in range(count):
            ts.evaluate(scans, poses, radius_m=0.5, metrics=["mme", "mpv", "mom", "omme"])
        return resident_mb()

    before = repeat(num_calls // 10)
    after, seconds, _ = timed(functools.partial(repeat, num_calls))
    return {"num_calls": num_calls, "growth_mb": after - before, "ms": 1e3 * seconds / num_calls}


def import_ms(module: str, repeats: int = 7) -> float:
    """Median time of `import module` in a process of its own, numpy included."""
    code = f"import time; start = time.perf_counter(); import {module}; print(1e3 * (time.perf_counter() - start))"
    runs = [
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
        for _ in range(repeats)
    ]
    return statistics.median(map(float, runs))


def cpu_name() -> str:
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    return next(
        (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.processor()
    )


def page(fast: dict[str, Any], kept: dict[str, float], radius_m: float, repeats: int) -> str:
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("open3d", "numpy"))
    own, numpy_alone = import_ms("trysquare"), import_ms("numpy")
    rows: list[Row] = fast["rows"]
    wall = sum(row.loop_wall for row in rows) / sum(row.median for row in rows)
    cpu = sum(row.loop_cpu for row in rows) / sum(row.cpu for row in rows)
    load = ", ".join(f"{each:.1f}" for each in fast["load"])
    return "\n".join(
        [
            "# The Python package, measured",
            "",
            "Written by `python_package.py`; run it again to check.",
            "",
            f"Machine: {cpu_name()}, {os.cpu_count()} cores; load average before, between and after: {load}. "
            f"trysquare {ts.__version__}, {versions}, Python {platform.python_version()}.",
            "",
            "## Against map-metrics",
            "",
            f"`mme` and `mpv` of a whole scan of {fast['num_points']:,} points at r = {radius_m:g} m, through "
            "`trysquare.compat.map_metrics`, all cores, "
            "and the loop of map-metrics 0.0.4, written with Open3D's tree and numpy, in the same process. Seconds by "
            f"the clock on the wall, and of CPU time of all threads; ours: median of {repeats}, least and most in "
            "brackets; the loop: once.",
            "",
            "| | trysquare, wall | loop, wall | ratio | trysquare, CPU | loop, CPU | ratio | values differ by |",
            "|---|--:|--:|--:|--:|--:|--:|--:|",
            *map(str, rows),
            "",
            f"Both together: **{wall:.0f}×** by the wall (goal: {GOAL}×), {cpu:.0f}× in CPU time.",
            "",
            "## Memory",
            "",
            f"{kept['num_calls']:.0f} evaluations of two scans of 1,500 points ({kept['ms']:.1f} ms each): the process "
            f"grows by {kept['growth_mb']:.1f} MB.",
            "",
            "## Import",
            "",
            f"`import trysquare` takes {own:.0f} ms, of which `import numpy` takes {numpy_alone:.0f} ms (medians of 7 "
            "processes).",
            "",
        ]
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kitti", type=Path)
    parser.add_argument("--radius", type=float, default=1.0)
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--output", type=Path, help="default: the terminal")
    arguments = parser.parse_args()
    kept = memory()
    fast = speed(arguments.kitti / "velodyne" / "000000.bin", arguments.radius, arguments.repeats)
    text = page(fast, kept, arguments.radius, arguments.repeats)
    if arguments.output:
        arguments.output.write_text(text)
    else:
        print(text)


if __name__ == "__main__":
    main()
