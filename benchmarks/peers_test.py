#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""trysquare and nanoflann find the same neighbors and values on a small map. usage: peers_test.py PROGRAM"""

import json
import random
import struct
import subprocess
import sys
import tempfile


def main():
    rng = random.Random(3)
    with tempfile.NamedTemporaryFile(suffix=".f64") as file:
        for i in range(6000):
            point = (rng.gauss(0, 3), round(rng.gauss(0, 0.02), 3), rng.gauss(0, 1))
            file.write(struct.pack("<4d", *point, i // 2000))
        file.flush()
        for every in (1, 7):
            results = []
            for engine in ("trysquare", "nanoflann"):
                command = [sys.argv[1], "--engine", engine, "--map", file.name, "--radius", "0.4", "--every", str(every)]
                results.append(json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout))
            ours, theirs = results
            assert ours["neighbors_sum"] == theirs["neighbors_sum"] > 0, results
            for name in ("mpv", "mme"):
                assert abs(ours[name] - theirs[name]) < 1e-9 * abs(theirs[name]), results


if __name__ == "__main__":
    main()
