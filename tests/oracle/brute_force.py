# SPDX-License-Identifier: Apache-2.0
"""The map metrics by brute force: every query against every map point, in plain Python.

An oracle, written from the definitions and from nothing else: no index, no blocks, no closed form. O(N·M), so for some
hundred points. Definitions: docs/definitions.md. Points are triples, poses 3 rows of 4 numbers (world_from_scan).
"""

import math
import statistics

LN_2PI_E = math.log(2.0 * math.pi * math.e)
DEGENERATE_RATIO = 1e-12
MAP_EVAL_LEAST_OTHERS = 10


def eigenvalues(matrix):
    """Ascending eigenvalues of a symmetric 3×3 matrix: cyclic Jacobi rotations until it is diagonal."""
    a = [list(row) for row in matrix]
    for _ in range(60):
        if a[0][1] == 0.0 and a[0][2] == 0.0 and a[1][2] == 0.0:
            break
        for p, q in ((0, 1), (0, 2), (1, 2)):
            if a[p][q] != 0.0:
                rotate(a, p, q)
    return sorted(a[i][i] for i in range(3))


def rotate(a, p, q):
    """One Jacobi rotation in place: makes a[p][q] zero. Golub & Van Loan, symmetric Schur decomposition."""
    scale = abs(a[p][p]) + abs(a[q][q])
    if abs(a[p][q]) <= 1e-40 * scale:
        a[p][q] = a[q][p] = 0.0
        return
    theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q])
    t = math.copysign(1.0, theta) / (abs(theta) + math.hypot(theta, 1.0))
    c = 1.0 / math.hypot(t, 1.0)
    s = t * c
    off_diagonal = a[p][q]
    a[p][p] -= t * off_diagonal
    a[q][q] += t * off_diagonal
    a[p][q] = a[q][p] = 0.0
    r = 3 - p - q
    a[r][p], a[r][q] = c * a[r][p] - s * a[r][q], s * a[r][p] + c * a[r][q]
    a[p][r], a[q][r] = a[r][p], a[r][q]


def covariance(points, divisor):
    """Two passes: the mean first, then fsum of the products about it."""
    n = len(points)
    mean = [math.fsum(p[k] for p in points) / n for k in range(3)]
    centred = [[p[k] - mean[k] for k in range(3)] for p in points]
    return [[math.fsum(d[i] * d[j] for d in centred) / divisor for j in range(3)] for i in range(3)]


def spectrum(points, divisor):
    """Eigenvalues clamped at 0, and whether they are degenerate. None for no positive divisor."""
    if divisor <= 0:
        return None, False
    values = [max(0.0, v) for v in eigenvalues(covariance(points, divisor))]
    return values, values[0] <= DEGENERATE_RATIO * values[2]


def log_determinant(values):
    return math.fsum(math.log(v) for v in values)


def neighbors(map_points, query, radius_m):
    """Indices of W(p): strictly nearer than the radius."""
    x, y, z = query
    limit = radius_m * radius_m
    return [
        i for i, (u, v, w) in enumerate(map_points) if (u - x) * (u - x) + (v - y) * (v - y) + (w - z) * (w - z) < limit
    ]


class PointValues:
    """What one query point is worth. None: undefined."""

    def __init__(self, num_neighbors, num_scans, plane_variance, entropy, degenerate):
        self.num_neighbors = num_neighbors
        self.num_scans = num_scans
        self.plane_variance = plane_variance
        self.entropy = entropy
        self.degenerate = degenerate


def entropy_of(definition, inside, query, min_neighbors):
    """h(p) in nats, or None, by the definition; and whether it is None for being degenerate."""
    if definition == "mapeval":  # the query itself is taken out, once; 1/2 ln(2 pi e det)
        others = list(inside)
        if query in others:
            others.remove(query)
        if len(others) < MAP_EVAL_LEAST_OTHERS:
            return None, False
        values, degenerate = spectrum(others, len(others) - 1)
        return (None, True) if degenerate else (0.5 * (LN_2PI_E + log_determinant(values)), False)
    if definition == "ais-bonn":  # any number of points, divisor n
        values, degenerate = spectrum(inside, len(inside))
    else:
        if len(inside) < min_neighbors:
            return None, False
        values, degenerate = spectrum(inside, len(inside) - 1)
    if values is None or degenerate:
        return None, degenerate
    return 0.5 * (3.0 * LN_2PI_E + log_determinant(values)), False


def point_values(map_points, scan_of_point, query, radius_m, min_neighbors, definition="paper"):
    indices = neighbors(map_points, query, radius_m)
    inside = [map_points[i] for i in indices]
    plane_variance = None
    if len(inside) >= min_neighbors:
        values, flat = spectrum(inside, len(inside) - 1)
        plane_variance = 0.0 if flat else values[0]
    entropy, degenerate = entropy_of(definition, inside, query, min_neighbors)
    num_scans = len({scan_of_point[i] for i in indices})
    return PointValues(len(inside), num_scans, plane_variance, entropy, degenerate)


def mean(values):
    """None for nothing: undefined is not 0."""
    return math.fsum(values) / len(values) if values else None


def mme(points, definition="paper"):
    """Mean map entropy and how many points entered it. AIS-Bonn counts what is undefined as 0."""
    defined = [p.entropy for p in points if p.entropy is not None]
    if definition == "ais-bonn" and defined:
        return math.fsum(defined) / len(points), len(defined)
    return mean(defined), len(defined)


def mpv(points):
    defined = [p.plane_variance for p in points if p.plane_variance is not None]
    return mean(defined), len(defined)


def overlap(points, min_neighbors):
    used = [p for p in points if p.num_neighbors >= min_neighbors]
    return {
        "scans_per_neighborhood_mean": mean([p.num_scans for p in used]),
        "multi_scan_share": mean([1.0 if p.num_scans >= 2 else 0.0 for p in used]),
    }


def over_directions(values_by_direction):
    """MOM or OMME from the values of the query points by direction: both flavours, and each direction's figures."""
    directions = []
    for values in values_by_direction:
        defined = [v for v in values if v is not None]
        directions.append(
            {
                "num_points": len(values),
                "num_used": len(defined),
                "mean": mean(defined),
                "median": statistics.median(defined) if defined else None,
            }
        )
    means = [d["mean"] for d in directions if d["mean"] is not None]
    medians = [d["median"] for d in directions if d["median"] is not None]
    return {
        "mean_of_means": mean(means),
        "sum_of_medians": math.fsum(medians) if medians else None,
        "directions": directions,
    }


def orthogonal_metrics(map_points, scan_of_point, subset, radius_m, min_neighbors=4):
    """MOM and OMME of a precomputed subset, a list of query points by direction."""
    by_direction = [
        [point_values(map_points, scan_of_point, q, radius_m, min_neighbors) for q in direction] for direction in subset
    ]
    return {
        "mom": over_directions([[p.plane_variance for p in direction] for direction in by_direction]),
        "omme": over_directions([[p.entropy for p in direction] for direction in by_direction]),
    }
