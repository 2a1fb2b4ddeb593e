# SPDX-License-Identifier: Apache-2.0
"""The verb `diagnose`: what is wrong is named, what is right raises no alarm. Truth: mistakes put into simulated and real data."""

import math
import shutil
import struct

from support import CliTest, DataTest, validate
from write_data import number, read_kitti, write_kitti


def times(a, b):
    """a · b of 3×4 matrices."""
    return [[sum(a[i][k] * b[k][j] for k in range(3)) + (a[i][3] if j == 3 else 0) for j in range(4)] for i in range(3)]


def inverse(a):
    rotation = [[a[j][i] for j in range(3)] for i in range(3)]
    return [[*row, -sum(row[k] * a[k][3] for k in range(3))] for row in rotation]


def turned_by(vector):
    """Rotation matrix of a rotation vector (Rodrigues)."""
    angle = math.sqrt(sum(x * x for x in vector)) or 1e-15
    x, y, z = (v / angle for v in vector)
    skew = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    square = [[sum(skew[i][k] * skew[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    s, c = math.sin(angle), 1 - math.cos(angle)
    return [[(i == j) + s * skew[i][j] + c * square[i][j] for j in range(3)] for i in range(3)]


def on_the_way(a, b, share):
    """The pose at `share` of the way from a to b, beyond them at the same speed. For small turns."""
    turn = times(inverse(a), b)
    vector = [share * v / 2 for v in (turn[2][1] - turn[1][2], turn[0][2] - turn[2][0], turn[1][0] - turn[0][1])]
    step = turned_by(vector)
    rotation = [[sum(a[i][k] * step[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    return [[*rotation[i], a[i][3] + share * (b[i][3] - a[i][3])] for i in range(3)]


def late_by(poses, share):
    """Each pose taken `share` of a step later."""
    last = len(poses) - 2
    return [on_the_way(poses[min(i, last)], poses[min(i, last) + 1], share + (i > last)) for i in range(len(poses))]


def moved(poses, indices, y_m):
    return [[[*row[:3], row[3] + y_m * (i in indices and k == 1)] for k, row in enumerate(p)] for i, p in enumerate(poses)]


def with_y_negated(scans, folder):
    folder.mkdir()
    for path in scans.glob("*.bin"):
        data = path.read_bytes()
        values = list(struct.unpack(f"<{len(data) // 4}f", data))
        values[1::4] = [-y for y in values[1::4]]
        (folder / path.name).write_bytes(struct.pack(f"<{len(values)}f", *values))
    return folder


class Diagnosing:
    def diagnose(self, scans, poses, *options, exit_codes=(0,)):
        """The JSON of `diagnose`; poses may be a list, which is written first."""
        if isinstance(poses, list):
            write_kitti(self.folder / "given.txt", poses)
            poses = self.folder / "given.txt"
        result = self.run_ok("diagnose", scans, poses, *options, "--json", "-", exit_codes=exit_codes)
        document = result.json()
        validate(self, document, "diagnosis")
        return document

    def alarms(self, *arguments):
        """Ids of errors and warnings."""
        document = self.diagnose(*arguments)
        return [finding["id"] for finding in document["findings"] if finding["severity"] != "note"]


class SimulatedTest(Diagnosing, CliTest):
    NUM_SCANS = 10

    def setUp(self):
        super().setUp()
        self.scans, self.poses_file, self.poses = self.world("town")

    def world(self, kind):
        folder = self.folder / kind
        sensor = ("--beams", 32, "--fov", -30, 10, "--azimuths", 500)
        self.run_ok("simulate", kind, folder, "--scans", self.NUM_SCANS, "--seed", 5, *sensor, "--quiet")
        return folder / "velodyne", folder / "poses.txt", read_kitti(folder / "poses.txt")

    def test_true_poses_raise_no_alarm(self):
        self.assertEqual([], self.alarms(self.scans, self.poses_file))
        street, truth, _ = self.world("street")
        self.assertEqual([], self.alarms(street, truth))

    def test_small_random_errors_are_measured_and_blame_nobody(self):
        noisy = self.folder / "noisy.txt"
        self.run_ok("perturb", self.poses_file, "-o", noisy, "--translation", 0.05, "--rotation", 0.2, "--seed", 2)
        document = self.diagnose(self.scans, noisy)
        self.assertEqual([], document["findings"])
        self.assertEqual("measured", document["rpe_estimate"]["status"])
        self.assertIsNone(document["time_offset"]["offset_s"])

    def test_swapped_handedness_is_named(self):
        left_handed = with_y_negated(self.scans, self.folder / "left_handed")
        self.assertEqual(["left_handed"], self.alarms(left_handed, self.poses))

    def test_camera_frame_and_inverted_poses_are_named(self):
        lidar_from_camera = [[0, 0, 1, 0.3], [-1, 0, 0, 0], [0, -1, 0, -0.1]]
        of_camera = [times(pose, lidar_from_camera) for pose in self.poses]
        self.assertEqual(["camera_frame"], self.alarms(self.scans, of_camera))
        self.assertEqual(["poses_inverted"], self.alarms(self.scans, [inverse(p) for p in self.poses]))

    def test_an_inverted_extrinsic_is_named(self):
        cosine, sine = math.cos(0.5), math.sin(0.5)
        body_from_sensor = [[cosine, -sine, 0, 0.8], [sine, cosine, 0, 0.1], [0, 0, 1, 0.2]]
        of_body = [times(pose, inverse(body_from_sensor)) for pose in self.poses]

        def words(matrix):
            return " ".join(number(v) for row in matrix for v in row)

        self.assertEqual([], self.alarms(self.scans, of_body, "--extrinsic", words(body_from_sensor)))
        inverted = words(inverse(body_from_sensor))
        self.assertEqual(["extrinsic_inverted"], self.alarms(self.scans, of_body, "--extrinsic", inverted))

    def test_rounded_poses_are_named(self):
        rounded = self.folder / "rounded.txt"
        rows = (
            " ".join(number(v) if i % 4 != 3 else f"{v:.2f}" for i, v in enumerate(v for row in pose for v in row))
            for pose in self.poses
        )
        rounded.write_text("\n".join(rows) + "\n")
        document = self.diagnose(self.scans, rounded)
        self.assertEqual(["rounded_poses"], [f["id"] for f in document["findings"] if f["severity"] != "note"])
        self.assertIn("2 decimals", document["findings"][0]["message"])

    def test_a_duplicated_scan_is_named(self):
        shutil.copy(self.scans / "000004.bin", self.scans / "000005.bin")
        document = self.diagnose(self.scans, self.poses)
        self.assertIn("duplicate_scans", [f["id"] for f in document["findings"]])
        self.assertEqual(5, document["suspects"][0]["scan"])

    def test_a_missing_scan_is_named(self):
        (self.scans / "000005.bin").unlink()
        self.assertEqual(["missing_scans"], self.alarms(self.scans, self.poses[:5] + self.poses[6:]))
        shifted = self.diagnose(self.scans, self.poses[:-1])  # one pose too few is not noticed: those after it shift
        self.assertIn("missing_scans", [f["id"] for f in shifted["findings"]])
        self.assertIn(4, [jump["from_scan"] for jump in shifted["jumps"]])

    def test_the_corrupted_pose_is_named_with_the_size_of_its_error(self):
        document = self.diagnose(self.scans, moved(self.poses, {7}, 0.1))
        self.assertEqual(["suspect_pose"], [f["id"] for f in document["findings"] if f["severity"] != "note"])
        (suspect,) = document["suspects"]
        self.assertEqual(7, suspect["scan"])
        self.assertAlmostEqual(0.1, suspect["translation_error_m"], delta=0.01)
        low, high = suspect["translation_interval_m"]
        self.assertLess(low, 0.1)
        self.assertGreater(high, 0.1)

    def test_a_ghost_wall_of_ten_centimetres_is_named(self):
        document = self.diagnose(self.scans, moved(self.poses, range(5, self.NUM_SCANS), 0.1))
        self.assertEqual({"pose_jump", "ghost_wall"}, {f["id"] for f in document["findings"] if f["severity"] != "note"})
        wall = document["ghost_walls"][0]
        self.assertAlmostEqual(0.1, wall["distance_m"], delta=0.015)
        self.assertLess(wall["adjusted_distance_m"], 0.02)
        before, after = set(range(5)), set(range(5, self.NUM_SCANS))
        groups = [set(wall["lower_scans"]), set(wall["upper_scans"])]
        self.assertTrue(any(group <= before for group in groups) and any(group <= after for group in groups), groups)
        self.assertEqual([4], [jump["from_scan"] for jump in document["jumps"]])

    def test_two_scans_are_exit_4_and_say_why(self):
        document = self.diagnose(self.scans, self.poses_file, "--last", 1, exit_codes=(4,))
        self.assertFalse(document["judged"])
        self.assertIn("too few", document["judged_reason"])

    def test_table_folder_and_threads(self):
        poses = self.folder / "jump.txt"
        write_kitti(poses, moved(self.poses, range(5, self.NUM_SCANS), 0.1))
        out = self.folder / "out"
        result = self.run_ok("diagnose", self.scans, poses, "--out", out, "--threads", 1)
        self.assertIn("warning pose_jump", result.stdout)
        self.assertIn("->", result.stdout)
        two = self.run_ok("diagnose", self.scans, poses, "--json", "-", "--threads", 2)
        self.assertEqual((out / "diagnosis.json").read_text(), two.stdout)
        lines = (out / "findings.csv").read_text().splitlines()
        self.assertEqual("id,severity,found,limit,unit,message,remedy", lines[0])
        self.assertEqual(len(two.json()["findings"]), len(lines) - 1)
        self.assertIn("Nothing is wrong.", self.run_ok("diagnose", self.scans, self.poses_file).stdout)

    def test_settings_out_of_range_are_usage_errors(self):
        result = self.run_ok("diagnose", self.scans, self.poses_file, "--max-time-offset", 0, exit_codes=(2,))
        self.assert_usage_error(result, "max_time_offset_s")


class KittiTest(Diagnosing, DataTest):
    """The first 20 scans of sequence 00, with the poses in which they agree."""

    adjusted_text = None  # of all tests: refined once

    def setUp(self):
        super().setUp()
        kitti = self.data / "kitti00"
        self.scans, self.calibration = kitti / "velodyne", kitti / "calib.txt"
        self.adjusted = self.folder / "adjusted.txt"
        if KittiTest.adjusted_text is None:
            self.run_ok("refine", self.scans, kitti / "poses.txt", "-o", self.adjusted)
            KittiTest.adjusted_text = self.adjusted.read_text()
        self.adjusted.write_text(KittiTest.adjusted_text)

    def sensor_poses(self):
        row = next(line for line in self.calibration.read_text().splitlines() if line.startswith("Tr"))
        numbers = [float(word) for word in row.split(":")[1].split()]
        camera_from_lidar = [numbers[4 * i : 4 * i + 4] for i in range(3)]
        return [times(times(inverse(camera_from_lidar), p), camera_from_lidar) for p in read_kitti(self.adjusted)]

    def test_adjusted_poses_raise_no_alarm_and_without_calibration_they_do(self):
        self.assertEqual([], self.alarms(self.scans, self.adjusted, "--calib", self.calibration))
        self.assertEqual(["camera_frame"], self.alarms(self.scans, self.adjusted, "--no-calib"))

    def test_an_offset_of_50_milliseconds_is_named(self):
        times_s = [float(word) for word in (self.scans.parent / "times.txt").read_text().split()]
        step_s = (times_s[-1] - times_s[0]) / (len(times_s) - 1)
        document = self.diagnose(self.scans, late_by(self.sensor_poses(), 0.05 / step_s))
        self.assertEqual(["time_offset"], [f["id"] for f in document["findings"] if f["severity"] != "note"])
        self.assertAlmostEqual(-0.05, document["time_offset"]["offset_s"], delta=0.01)

    def test_a_ghost_wall_of_ten_centimetres_is_named(self):
        document = self.diagnose(self.scans, moved(self.sensor_poses(), range(10, 20), 0.1))
        walls = [wall for wall in document["ghost_walls"] if abs(wall["distance_m"] - 0.1) < 0.02]
        self.assertGreaterEqual(len(walls), 2)
        self.assertEqual([9], [jump["from_scan"] for jump in document["jumps"]])
