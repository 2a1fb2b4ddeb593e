# SPDX-License-Identifier: Apache-2.0
"""Recordings of CARLA: PLY and transforms, left-handed, by frame number. The same world, written right-handed in KITTI's
layout, must give the same numbers."""

import json
import math
import struct

import geometry
import write_data
from support import CliTest

METRICS = ("mme", "mpv", "mom", "omme")
FIRST_FRAME = 412
OPTIONS = ("--radius", "0.5", "--subset-method", "paper")


def transforms(num_scans):
    """x y z [m] and roll pitch yaw [deg] of a LiDAR in CARLA: x forward, y right, z up; yaw clockwise from above."""
    return [
        {
            "x": 1.0 + 0.13 * i,
            "y": -1.2 - 0.4 * math.sin(0.5 * i),
            "z": 0.9 + 0.1 * math.cos(0.7 * i),
            "roll": 1.5 * math.cos(2.0 * i),
            "pitch": -2.0 * math.sin(i),
            "yaw": -6.0 * i,
        }
        for i in range(num_scans)
    ]


def right_handed(transform):
    """The pose with y to the left: Rz(-yaw) Ry(-pitch) Rx(roll), as CARLA's bridge to ROS has it."""
    roll, pitch, yaw = (math.radians(transform[key]) for key in ("roll", "pitch", "yaw"))
    return geometry.pose(-yaw, -pitch, roll, (transform["x"], -transform["y"], transform["z"]))


def points_of_corner(poses):
    """Scans in the frames of the poses: a floor and two walls, rounded to float32."""
    scans, _ = geometry.corner(num_scans=len(poses))
    world = [geometry.apply(pose, p) for pose, scan in zip(geometry.sensor_path(len(poses)), scans) for p in scan]
    size = len(scans[0])
    parts = [world[i * size : (i + 1) * size] for i in range(len(poses))]
    return [
        geometry.as_float32([geometry.apply(geometry.inverse(pose), p) for p in part])
        for pose, part in zip(poses, parts)
    ]


def write_carla_ply(path, points_right_handed, binary):
    """As sensor.lidar.ray_cast saves it, x y z I, with y to the right; CARLA itself writes text."""
    points = [(x, -y, z) for x, y, z in points_right_handed]
    kind = "binary_little_endian" if binary else "ascii"
    header = (
        f"ply\nformat {kind} 1.0\nelement vertex {len(points)}\nproperty float32 x\nproperty float32 y\n"
        "property float32 z\nproperty float32 I\nend_header\n"
    ).encode()
    if binary:
        path.write_bytes(header + b"".join(struct.pack("<4f", *p, 0.9) for p in points))
    else:
        path.write_bytes(header + "".join(" ".join(map(write_data.number, (*p, 0.9))) + "\n" for p in points).encode())


