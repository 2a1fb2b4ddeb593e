#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs trysquare and its peers, alternating, each in a process of its own, and writes the table of README.md.

usage: compare.py --build FOLDER --maps FOLDER [--kitti FOLDER] [--python PATH] [--quick] [--output README.md]
"""

import argparse
import json
import math
import pathlib
import platform
import statistics
import subprocess
import sys

BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"
# What a query costs, roughly, in microseconds at 1000 neighbors: only to choose how many queries a peer gets.
COST_US = {"nanoflann": 25, "pcl": 40, "small_gicp": 25, "map-metrics": 900}
SECONDS_A_RUN = 2.0


def call(command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: {done.stderr.strip()[-500:]}")
    return json.loads(done.stdout.strip().splitlines()[-1])


def micros(result):
    """Time of one query, with its share of the index."""
    return 1e6 * (result["build_user_s"] / result["num_points"] + result["query_user_s"] / result["num_queries"])


def median_of(results):
    return statistics.median(micros(result) for result in results)


class Bench:
    def __init__(self, arguments):
        self.arguments = arguments
        self.program = arguments.build / "benchmarks" / "trysquare_neighborhood_peers"
        self.engines = [name for name in call([self.program, "--list"])["engines"] if not name.startswith("trysquare")]
        self.missing = {name: "not found when this was built" for name in ("pcl", "small_gicp")
                        if name not in self.engines}
        self.versions = {k: v for k, v in call([self.program, "--list"])["engines"].items() if k in self.engines}
        self.compiler = call([self.program, "--list"])["compiler"]
        self.python_peers()

    def python_peers(self):
        script = pathlib.Path(__file__).with_name("peers_python.py")
        self.python = [self.arguments.python, script] if self.arguments.python else None
        try:
            if not self.python:
                raise RuntimeError("no Python with open3d was given")
            self.versions.update(call([*self.python, "--version"]))
            self.engines += ["open3d", "map-metrics"]
        except (RuntimeError, OSError) as error:
            self.missing.update({"open3d": str(error), "map-metrics": str(error)})

    def run(self, engine, num_scans, radius, every, *more):
        program = self.python if engine in ("open3d", "map-metrics") else [self.program]
        return call([*program, "--engine", engine, "--map", self.arguments.maps / f"map_{num_scans}.f64", "--radius",
                     radius, "--every", every, *more])

    def every_for(self, engine, ours):
        """One block of queries out of so many that a run takes some seconds."""
        if engine not in COST_US:
            return 1
        cost_s = 1e-6 * COST_US[engine] * max(ours["neighbors_mean"] / 1000, 0.1) * ours["num_points"]
        return max(1, min(math.ceil(cost_s / SECONDS_A_RUN), ours["num_points"] // (64 * 4)))

    def cell(self, num_scans, radius):
        """All engines on one map with one radius: medians of alternating runs."""
        ours = self.run("trysquare", num_scans, radius, 1)
        every = {engine: self.every_for(engine, ours) for engine in self.engines}
        runs = {"trysquare": [ours]}
        # The kernel counts time in ticks: runs of less than a tenth of a second need more of them.
        is_short = num_scans == 1 and not self.arguments.quick
        for repeat in range(self.arguments.repeats * (3 if is_short else 1)):
            if repeat > 0:
                runs["trysquare"].append(self.run("trysquare", num_scans, radius, 1))
            for engine in self.engines:
                if engine == "open3d" and num_scans > 1:
                    continue  # it has no subset of queries, and would take minutes
                if engine in ("open3d", "map-metrics") and repeat >= self.arguments.repeats:
                    continue
                runs.setdefault(engine, []).append(self.run(engine, num_scans, radius, every[engine]))
        self.check_neighbors(num_scans, radius, every["nanoflann"], runs["nanoflann"][0])
        visitor = self.run("trysquare-visitor", num_scans, radius, 1)
        # The points take 24 bytes and their scan 4; what the process takes without them is not the engine's.
        bytes_a_point = 28 + (visitor["peak_rss_bytes"] - visitor["rss_before_bytes"]) / visitor["num_points"]
        row = {"num_scans": num_scans, "radius_m": radius, "neighbors": ours["neighbors_mean"],
               "bytes_a_point": bytes_a_point, "us": {name: median_of(each) for name, each in runs.items()},
               "queries": {name: each[0]["num_queries"] for name, each in runs.items()}}
        print(json.dumps(row), flush=True)
        return row

    def check_neighbors(self, num_scans, radius, every, nanoflann):
        same_queries = self.run("trysquare", num_scans, radius, every)
        if same_queries["neighbors_sum"] != nanoflann["neighbors_sum"]:
            sys.exit(f"trysquare and nanoflann differ: {same_queries} {nanoflann}")
        for name in ("mpv", "mme"):
            if abs(same_queries[name] - nanoflann[name]) > 1e-9 * abs(nanoflann[name]):
                sys.exit(f"trysquare and nanoflann differ in {name}: {same_queries} {nanoflann}")

    def threads(self, num_scans, radius):
        one = [self.run("trysquare", num_scans, radius, 1)["wall_s"] for _ in range(self.arguments.repeats)]
        two = [self.run("trysquare", num_scans, radius, 1, "--threads", 2)["wall_s"]
               for _ in range(self.arguments.repeats)]
        return statistics.median(one) / statistics.median(two)

    def fixed_queries(self, num_scans, radius):
        result = self.run("trysquare", num_scans, radius, 1, "--fixed-scan0")
        return 1e6 * result["query_user_s"] / result["num_queries"], result["neighbors_mean"]

    def self_queries(self, num_scans, radius):
        result = self.run("trysquare", num_scans, radius, 1)
        return 1e6 * result["query_user_s"] / result["num_queries"], result["neighbors_mean"]

    def mom(self, local):
        """Short runs, whose times scatter: more of them."""
        flags = ["--local"] if local else []
        program = self.arguments.build / "benchmarks" / "trysquare_mom_peers"
        runs = {"trysquare": [], "nanoflann": [], "map-metrics": []}
        for _ in range(max(self.arguments.repeats, 1 if self.arguments.quick else 7)):
            for engine in ("trysquare", "nanoflann"):
                runs[engine].append(call([program, self.arguments.kitti, "--engine", engine, *flags]))
            if self.python and "map-metrics" in self.engines:
                runs["map-metrics"].append(call([*self.python, "--mom", self.arguments.kitti, *flags]))
        if runs["trysquare"][0]["neighbors_sum"] != runs["nanoflann"][0]["neighbors_sum"]:
            sys.exit(f"trysquare and nanoflann differ in MOM: {runs}")
        return runs


def exponent(first, last):
    return math.log(last[0] / first[0]) / math.log(last[1] / first[1])


def cpu_name():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor()


def table(rows, engines):
    lines = ["| scans | r [m] | neighbors | trysquare [µs] | " + " | ".join(engines) + " | peak bytes a point |",
             "|--:|--:|--:|--:|" + "--:|" * (len(engines) + 1)]
    for row in rows:
        ours = row["us"]["trysquare"]
        cells = [f"{row['us'][name]:.3g} ({row['us'][name] / ours:.3g}×)" if name in row["us"] else "–"
                 for name in engines]
        lines.append(f"| {row['num_scans']} | {row['radius_m']} | {row['neighbors']:.0f} | {ours:.3f} | "
                     + " | ".join(cells) + f" | {row['bytes_a_point']:.1f} |")
    return lines


def report(bench, rows):
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    lines = [f"Machine: {cpu_name()}, one thread unless said otherwise. Commit {commit}. Compiler: {bench.compiler}. "
             + "Peers: " + ", ".join(f"{name} {version}" for name, version in sorted(bench.versions.items())) + ".",
             *(f"Not measured: {name} ({why})." for name, why in bench.missing.items()), "",
             "User CPU time of one query in microseconds, its share of building the index included (median of "
             f"{bench.arguments.repeats} alternating runs, of one scan {3 * bench.arguments.repeats}); in brackets the ratio to "
             "trysquare.", ""]
    lines += table(rows, bench.engines)
    lines += ["", "Subsets of queries: " + "; ".join(
        f"{name}: {min(r['queries'][name] for r in rows if name in r['queries'])} to "
        f"{max(r['queries'][name] for r in rows if name in r['queries'])} of the points" for name in bench.engines
        if name != "open3d") + ". trysquare and open3d: all points."]
    last = bench.arguments.scans[-1]
    own = exponent(bench.self_queries(1, 1.0), bench.self_queries(last, 1.0))
    fixed = exponent(bench.fixed_queries(1, 1.0), bench.fixed_queries(last, 1.0))
    lines += ["", f"Time of a query grows with (neighbors)^{own:.2f} from 1 to {last} scans at r = 1.0 m when all points are "
              f"queries, and with (neighbors)^{fixed:.2f} when the queries stay those of scan 0 (without the index).",
              f"Two threads: {bench.threads(last, 1.0):.2f}× one (wall clock, {last} scans, r = 1.0 m)."]
    if bench.arguments.kitti:
        for local in (True, False):
            runs = bench.mom(local)
            time_s = {name: statistics.median(run["user_s"] for run in each) for name, each in runs.items() if each}
            ours = runs["trysquare"][0]
            text = (f"MOM's neighborhoods of 2000 queries {'in a patch' if local else 'all over the scan'}, 20 scans, "
                    f"r = 1.0 m, reading the files included: {1e3 * time_s['trysquare']:.0f} ms user, peak "
                    f"{ours['peak_rss_bytes'] / 1e6:.0f} MB; nanoflann, tree and queries alone: "
                    f"{1e3 * time_s['nanoflann']:.0f} ms ({time_s['nanoflann'] / time_s['trysquare']:.0f}×)")
            if runs["map-metrics"]:
                off = abs(ours["median_m2"] / runs["map-metrics"][0]["median_m2"] - 1)
                text += (f"; map-metrics' mom, reading included: {1e3 * time_s['map-metrics']:.0f} ms "
                         f"({time_s['map-metrics'] / time_s['trysquare']:.0f}×), medians differ by {off:.1e}")
            lines += [text + "."]
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--maps", type=pathlib.Path, required=True)
    parser.add_argument("--kitti", type=pathlib.Path)
    parser.add_argument("--python", help="an interpreter that has open3d and numpy")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--radii", type=float, nargs="+", default=[0.3, 0.5, 1.0])
    parser.add_argument("--scans", type=int, nargs="+", default=[1, 5, 10, 20])
    parser.add_argument("--quick", action="store_true", help="1 and 5 scans, one repeat: does it run?")
    parser.add_argument("--output", type=pathlib.Path, help="a file with the two markers; default: the terminal")
    arguments = parser.parse_args()
    if arguments.quick:
        arguments.scans, arguments.repeats = [1, 5], 1
    bench = Bench(arguments)
    rows = [bench.cell(num_scans, radius) for num_scans in arguments.scans for radius in arguments.radii]
    text = "\n".join(report(bench, rows))
    if not arguments.output:
        print(text)
        return
    page = arguments.output.read_text()
    head, tail = page.split(BEGIN)[0], page.split(END)[1]
    arguments.output.write_text(f"{head}{BEGIN}\n{text}\n{END}{tail}")


if __name__ == "__main__":
    main()
