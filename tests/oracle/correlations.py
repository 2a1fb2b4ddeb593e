#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The correlations against scipy, with and without ties: tests/oracle/correlations.py PATH/TO/trysquare_correlations

Needs Python 3.10 with numpy and scipy.
"""

import subprocess
import sys

import numpy as np
from scipy import stats

TOLERANCE = 1e-12


def cases():
    """Pairs (name, x, y): many and few values, ties in either or both, steep and flat, large and small numbers."""
    generator = np.random.default_rng(2021)
    for n in (2, 3, 5, 10, 37, 200, 2001, 20000):
        for levels in (2, 3, 10, 1000, None):
            x = generator.normal(size=n)
            y = 0.6 * x + generator.normal(size=n)
            if levels is not None:
                x, y = (np.round(v * levels / 4) for v in (x, y))
            for scale, offset in ((1, 0), (1e-9, 1), (1e12, -5e12)):
                if np.ptp(x) > 0 and np.ptp(y) > 0:
                    yield f"n={n} levels={levels} scale={scale}", x, scale * y + offset
    ramp = np.arange(100.0)
    yield "rising", ramp, ramp**3
    yield "falling", ramp, -ramp
    yield "one tie in x", np.array([1.0, 1, 2, 3]), np.array([1.0, 2, 2, 0])


def main():
    all_cases = list(cases())
    text = ""
    for _, x, y in all_cases:
        text += f"{len(x)}\n" + "".join(f"{a!r} {b!r}\n" for a, b in zip(x.tolist(), y.tolist()))
    output = subprocess.run([sys.argv[1]], input=text, capture_output=True, text=True, check=True).stdout.splitlines()
    assert len(output) == len(all_cases), (len(output), len(all_cases))
    worst = 0.0
    for (name, x, y), line in zip(all_cases, output):
        expected = (stats.pearsonr(x, y)[0], stats.spearmanr(x, y)[0], stats.kendalltau(x, y, variant="b")[0])
        for coefficient, ours, theirs in zip(("Pearson", "Spearman", "Kendall"), map(float, line.split()), expected):
            difference = abs(ours - theirs)
            worst = max(worst, difference)
            if not difference <= TOLERANCE:
                print(f"{name}: {coefficient} is {ours!r}, scipy says {theirs!r}")
                return 1
    print(f"{len(all_cases)} cases, largest difference {worst:.2g}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