class CarlaTest(CliTest):
    def setUp(self):
        super().setUp()
        self.transforms = transforms(6)
        self.poses = [right_handed(t) for t in self.transforms]
        self.scans = points_of_corner(self.poses)
        self.frames = [FIRST_FRAME + 3 * i for i in range(6)]

    def write_recording(self, binary=False):
        """PLY files named by frame, and transforms of more frames than there are scans, as a tick rate gives them."""
        folder = self.folder / "lidar"
        folder.mkdir(exist_ok=True)
        for frame, points in zip(self.frames, self.scans):
            write_carla_ply(folder / f"{frame:06d}.ply", points, binary)
        return folder

    def rows(self):
        """With a transform of a frame without a scan between those with one."""
        rows = []
        for frame, transform in zip(self.frames, self.transforms):
            rows.append({"frame": frame, **transform})
            rows.append({"frame": frame + 1, **{**transform, "x": 50.0}})
        return rows

    def write_csv(self):
        keys = ("frame", "x", "y", "z", "roll", "pitch", "yaw")
        lines = [",".join([str(r["frame"]), *(write_data.number(r[k]) for k in keys[1:])]) for r in self.rows()]
        path = self.folder / "transforms.csv"
        path.write_text("\n".join([",".join(keys), *lines]) + "\n")
        return path

    def write_json(self):
        path = self.folder / "transforms.json"
        path.write_text(
            json.dumps(
                [
                    {
                        "frame": r["frame"],
                        "location": {k: r[k] for k in "xyz"},
                        "rotation": {k: r[k] for k in ("pitch", "yaw", "roll")},
                    }
                    for r in self.rows()
                ]
            )
        )
        return path

    def right_handed_document(self, *options):
        scans, poses = write_data.write_dataset(self.folder / "kitti", self.scans, self.poses)
        return self.evaluate(scans, poses, *OPTIONS, *options)

    def assert_same_numbers(self, document, expected):
        for metric in METRICS:
            value = expected["metrics"][metric]["value"]
            self.assertIsNotNone(value, metric)
            self.assert_relative(document["metrics"][metric]["value"], value, 1e-9, metric)
        self.assertEqual(document["inputs"]["num_points"], expected["inputs"]["num_points"])
        self.assertEqual(document["inputs"]["num_scans"], 6)

    def test_a_recording_has_the_numbers_of_the_same_data_written_right_handed(self):
        expected = self.right_handed_document()
        for binary, poses in ((False, self.write_csv()), (True, self.write_json())):
            with self.subTest(poses=poses.name):
                document = self.evaluate(
                    self.write_recording(binary), poses, "--left-handed", *OPTIONS
                )
                self.assert_same_numbers(document, expected)
                self.assertEqual(document["inputs"]["poses_format"], "carla")
                self.assertTrue(document["inputs"]["left_handed"])

    def test_normals_are_those_of_the_right_handed_map(self):
        expected = self.right_handed_document()
        document = self.evaluate(self.write_recording(), self.write_csv(), "--left-handed", *OPTIONS)
        for direction, other in zip(
            document["metrics"]["mom"]["directions"], expected["metrics"]["mom"]["directions"], strict=True
        ):
            for a, b in zip(direction["normal"], other["normal"], strict=True):
                self.assertAlmostEqual(a, b, delta=1e-6)

    def test_an_extrinsic_is_left_handed_too(self):
        expected = self.right_handed_document()
        offset = {"x": 0.3, "y": 0.2, "z": 1.6, "roll": 0.0, "pitch": 3.0, "yaw": 40.0}
        body_from_sensor = right_handed(offset)
        bodies = [geometry.compose(pose, geometry.inverse(body_from_sensor)) for pose in self.poses]
        mirrored = [self.mirrored(pose) for pose in (*bodies, body_from_sensor)]
        write_data.write_kitti(self.folder / "bodies.txt", mirrored[:-1])
        extrinsic = " ".join(write_data.number(v) for row in mirrored[-1] for v in row)
        document = self.evaluate(
            self.write_recording(), self.folder / "bodies.txt", "--left-handed", *OPTIONS,
            "--extrinsic", extrinsic
        )
        self.assert_same_numbers(document, expected)

    @staticmethod
    def mirrored(pose):
        signs = (1.0, -1.0, 1.0)
        return [[s * v * c for v, c in zip(row, (*signs, 1.0))] for row, s in zip(pose, signs)]

    def test_without_the_flag_it_is_said_and_right_handed_scans_give_other_numbers(self):
        expected = self.right_handed_document()
        result = self.run_ok("evaluate", self.write_recording(), self.write_csv(), *OPTIONS, "--json", "-")
        self.assertIn("left-handed", result.stderr)
        self.assert_relative(result.json()["metrics"]["mpv"]["value"], expected["metrics"]["mpv"]["value"], 1e-9)
        mixed = self.run_ok(
            "evaluate", self.write_recording(), self.folder / "kitti" / "poses.txt", *OPTIONS, "--json", "-",
            exit_codes=(0, 4),
        ).json()
        self.assertGreater(mixed["metrics"]["mpv"]["value"], 2 * expected["metrics"]["mpv"]["value"])

    def test_frames_of_other_scans_are_refused_and_missing_ones_left_out(self):
        folder = self.write_recording()
        poses = self.write_csv()
        (folder / "000999.ply").write_bytes((folder / f"{FIRST_FRAME:06d}.ply").read_bytes())
        result = self.run_ok("evaluate", folder, poses, "--left-handed", *OPTIONS, "--json", "-")
        self.assertIn("1 of 7 scans have no pose with their frame number", result.stderr)
        self.assertEqual(result.json()["inputs"]["num_scans"], 6)
        other = self.folder / "other"
        other.mkdir()
        (folder / "000999.ply").rename(other / "000999.ply")
        result = self.run_ok("evaluate", other, poses, "--left-handed", exit_codes=(3,))
        self.assertIn("its frames, 412 to 428, are those of no scan", result.stderr)

    def test_convert_writes_right_handed_poses(self):
        out = self.folder / "poses.kitti"
        self.run_ok("convert", self.write_csv(), out, "--left-handed")
        for row, expected in zip(write_data.read_kitti(out)[::2], self.poses, strict=True):
            for a, b in zip(sum(row, []), sum(expected, []), strict=True):
                self.assertAlmostEqual(a, b, delta=1e-14)
