# SPDX-License-Identifier: Apache-2.0
"""Rigid motions and small scenes with the standard library. A pose is 3 rows of 4 numbers, world_from_scan."""

import math
import random
import struct


def identity():
    return [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]


def pose(yaw=0.0, pitch=0.0, roll=0.0, translation=(0.0, 0.0, 0.0)):
    """Rz(yaw) · Ry(pitch) · Rx(roll), angles in radians, and a translation in metres."""
    cy, sy, cp, sp, cr, sr = (f(a) for a in (yaw, pitch, roll) for f in (math.cos, math.sin))
    x, y, z = translation
    return [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, x],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, y],
        [-sp, cp * sr, cp * cr, z],
    ]


def apply(transform, point):
    return tuple(sum(row[k] * point[k] for k in range(3)) + row[3] for row in transform)


def compose(a, b):
    """a · b"""
    columns = [[sum(row[k] * b[k][j] for k in range(3)) for j in range(4)] for row in a]
    return [[*c[:3], c[3] + row[3]] for c, row in zip(columns, a, strict=True)]


def inverse(transform):
    """The general inverse: poses are orthonormal only to the digits that were printed."""
    (a, b, c, x), (d, e, f, y), (g, h, i, z) = transform
    cofactors = [
        [e * i - f * h, c * h - b * i, b * f - c * e],
        [f * g - d * i, a * i - c * g, c * d - a * f],
        [d * h - e * g, b * g - a * h, a * e - b * d],
    ]
    determinant = a * cofactors[0][0] + b * cofactors[1][0] + c * cofactors[2][0]
    linear = [[value / determinant for value in row] for row in cofactors]
    return [[*row, -(row[0] * x + row[1] * y + row[2] * z)] for row in linear]


def scaled(transform, scale):
    return [[*row[:3], scale * row[3]] for row in transform]


def as_float32(points):
    """The same points as a float32 file holds them."""
    return [struct.unpack("<3f", struct.pack("<3f", *p)) for p in points]


def sensor_path(num_scans):
    """A sensor that moves and turns a little, well inside the corner, on a curve: a line would not fix an alignment."""
    return [
        pose(
            0.11 * i,
            0.02 * math.sin(i),
            0.015 * math.cos(2 * i),
            (1.0 + 0.13 * i, 1.2 + 0.4 * math.sin(0.5 * i), 0.9 + 0.1 * math.cos(0.7 * i)),
        )
        for i in range(num_scans)
    ]


def corner(num_scans=5, per_plane=150, size_m=3.0, noise_m=0.01, seed=0):
    """A floor and two walls, seen from a moving sensor.

    Returns scans (points in the scan frame, representable in float32) and world_from_scan poses.
    """
    rng = random.Random(seed)
    poses = sensor_path(num_scans)
    scans = []
    for transform in poses:
        points_in_world = []
        for normal_axis in range(3):
            for _ in range(per_plane):
                point = [size_m * rng.random() for _ in range(3)]
                point[normal_axis] = rng.gauss(0.0, noise_m)
                points_in_world.append(tuple(point))
        scan_from_world = inverse(transform)
        scans.append(as_float32([apply(scan_from_world, p) for p in points_in_world]))
    return scans, poses


def corner_subset(poses, per_direction=25, size_m=3.0, seed=1):
    """Query points on the three planes of corner(), in the map frame (that of the first scan)."""
    rng = random.Random(seed)
    map_from_world = inverse(poses[0])
    directions = []
    for normal_axis in range(3):
        points = []
        for _ in range(per_direction):
            point = [0.3 + (size_m - 0.6) * rng.random() for _ in range(3)]
            point[normal_axis] = 0.0
            points.append(apply(map_from_world, point))
        directions.append(points)
    return directions
