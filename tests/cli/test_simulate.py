# SPDX-License-Identifier: Apache-2.0
"""`trysquare simulate`: data sets that evaluate, the same bytes every time, nothing half done."""

import math
import signal
import struct
import subprocess
import time

import support
from support import CliTest, clean_environment, trysquare, validate

SMALL = ("--beams", 16, "--fov", -20, 10, "--azimuths", 180)

CUBE = """v -5 -5 -2
v 5 -5 -2
v 5 5 -2
v -5 5 -2
v -5 -5 3
v 5 -5 3
v 5 5 3
v -5 5 3
f 1 2 3 4
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


def points_of(path):
    return [p[:3] for p in struct.iter_unpack("<4f", path.read_bytes())]


def all_bytes(folder):
    return {p.relative_to(folder): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


class SimulateTest(CliTest):
    def simulate(self, world, *options, name="out"):
        out = self.folder / name
        document = self.run_ok("simulate", world, out, *options, "--json", "-").json()
        validate(self, document, "simulation")
        return out, document

    def test_every_world_is_a_data_set_that_evaluates(self):
        worlds = {
            "planes": ("--scans", 6, "--noise", 0.02),
            "street": ("--scans", 6, "--moving-cars", *SMALL),
            "town": ("--scans", 6, "--style", "oldtown", "--rolling-shutter", "--dropout", 0.1, *SMALL),
            "room": ("--scans", 6, "--beams", 40, "--azimuths", 60),
            "office": ("--scans", 6, "--beams", 40, "--azimuths", 60),
        }
        for world, options in worlds.items():
            with self.subTest(world=world):
                out, document = self.simulate(world, *options, name=world)
                names = sorted(p.name for p in out.iterdir())
                self.assertEqual(names, ["calib.txt", "poses.txt", "times.txt", "velodyne"])
                self.assertEqual(document["num_scans"], 6)
                self.assertEqual(document["settings"]["world"], world)
                counts = [len(points_of(p)) for p in sorted((out / "velodyne").iterdir())]
                self.assertEqual(len(counts), 6)
                self.assertEqual(sum(counts), document["num_points"])
                self.assertEqual((min(counts), max(counts)), (document["num_points_min"], document["num_points_max"]))
                self.assertGreater(min(counts), 500)
                result = self.evaluate(
                    out / "velodyne", out / "poses.txt", "--radius", 1, "--query-every", 20, "--metrics", "mpv,mme"
                )
                self.assertEqual(result["inputs"]["num_points"], document["num_points"])
                self.assertGreater(result["overlap"]["multi_scan_share"], 0.5)

    def test_true_poses_fit_the_scans_and_wrong_ones_do_not(self):
        out, _ = self.simulate("street", "--scans", 8, "--noise", 0.02, "--azimuths", 360)
        words = (out / "poses.txt").read_text().splitlines()
        rows = [line.split() for line in words]
        for i, row in enumerate(rows):
            row[7] = str(float(row[7]) + 0.2 * (-1) ** i)
        (self.folder / "wrong.txt").write_text("\n".join(" ".join(row) for row in rows) + "\n")
        options = ("--radius", 0.6, "--query-every", 5, "--metrics", "mom,mpv")
        true = self.evaluate(out / "velodyne", out / "poses.txt", *options, exit_codes=(0, 4))
        wrong = self.evaluate(out / "velodyne", self.folder / "wrong.txt", *options, exit_codes=(0, 4))
        self.assertGreater(wrong["metrics"]["mpv"]["value"], 1.2 * true["metrics"]["mpv"]["value"])

    def test_the_same_bytes_at_every_thread_count(self):
        options = ("--scans", 7, "--seed", 5, "--style", "suburb", "--moving-cars", "--rolling-shutter", *SMALL)
        one, document = self.simulate("town", *options, "--threads", 1, name="one")
        for threads in (2, 5):
            other, same = self.simulate("town", *options, "--threads", threads, name=f"threads{threads}")
            self.assertEqual(all_bytes(one), all_bytes(other))
            self.assertEqual(document, same)
        seed, _ = self.simulate("town", *options, "--seed", 6, name="seed")
        self.assertNotEqual(all_bytes(one), all_bytes(seed))

    def test_a_mesh_is_seen_from_the_poses_that_are_given(self):
        (self.folder / "cube.obj").write_text(CUBE)
        (self.folder / "poses.tum").write_text("1.5 0 0 0 0 0 0 1\n1.75 1 2 0 0 0 0.6 0.8\n")
        out, document = self.simulate(
            "mesh", "--mesh", self.folder / "cube.obj", "--poses", self.folder / "poses.tum", "--noise", 0, *SMALL
        )
        self.assertEqual(document["num_triangles"], 12)
        self.assertEqual(document["num_points"], 2 * 16 * 180)
        self.assertEqual((out / "times.txt").read_text(), "1.500000000\n1.750000000\n")
        cosine, sine = 0.8 * 0.8 - 0.6 * 0.6, 2 * 0.6 * 0.8
        for x, y, z in points_of(out / "velodyne" / "000001.bin"):
            at = (1 + cosine * x - sine * y, 2 + sine * x + cosine * y, z)
            off = min(abs(abs(at[0]) - 5), abs(abs(at[1]) - 5), abs(at[2] + 2), abs(at[2] - 3))
            self.assertLess(off, 1e-5)

    def test_options_of_the_sensor_are_taken(self):
        out, document = self.simulate(
            "street", "--scans", 1, "--sensor", "os1-128", "--beams", 3, "--fov", -20, -10, "--azimuths", 100, "--noise", 0,
            "--max-range", 30, "--dropout", 0.25,
        )  # fmt: skip
        sensor = document["settings"]["sensor"]
        self.assertEqual((sensor["name"], sensor["num_beams"], sensor["num_azimuths"]), ("os1-128", 3, 100))
        self.assertEqual((sensor["max_range_m"], sensor["dropout"], sensor["range_sigma_m"]), (30, 0.25, 0))
        points = points_of(out / "velodyne" / "000000.bin")
        self.assertLess(len(points), 270)
        for x, y, z in points:
            elevation = math.degrees(math.atan2(z, math.hypot(x, y)))
            self.assertLess(min(abs(elevation + e) for e in (10, 15, 20)), 1e-4)
            self.assertLess(math.hypot(x, y, z), 30.001)

    def test_settings_can_come_from_a_file(self):
        (self.folder / "settings.toml").write_text("[simulate]\nscans = 2\nfov = [-12, 3]\nbeams = 4\nazimuths = 50\n")
        _, document = self.simulate("street", "--config", self.folder / "settings.toml")
        self.assertEqual(document["num_scans"], 2)
        self.assertAlmostEqual(document["settings"]["sensor"]["lowest_elevation_deg"], -12)
        self.assertAlmostEqual(document["settings"]["sensor"]["highest_elevation_deg"], 3)

    def test_a_folder_with_something_in_it_is_refused_unless_forced(self):
        out, _ = self.simulate("street", "--scans", 3, *SMALL)
        (out / "notes.txt").write_text("mine")
        before = all_bytes(out)
        self.assert_usage_error(trysquare("simulate", "street", out, "--scans", 2, *SMALL), "not empty", "--force")
        self.assertEqual(before, all_bytes(out))
        self.run_ok("simulate", "street", out, "--scans", 2, *SMALL, "--force")
        self.assertEqual(len(list((out / "velodyne").iterdir())), 2)
        self.assertEqual((out / "notes.txt").read_text(), "mine")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["out"])

    def test_mistakes_are_usage_errors_that_leave_nothing(self):
        out = self.folder / "out"
        mesh = self.folder / "cube.obj"
        calls = (
            (("castle", out), "castle"),
            (("mesh", out), "--mesh"),
            (("mesh", out, "--mesh", mesh), "--poses"),
            (("room", out, "--style", "grid"), "--style", "town"),
            (("room", out, "--moving-cars"), "--moving-cars"),
            (("street", out, "--mesh", mesh), "--mesh"),
            (("street", out, "--points-per-disc", 3), "planes"),
            (("planes", out, "--sensor", "hdl64"), "planes"),
            (("street", out, "--sensor", "hdl-64"), "hdl64", "os1-128"),
            (("street", out, "--beams", 0), "num_beams", "0"),
            (("street", out, "--fov", 10, -30), "highest_elevation_rad"),
            (("street", out, "--dropout", 1.5), "dropout", "1.5"),
            (("street", out, "--noise", -1), "range_sigma_m"),
            (("street", out, "--scans", 0), "--scans"),
            (("street", out, "--step", 0), "step_m"),
            (("street", out, "--poses", "a", "--step", 1), "--step"),
            (("street", out, "--threads", -1), "num_threads"),
        )
        for arguments, *words in calls:
            with self.subTest(arguments=arguments):
                self.assert_usage_error(trysquare("simulate", *arguments), *words)
                self.assertFalse(out.exists())

    def test_bad_files_are_named_with_the_line(self):
        (self.folder / "poses.txt").write_text("1 0 0 0 0 1 0 0 0 0 1 0\n")
        out = self.folder / "out"
        for text, words in (
            ("v 0 0 0\nv 1 0 0\nv 0 1\n", ("line 3",)),
            ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ("line 4",)),
            ("v 0 0 0\n", ("no triangle",)),
        ):
            (self.folder / "bad.obj").write_text(text)
            result = trysquare(
                "simulate", "mesh", out, "--mesh", self.folder / "bad.obj", "--poses", self.folder / "poses.txt"
            )
            self.assertEqual(result.exit_code, 3, result)
            for word in ("bad.obj", *words):
                self.assertIn(word, result.stderr)
        self.assertFalse(out.exists())

    def test_a_place_that_cannot_be_written_is_an_input_error(self):
        (self.folder / "file").write_text("")
        result = trysquare("simulate", "street", self.folder / "file" / "out", "--scans", 1, *SMALL)
        self.assertEqual(result.exit_code, 3, result)
        self.assertIn("cannot be written", result.stderr)

    def test_an_interrupted_simulation_leaves_nothing(self):
        process = subprocess.Popen(
            [support.COMMAND, "simulate", "town", str(self.folder / "out"), "--scans", "100000", "--threads", "2"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env=clean_environment(),
        )
        deadline = time.monotonic() + 60
        while not list(self.folder.glob(".trysquare-*/velodyne/*.bin")) and time.monotonic() < deadline:
            time.sleep(0.02)
        self.assertEqual([p.name.startswith(".trysquare-") for p in self.folder.iterdir()], [True])
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), -signal.SIGINT)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_scans_without_points_are_warned_of(self):
        (self.folder / "cube.obj").write_text(CUBE)
        (self.folder / "poses.txt").write_text("1 0 0 500 0 1 0 0 0 0 1 0\n")
        result = self.run_ok(
            "simulate", "mesh", self.folder / "out", "--mesh", self.folder / "cube.obj", "--poses",
            self.folder / "poses.txt", *SMALL,
        )  # fmt: skip
        self.assertIn("empty_scans", result.stderr)
