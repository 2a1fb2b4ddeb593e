# SPDX-License-Identifier: Apache-2.0
"""What the command writes: JSON, tables, map, trajectory, report, figures; where it writes it; help and settings."""

import csv
import html.parser
import json
import math
import os
import pty
import re
import shutil
import subprocess
import threading
import xml.etree.ElementTree as ElementTree

import geometry
import support
import write_data
from support import REPOSITORY, CliTest, clean_environment, is_finite_document, validate

# The toy scans have too few points for patches.
PAPER = ("--subset-method", "paper", "--subset-scans", 6)

VERBS = ("evaluate", "diagnose", "map", "orthogonal", "ape", "rpe", "simulate", "info", "convert", "completion")


def run_in_terminal(*arguments, environment=None):
    """(exit code, all that a terminal would have got) with stdout and stderr both a terminal."""
    parent, child = pty.openpty()
    process = subprocess.Popen(
        [support.COMMAND, *map(str, arguments)],
        stdin=subprocess.DEVNULL,
        stdout=child,
        stderr=child,
        env={**clean_environment(environment), "TERM": "xterm-256color"},
    )
    os.close(child)
    chunks = []

    def drain():
        while True:
            try:
                chunk = os.read(parent, 65536)
            except OSError:  # Linux says EIO when the other end is closed
                return
            if not chunk:
                return
            chunks.append(chunk)

    reader = threading.Thread(target=drain)
    reader.start()
    exit_code = process.wait(timeout=120)
    reader.join(timeout=10)
    os.close(parent)
    return exit_code, b"".join(chunks).decode("utf-8", "replace")


class ReportReader(html.parser.HTMLParser):
    """Collects what a page would load, and the elements that are open at its end."""

    VOID = frozenset({"meta", "br", "hr", "img", "link", "input", "col", "wbr", "area", "base", "source"})

    def __init__(self):
        super().__init__()
        self.tags = set()
        self.loads = []
        self.open = []
        self.text = []

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        for name, value in attrs:
            if name in ("src", "href", "xlink:href", "action", "data", "poster", "srcset") and value:
                self.loads.append((tag, value))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in self.VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-3:]}"
        self.open.pop()

    def handle_data(self, data):
        self.text.append(data)


class OutputTest(CliTest):
    def setUp(self):
        super().setUp()
        self.scans, self.poses = geometry.corner(num_scans=6, per_plane=120)
        self.inputs = write_data.write_dataset(self.folder, self.scans, self.poses)
        self.call = ("evaluate", *self.inputs, "--radius", 0.5, *PAPER)

    def check_report(self, path, *must_contain):
        page = path.read_text()
        reader = ReportReader()
        reader.feed(page)
        reader.close()
        self.assertEqual(reader.open, [])
        self.assertFalse(reader.tags & {"script", "iframe", "object", "embed", "link"}, reader.tags)
        outside = [(t, v) for t, v in reader.loads if not v.startswith(("#", "data:")) and t != "a"]
        self.assertEqual(outside, [])
        self.assertNotRegex(page, r"url\(\s*['\"]?(https?:)?//")
        self.assertNotIn("@import", page)
        self.assertNotRegex(page, r"\bon(load|click|error)\s*=")
        text = " ".join(reader.text)
        self.assertNotRegex(text, r"(?i)\bnan\b|-?\binf\b|undefined reference")
        for word in must_contain:
            self.assertIn(word, text)
        return page


class FileTest(OutputTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def test_json_file_and_dash_hold_the_same_bytes_as_evaluation_json(self):
        dashed = self.run_ok(*self.call, "--json", "-", "--out", self.out)
        to_file = self.run_ok(*self.call, "--json", self.folder / "e.json")
        self.assertEqual(dashed.stdout, (self.out / "evaluation.json").read_text())
        self.assertEqual(dashed.stdout, (self.folder / "e.json").read_text())
        self.assertTrue(dashed.stdout.endswith("}\n"))
        self.assertIn("MOM", to_file.stdout.upper())

    def test_json_follows_its_schema(self):
        document = self.evaluate(*self.call[1:], "--reference", self.inputs[1], "--window", 3)
        validate(self, document, "evaluation")
        self.assertEqual(document["schema"], "trysquare.evaluation/1")
        self.assertTrue(is_finite_document(document))
        self.assertNotIn("timing", document)

    def test_json_of_no_meaning_follows_the_schema_too(self):
        one_scan = write_data.write_dataset(self.folder / "one", self.scans[:1], self.poses[:1])
        validate(self, self.evaluate(*one_scan, "--radius", 0.5, exit_codes=(4,)), "evaluation")
        apart = [geometry.pose(translation=(0.0, 90.0 * i, 0.0)) for i in range(6)]
        far = write_data.write_dataset(self.folder / "far", self.scans, apart)
        validate(self, self.evaluate(*far, "--radius", 0.5, exit_codes=(4,)), "evaluation")

    def test_json_has_the_keys_of_the_interface(self):
        document = self.evaluate(*self.call[1:], "--reference", self.inputs[1], "--window", 3)
        inputs, settings, metrics = document["inputs"], document["settings"], document["metrics"]
        self.assertEqual((inputs["num_scans"], inputs["num_points"], inputs["num_dropped_points"]), (6, 2160, 0))
        self.assertEqual(inputs["poses_format"], "kitti")
        self.assertEqual((settings["radius_m"], settings["min_neighbors"], settings["definition"]), (0.5, 6, "paper"))
        self.assertEqual(settings["min_neighbors_orthogonal"], 4)
        for name, unit in (("mme", "nats"), ("mpv", "m2"), ("mom", "m2"), ("omme", "nats")):
            self.assertEqual(metrics[name]["unit"], unit)
            self.assertIsNotNone(metrics[name]["value"], name)
        for name in ("mme", "mpv"):
            for key in ("num_queries", "num_used", "num_degenerate", "num_too_few"):
                self.assertIsInstance(metrics[name][key], int)
        for name in ("mom", "omme"):
            self.assertEqual(len(metrics[name]["directions"]), 3)
            for direction in metrics[name]["directions"]:
                self.assertEqual(len(direction["normal"]), 3)
                self.assertGreater(direction["num_points"], 0)
                self.assertIsNotNone(direction["mean"])
                self.assertIsNotNone(direction["median"])
            self.assertIs(metrics[name]["follows_trajectory_error"], True)
        self.assertIn("rpe_estimate", document)
        self.assertEqual(document["verdict"], {"meaningful": True, "reasons": []})
        self.assertLess(document["reference"]["rpe"]["rmse"], 1e-12)
        self.assertLess(document["reference"]["ape"]["rmse"], 1e-9)
        self.assertLess(document["reference"]["paper_rpe"], 1e-20)

    def test_version_of_the_json_is_that_of_the_project(self):
        version = re.search(r"project\(trysquare VERSION ([\d.]+)", (REPOSITORY / "CMakeLists.txt").read_text()).group(
            1
        )
        self.assertEqual(self.evaluate(*self.call[1:])["version"], version)
        self.assertIn(version, self.run_ok("--version").stdout)

    def test_what_cannot_be_computed_yet_is_null_with_a_reason(self):
        document = self.evaluate(*self.call[1:])
        estimate = document["rpe_estimate"]
        if estimate is None:
            self.assertRegex(json.dumps(document), r"rpe_estimate_reason|RPE estimate")
        else:
            self.assertIn(estimate["status"], ("measured", "bound", "refused"))

    def test_metrics_not_asked_for_are_left_out_or_null(self):
        document = self.evaluate(*self.call[1:], "--metrics", "mpv")
        self.assertIsNotNone(document["metrics"]["mpv"]["value"])
        for name in ("mme", "mom", "omme"):
            self.assertIsNone(document["metrics"].get(name))

    def test_windows(self):
        document = self.evaluate(*self.call[1:], "--window", 3, "--stride", 2)
        spans = [(w["first"], w["last"]) for w in document["windows"]]
        self.assertEqual(spans, [(0, 2), (2, 4)])
        some = write_data.write_dataset(self.folder / "some", self.scans[2:5], self.poses[2:5])
        alone = self.evaluate(*some, "--radius", 0.5)
        self.assert_relative(document["windows"][1]["mpv"], alone["metrics"]["mpv"]["value"], 1e-9)
        self.assert_relative(document["windows"][1]["mme"], alone["metrics"]["mme"]["value"], 1e-9)

    def test_twenty_scans_have_windows_of_ten_and_a_short_last_one_is_left_out(self):
        scans, poses = geometry.corner(num_scans=23, per_plane=40)
        document = self.evaluate(*write_data.write_dataset(self.folder / "long", scans, poses), "--radius", 0.5)
        self.assertEqual([(w["first"], w["last"]) for w in document["windows"]], [(0, 9), (10, 19)])
        self.assertIn("3", " ".join(w["message"] for w in document["warnings"]))
        self.assertEqual(self.evaluate(*self.call[1:])["windows"], [])

    def test_out_folder(self):
        result = self.run_ok(*self.call, "--out", self.out, "--window", 3)
        document = json.loads((self.out / "evaluation.json").read_text())
        names = {p.name for p in self.out.iterdir()}
        self.assertLessEqual(
            {"evaluation.json", "windows.csv", "poses.csv", "map.ply", "trajectory.tum"}, names, result
        )
        self.assertFalse([n for n in names if "tmp" in n or n.startswith(".")])
        self.check_windows(document)
        self.check_poses()
        self.check_map(document)

    def check_windows(self, document):
        with (self.out / "windows.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(document["windows"]))
        for row, window in zip(rows, document["windows"], strict=True):
            self.assertEqual((int(row["first"]), int(row["last"])), (window["first"], window["last"]))
            for key in ("mom", "mpv", "mme"):
                column = next(c for c in row if c == key or c.startswith(f"{key}_"))  # perhaps with its unit
                self.assert_relative(float(row[column]), window[key], 1e-12, key)

    def check_poses(self):
        with (self.out / "poses.csv").open() as file:
            rows = list(csv.reader(file))
        self.assertEqual(len(rows), 1 + len(self.poses))
        tum = write_data.read_tum(self.out / "trajectory.tum")
        self.assertEqual(len(tum), len(self.poses))
        for row, pose in zip(tum, self.poses, strict=True):
            self.assertEqual(len(row), 8)
            for axis in range(3):
                self.assertAlmostEqual(row[1 + axis], pose[axis][3], delta=1e-12)
            dot = sum(a * b for a, b in zip(row[4:], write_data.quaternion(pose), strict=True))
            self.assertAlmostEqual(abs(dot), 1.0, delta=1e-12)

    def check_map(self, document):
        columns = write_data.read_ply(self.out / "map.ply")
        wanted = {"x", "y", "z"} | {
            f"scalar_{n}" for n in ("plane_variance", "entropy", "scan", "num_neighbors", "direction")
        }
        self.assertLessEqual(wanted, set(columns))
        self.assertEqual(len(columns["x"]), document["inputs"]["num_points"])
        for name, metric in (("scalar_plane_variance", "mpv"), ("scalar_entropy", "mme")):
            values = [v for v in columns[name] if not math.isnan(v)]
            self.assertEqual(len(values), document["metrics"][metric]["num_used"])
            self.assert_relative(math.fsum(values) / len(values), document["metrics"][metric]["value"], 1e-6, name)
        self.assertEqual(sorted(set(columns["scalar_scan"])), list(range(6)))
        map_from_first = columns["x"][0], columns["y"][0], columns["z"][0]
        for got, want in zip(map_from_first, self.scans[0][0], strict=True):
            self.assertAlmostEqual(got, want, delta=1e-9)  # the map frame is that of the first scan

    def test_map_ply_evaluates_to_the_same_as_a_map(self):
        """`map` of the written map: the same points in double, so the same MME and MPV."""
        document = json.loads(self.run_ok(*self.call, "--out", self.out, "--json", "-").stdout)
        again = self.run_ok("map", self.out / "map.ply", "--radius", 0.5, "--json", "-", exit_codes=(0, 4)).json()
        validate(self, again, "evaluation")
        for name in ("mme", "mpv"):
            self.assert_relative(again["metrics"][name]["value"], document["metrics"][name]["value"], 1e-9, name)
            self.assertEqual(again["metrics"][name]["num_used"], document["metrics"][name]["num_used"])

    def test_world_from_map_is_kept(self):
        document = self.evaluate(*self.call[1:])
        rows = [*self.poses[0], [0.0, 0.0, 0.0, 1.0]]
        for got, want in zip(document["world_from_map"], rows, strict=True):
            self.assertEqual(got, want)

    def test_report_is_one_file_that_loads_nothing(self):
        report = self.folder / "r.html"
        document = self.evaluate(*self.call[1:], "--report", report, "--window", 2, "--reference", self.inputs[1])
        page = self.check_report(report, "MOM", "MPV", "MME", "OMME", "0.5")
        self.assertIn("<svg", page)
        self.assertTrue(document["windows"])
        self.assertLess(len(page), 2_000_000)

    def test_report_escapes_what_it_is_given(self):
        """A folder may be called anything."""
        strange = self.folder / "<b>&amp;'\"x"
        shutil.move(self.folder / "scans", strange)
        report = self.folder / "r.html"
        self.run_ok("evaluate", strange, self.inputs[1], "--radius", 0.5, "--report", report)
        self.check_report(report, "MOM")
        self.assertNotIn("<b>&amp;'", report.read_text())

    def test_figures_are_well_formed_svg(self):
        plots = self.folder / "plots"
        self.run_ok(*self.call, "--plot", plots, "--window", 2)
        figures = sorted(plots.glob("*.svg"))
        self.assertGreaterEqual(len(figures), 2)
        for figure in figures:
            root = ElementTree.parse(figure).getroot()
            self.assertTrue(root.tag.endswith("svg"), figure)
            self.assertGreater(len(list(root.iter())), 5, figure)
            self.assertNotRegex(figure.read_text(), r"(?i)[\"' ,]-?(nan|inf)[\"' ,]")

    def test_the_heat_map_has_a_segment_per_window(self):
        plots = self.folder / "plots"
        self.run_ok(*self.call, "--plot", plots, "--window", 2)
        self.assertTrue([p for p in plots.glob("*.svg") if re.search("trajectory|heat", p.name)])


class MeaninglessTest(OutputTest):
    """Exit 4 writes everything all the same and says why."""

    def cases(self):
        yield "one scan", self.scans[:1], self.poses[:1]
        yield "two points", [[(1.0, 2.0, 3.0)], [(1.0, 2.5, 3.0)]], [geometry.identity()] * 2
        yield "no overlap", self.scans, [geometry.pose(translation=(100.0 * i, 0.0, 0.0)) for i in range(6)]

    def test_json_table_and_report_are_written_and_say_why(self):
        for name, scans, poses in self.cases():
            with self.subTest(case=name):
                folder = self.folder / name.replace(" ", "_")
                inputs = write_data.write_dataset(folder, scans, poses)
                result = self.run_ok(
                    "evaluate", *inputs, "--radius", 0.5, "--json", folder / "e.json", "--report", folder / "r.html",
                    "--out", folder / "out", "--plot", folder / "plots", exit_codes=(4,),
                )  # fmt: skip
                document = json.loads((folder / "e.json").read_text())
                self.assertIs(document["verdict"]["meaningful"], False)
                reasons = document["verdict"]["reasons"]
                self.assertTrue(reasons and all(len(r) > 10 for r in reasons), reasons)
                self.assertIn(" ".join(reasons[0].split()[:4]), " ".join((result.stdout + result.stderr).split()))
                self.check_report(folder / "r.html")
                self.assertTrue((folder / "out" / "evaluation.json").is_file())
                self.assertTrue((folder / "out" / "map.ply").is_file())


class StreamTest(OutputTest):
    def test_stdout_has_the_table_and_nothing_else(self):
        plain = self.run_ok(*self.call)
        loud = self.run_ok(*self.call, "--progress", "always", "--verbose")
        self.assertEqual(plain.stdout, loud.stdout)
        for word in ("MME", "MPV", "MOM", "OMME", "nats"):
            self.assertIn(word, plain.stdout)

    def test_the_table_has_the_values_of_the_json(self):
        table = self.run_ok(*self.call).stdout
        document = self.evaluate(*self.call[1:])
        numbers = [float(w) for w in re.findall(r"[-−]?\d+\.?\d*(?:[eE][-+]?\d+)?", table.replace("−", "-"))]
        for name in ("mme", "mpv", "mom", "omme"):
            value = document["metrics"][name]["value"]
            scales = (1.0, 1e4, 1e6)  # the table may use cm² or mm²
            near = any(abs(n - s * value) <= 1e-2 * abs(s * value) for n in numbers for s in scales)
            self.assertTrue(near, f"{name} = {value} is not in\n{table}")

    def test_quiet_leaves_the_results_and_nothing_else(self):
        quiet = self.run_ok(*self.call, "--quiet", "--json", self.folder / "e.json")
        self.assertEqual((quiet.stdout, quiet.stderr), (self.run_ok(*self.call).stdout, ""))
        self.assertTrue((self.folder / "e.json").is_file())
        self.assertEqual(self.run_ok(*self.call, "--quiet", "--json", "-").json(), self.evaluate(*self.call[1:]))

    def test_no_progress_and_no_escapes_into_files(self):
        result = self.run_ok(*self.call)
        self.assert_no_escapes(result.stdout, result.stderr)
        self.assertNotIn("\r", result.stderr)

    def test_progress_always_draws_on_stderr(self):
        result = self.run_ok(*self.call, "--progress", "always", "--json", "-")
        self.assertGreater(len(result.stderr), 10)
        result.json()

    def test_progress_never_draws_nothing_even_on_a_terminal(self):
        code, screen = run_in_terminal(*self.call, "--progress", "never")
        self.assertEqual(code, 0, screen)
        self.assertNotIn("\r", screen.replace("\r\n", "\n"))
        self.assertIn("MOM", screen)

    def test_no_color_is_respected_on_a_terminal(self):
        code, screen = run_in_terminal(*self.call, environment={"NO_COLOR": "1"})
        self.assertEqual(code, 0, screen)
        self.assertNotRegex(screen, r"\x1b\[[0-9;]*m")

    def test_warnings_go_to_stderr_and_into_the_json(self):
        rounded = [[[round(v, 4) for v in row] for row in p] for p in self.poses]
        (self.folder / "rounded.txt").write_text(
            "".join(" ".join(f"{v:.4f}" for row in p for v in row) + "\n" for p in rounded)
        )
        result = self.run_ok(
            "evaluate", self.inputs[0], self.folder / "rounded.txt", "--radius", 0.5, "--json", self.folder / "e.json"
        )
        document = json.loads((self.folder / "e.json").read_text())
        self.assertTrue(document["warnings"])
        for warning in document["warnings"]:
            self.assertIn(" ".join(warning["message"].split()[:4]), " ".join(result.stderr.split()))

    def test_errors_are_one_message_without_escapes(self):
        result = self.run_ok("evaluate", self.folder / "missing", self.inputs[1], exit_codes=(3,))
        self.assert_no_escapes(result.stderr)
        self.assertLess(len(result.stderr.splitlines()), 6, result)

    def test_timing_has_a_key_of_its_own_and_only_when_asked(self):
        document = self.evaluate(*self.call[1:], "--timing")
        self.assertIn("timing", document)
        plain = self.evaluate(*self.call[1:])
        document.pop("timing")
        self.assertEqual(document, plain)

    def test_a_reader_that_goes_away_is_no_crash(self):
        """`trysquare evaluate ... | head -1`"""
        words = " ".join(map(str, self.call))
        code = subprocess.run(
            ["bash", "-c", f"set -o pipefail; '{support.COMMAND}' {words} --json - | head -c 1 >/dev/null"],
            capture_output=True,
            env=clean_environment(),
            check=False,
        )
        self.assertNotIn(b"terminate", code.stderr)


class OtherVerbTest(OutputTest):
    def write_map(self, name="map.ply"):
        scans, poses = self.scans, self.poses
        first = geometry.inverse(poses[0])
        points = [geometry.apply(geometry.compose(first, t), p) for s, t in zip(scans, poses, strict=True) for p in s]
        write_data.write_ply(self.folder / name, points, double=True)
        return self.folder / name, points

    def test_map_has_a_table_a_json_a_report_and_files(self):
        path, points = self.write_map()
        result = self.run_ok(
            "map", path, "--radius", 0.5, "--json", self.folder / "m.json", "--report", self.folder / "m.html",
            "--out", self.folder / "out",
        )  # fmt: skip
        document = json.loads((self.folder / "m.json").read_text())
        validate(self, document, "evaluation")
        expected = self.evaluate(*self.call[1:], "--metrics", "mme,mpv")
        for name in ("mme", "mpv"):
            self.assert_relative(document["metrics"][name]["value"], expected["metrics"][name]["value"], 1e-9, name)
        self.assertEqual(document["inputs"]["num_points"], len(points))
        self.assertIn("MPV", result.stdout)
        self.check_report(self.folder / "m.html", "MPV")
        self.assertIn("scalar_plane_variance", write_data.read_ply(self.folder / "out" / "map.ply"))

    def test_orthogonal_finds_the_three_planes_of_a_corner(self):
        inputs = self.dense_inputs()
        axes = [
            [row[axis] for axis in range(3)] for row in geometry.inverse(self.poses[0])
        ]  # world axes in the map frame
        for method in ("patches", "paper", "map-metrics"):
            document = self.run_ok(
                "orthogonal", *inputs, "--radius", 0.5, "--subset-method", method, "--json", "-"
            ).json()
            self.assertEqual(document["schema"], "trysquare.orthogonal/1")
            validate(self, document, "orthogonal")
            self.assertEqual(document["settings"]["method"], method)
            normals = [d["normal"] for d in document["directions"]]
            self.assertEqual(len(normals), 3, method)
            for axis in range(3):
                in_map = [axes[k][axis] for k in range(3)]
                best = max(abs(sum(a * b for a, b in zip(n, in_map, strict=True))) for n in normals)
                self.assertGreater(best, math.cos(math.radians(3.0)), f"{method}, axis {axis}: {normals}")
            for direction in document["directions"]:
                self.assertGreater(direction["num_points"], 20, method)

    def test_orthogonal_of_a_single_scan_file(self):
        scans, _ = geometry.corner(num_scans=1, per_plane=900)
        write_data.write_bin(self.folder / "one.bin", scans[0])
        document = self.run_ok("orthogonal", self.folder / "one.bin", "--radius", 0.5, "--json", "-").json()
        self.assertEqual(len(document["directions"]), 3)
        self.assertEqual(document["windows"], [])

    def test_orthogonal_writes_a_map_in_red_green_and_blue_on_grey(self):
        result = self.run_ok(
            "orthogonal", *self.dense_inputs(), "--radius", 0.5, "--out", self.folder / "orth", "--json", "-"
        )
        document = result.json()
        cloud = write_data.read_ply(self.folder / "orth" / "orthogonal.ply")
        self.assertEqual(len(cloud["x"]), 4 * 3 * 900)
        colors = list(zip(cloud["red"], cloud["green"], cloud["blue"], strict=True))
        for i, direction in enumerate(document["directions"]):
            of_direction = [c for c, d in zip(colors, cloud["scalar_direction"], strict=True) if d == i + 1]
            self.assertEqual(len(of_direction), direction["num_points"])
            self.assertTrue(all(color[i] == max(color) > 130 for color in of_direction), of_direction[:3])
        self.assertEqual(colors.count((170, 170, 170)), sum(math.isnan(d) for d in cloud["scalar_direction"]))
        picture = ElementTree.parse(self.folder / "orth" / "orthogonal.svg").getroot()
        self.assertEqual(picture.tag, "{http://www.w3.org/2000/svg}svg")
        self.assertFalse((self.folder / "orth" / "windows.csv").exists())

    def test_orthogonal_window_by_window(self):
        inputs = self.dense_inputs()
        folder = self.folder / "orth"
        document = self.run_ok(
            "orthogonal", *inputs, "--radius", 0.5, "--window", 2, "--stride", 1, "--out", folder, "--json", "-"
        ).json()
        validate(self, document, "orthogonal")
        self.assertEqual([(w["first"], w["last"]) for w in document["windows"]], [(0, 1), (1, 2), (2, 3)])
        for direction in document["windows"][2]["directions"]:
            self.assertLess(direction["moved_deg"], 3)
        with open(folder / "windows.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["first"] for row in rows], ["0", "1", "2"])
        self.assertEqual(float(rows[1]["moved_deg_3"]), document["windows"][1]["directions"][2]["moved_deg"])
        self.assertEqual(ElementTree.parse(folder / "windows.svg").getroot().tag, "{http://www.w3.org/2000/svg}svg")
        every = self.run_ok("orthogonal", *inputs, "--radius", 0.5, "--every", 2, "--json", "-").json()
        self.assertEqual([(w["first"], w["last"]) for w in every["windows"]], [(0, 0), (1, 1)])

    def test_orthogonal_windows_that_do_not_fit_are_said_and_leave_no_old_files(self):
        inputs, folder = self.dense_inputs(), self.folder / "orth"
        self.run_ok("orthogonal", *inputs, "--radius", 0.5, "--window", 2, "--out", folder)
        self.assertTrue((folder / "windows.csv").exists())
        result = self.run_ok(
            "orthogonal", *inputs, "--radius", 0.5, "--window", 9, "--out", folder, "--json", "-"
        )
        document = result.json()
        validate(self, document, "orthogonal")
        self.assertIn("does not fit", document["windows_reason"])
        self.assertIn("a window of 9 scans does not fit into 4", result.stderr)
        self.assertEqual([p.name for p in folder.glob("windows*")], [])
        result = self.run_ok("orthogonal", *inputs, "--radius", 0.5, "--window", 3)
        self.assertIn("the last 1 scans fill no window of 3", result.stderr)

    def test_orthogonal_of_points_without_planes_says_so_and_exits_with_4(self):
        scans, _ = geometry.corner(num_scans=1, per_plane=2)
        write_data.write_bin(self.folder / "few.bin", scans[0])
        for method in ("patches", "paper", "map-metrics"):
            folder = self.folder / method
            result = self.run_ok(
                "orthogonal", self.folder / "few.bin", "--subset-method", method, "--json", "-", "--out", folder,
                exit_codes=(4,),
            )  # fmt: skip
            document = result.json()
            validate(self, document, "orthogonal")
            self.assertEqual(document["directions"], [])
            self.assertIn("none of 6 points", document["reason"])
            self.assertTrue((folder / "orthogonal.ply").exists())

    def dense_inputs(self):
        """Enough points for patches of 0.3 m."""
        scans, self.poses = geometry.corner(num_scans=4, per_plane=900)
        return write_data.write_dataset(self.folder / "dense", scans, self.poses)

    def test_info_of_scans_maps_and_trajectories(self):
        write_data.write_pcd(self.folder / "a.pcd", self.scans[0], "binary_compressed")
        write_data.write_tum(self.folder / "t.tum", self.poses)
        result = self.run_ok("info", self.folder / "a.pcd", self.inputs[1], self.folder / "t.tum")
        for word in ("a.pcd", "360", "poses.txt", "t.tum", "6"):
            self.assertIn(word, result.stdout)
        documents = self.run_ok("info", self.folder / "a.pcd", "--json", "-").json()
        self.assertIn("360", json.dumps(documents))

    def test_info_tells_of_the_other_files_when_one_cannot_be_read(self):
        write_data.write_tum(self.folder / "t.tum", self.poses)
        (self.folder / "bad.tum").write_text("1 2 3\n")
        result = self.run_ok("info", self.folder / "bad.tum", self.folder / "t.tum", exit_codes=(3,))
        self.assertIn("num_poses", result.stdout)
        self.assertIn("bad.tum: line 1", result.stderr)
        files = self.run_ok("info", self.folder / "bad.tum", self.folder / "t.tum", "--json", "-", exit_codes=(3,)).json()["files"]
        self.assertIn("line 1", files[0]["error"])
        self.assertAlmostEqual(files[1]["duration_s"], 0.5, delta=1e-9)


class ConvertTest(CliTest):
    def setUp(self):
        super().setUp()
        self.scans, self.poses = geometry.corner(num_scans=5, per_plane=30)
        self.points = self.scans[0]

    def convert(self, source, target, *options):
        self.run_ok("convert", source, target, *options)
        return target

    def test_every_point_format_becomes_the_same_ply(self):
        writers = {
            "a.bin": write_data.write_bin,
            "b.pcd.bin": write_data.write_nuscenes,
            "c_ascii.pcd": lambda p, x: write_data.write_pcd(p, x, "ascii"),
            "c_binary.pcd": lambda p, x: write_data.write_pcd(p, x, "binary"),
            "c_compressed.pcd": lambda p, x: write_data.write_pcd(p, x, "binary_compressed"),
            "c_double.pcd": lambda p, x: write_data.write_pcd(p, x, "binary", double=True),
            "c_compressed_double.pcd": lambda p, x: write_data.write_pcd(p, x, "binary_compressed", double=True),
            "d_ascii.ply": lambda p, x: write_data.write_ply(p, x, "ascii"),
            "d_little.ply": lambda p, x: write_data.write_ply(p, x, "binary_little_endian"),
            "d_big.ply": lambda p, x: write_data.write_ply(p, x, "binary_big_endian"),
            "d_double.ply": lambda p, x: write_data.write_ply(p, x, "binary_big_endian", double=True),
            "e.xyz": write_data.write_xyz,
            "f.csv": write_data.write_csv,
            "g.npy": write_data.write_npy,
            "g_single.npy": lambda p, x: write_data.write_npy(p, x, double=False),
        }
        for name, writer in writers.items():
            with self.subTest(source=name):
                writer(self.folder / name, self.points)
                columns = write_data.read_ply(self.convert(self.folder / name, self.folder / f"{name}.ply"))
                self.assertEqual(list(zip(columns["x"], columns["y"], columns["z"], strict=True)), self.points)

    def test_scalar_columns_survive(self):
        write_data.write_bin(self.folder / "a.bin", self.points)
        columns = write_data.read_ply(self.convert(self.folder / "a.bin", self.folder / "a.ply"))
        self.assertEqual(set(columns["scalar_intensity"]), {0.5})
        again = write_data.read_ply(self.convert(self.folder / "a.ply", self.folder / "again.ply"))
        self.assertEqual(columns, again)

    def test_kitti_poses_come_back_to_the_bit(self):
        source = self.folder / "a.txt"
        write_data.write_kitti(source, self.poses)
        once = self.convert(source, self.folder / "b.kitti")
        self.assertEqual(write_data.read_kitti(once), self.poses)

    def test_tum_poses_come_back_to_the_bit(self):
        source = self.folder / "a.tum"
        stamps = [f"{1403715524.907143168 + 0.1 * i:.9f}" for i in range(5)]
        write_data.write_tum(source, self.poses, stamps)
        once = self.convert(source, self.folder / "b.tum")
        before, after = write_data.read_tum(source), write_data.read_tum(once)
        for a, b in zip(before, after, strict=True):
            self.assertEqual(a[:4], b[:4])  # stamp and position: no arithmetic on them at all
            for p, q in zip(a[4:], b[4:], strict=True):
                self.assertAlmostEqual(p, q, delta=1e-15)

    def test_tum_stamps_keep_their_nanoseconds(self):
        write_data.write_tum(self.folder / "a.tum", self.poses[:1], ["1403715524.907143168"])
        self.convert(self.folder / "a.tum", self.folder / "b.tum")
        self.assertIn("1403715524.907143168", (self.folder / "b.tum").read_text())

    def test_kitti_to_tum_and_back_is_within_rounding(self):
        write_data.write_kitti(self.folder / "a.txt", self.poses)
        self.convert(self.folder / "a.txt", self.folder / "b.tum")
        back = write_data.read_kitti(self.convert(self.folder / "b.tum", self.folder / "c.kitti"))
        for p, q in zip(self.poses, back, strict=True):
            for row, other in zip(p, q, strict=True):
                self.assertEqual(row[3], other[3])
                for a, b in zip(row[:3], other[:3], strict=True):
                    self.assertAlmostEqual(a, b, delta=1e-15)

    def test_a_folder_of_matrices_becomes_kitti(self):
        write_data.write_matrices(self.folder / "m", geometry.sensor_path(11))
        target = self.convert(self.folder / "m", self.folder / "b.kitti")
        self.assertEqual(write_data.read_kitti(target), geometry.sensor_path(11))

    def test_unknown_target_lists_the_known_ones(self):
        write_data.write_bin(self.folder / "a.bin", self.points)
        result = self.run_ok("convert", self.folder / "a.bin", self.folder / "a.docx", exit_codes=(2, 3))
        self.assertIn("a.docx", result.stderr)
        self.assertIn("ply", result.stderr)


class PosesFormatTest(OutputTest):
    """The same poses in every format give the same metrics."""

    def test_every_format(self):
        folder = self.folder
        write_data.write_tum(folder / "p.tum", self.poses)
        write_data.write_matrices(folder / "matrices", self.poses)
        lines = ["#timestamp, p_x, p_y, p_z, q_w, q_x, q_y, q_z"]
        for i, p in enumerate(self.poses):
            x, y, z, w = write_data.quaternion(p)
            numbers = [*(row[3] for row in p), w, x, y, z]
            lines.append(",".join([str(1403715524907143168 + i * 10**8), *(write_data.number(v) for v in numbers)]))
        (folder / "p.csv").write_text("\n".join(lines) + "\n")
        expected = self.evaluate(*self.call[1:])
        for name, path in (("tum", "p.tum"), ("matrix", "matrices"), ("euroc", "p.csv")):
            for options in ((), ("--poses-format", name)):
                with self.subTest(format=name, options=options):
                    document = self.evaluate(self.inputs[0], folder / path, *self.call[3:], *options)
                    self.assertEqual(document["inputs"]["poses_format"], name)
                    for metric in ("mme", "mpv"):
                        self.assert_relative(
                            document["metrics"][metric]["value"], expected["metrics"][metric]["value"], 1e-9
                        )
        document = self.evaluate(self.inputs[0], f"{folder}/matrices/pose-*.txt", *self.call[3:])
        self.assertEqual(document["metrics"], expected["metrics"])

    def test_extrinsic_as_a_file_and_as_numbers(self):
        body_from_sensor = geometry.pose(0.4, -0.2, 1.1, (0.3, -0.5, 1.7))
        body_poses = [geometry.compose(p, geometry.inverse(body_from_sensor)) for p in self.poses]
        write_data.write_kitti(self.folder / "body.txt", body_poses)
        numbers = [*(v for row in body_from_sensor for v in row), 0.0, 0.0, 0.0, 1.0]
        text = " ".join(write_data.number(v) for v in numbers)
        (self.folder / "extrinsic.txt").write_text(text + "\n")
        expected = self.evaluate(*self.call[1:])
        for given in (self.folder / "extrinsic.txt", text):
            document = self.evaluate(self.inputs[0], self.folder / "body.txt", "--radius", 0.5, "--extrinsic", given)
            for metric in ("mme", "mpv"):
                self.assert_relative(document["metrics"][metric]["value"], expected["metrics"][metric]["value"], 1e-9)


class HelpTest(CliTest):
    def test_every_verb_has_a_help_with_two_examples(self):
        for verb in VERBS:
            with self.subTest(verb=verb):
                text = self.run_ok(verb, "--help").stdout
                examples = [line for line in text.splitlines() if re.match(rf"^\s*(\$ )?trysquare {verb}\b", line)]
                self.assertGreaterEqual(len(examples), 2, text)
                self.assert_no_escapes(text)

    def test_the_help_lists_the_verbs(self):
        text = self.run_ok("--help").stdout
        for verb in VERBS:
            self.assertIn(verb, text)

    def test_options_of_the_interface_are_in_the_help(self):
        text = self.run_ok("evaluate", "--help").stdout
        options = (
            "--threads --seed --json --out --report --progress --quiet --verbose --config --plot "
            "--poses-format --calib --extrinsic --no-calib --t-max-diff --every --first "
            "--last --min-range --max-range --metrics --radius --min-neighbors --preset --definition "
            "--query-every --subset-method --subset-scans --subset --subset-pose --reference --window "
            "--stride --timing"
        )
        for option in options.split():
            self.assertIn(option, text)

    def test_dashes_and_underscores_are_the_same(self):
        scans, poses = geometry.corner(num_scans=3, per_plane=60)
        inputs = write_data.write_dataset(self.folder, scans, poses)
        dashes = self.evaluate(*inputs, "--radius", 0.5, "--query-every", 3, "--min-neighbors", 5)
        underscores = self.evaluate(*inputs, "--radius", 0.5, "--query_every", 3, "--min_neighbors", 5)
        self.assertEqual(dashes, underscores)

    def test_completion_for_every_shell(self):
        for shell in ("bash", "zsh", "fish"):
            with self.subTest(shell=shell):
                script = self.run_ok("completion", shell).stdout
                for word in ("trysquare", "evaluate", "radius"):
                    self.assertIn(word, script)
                if shutil.which(shell):
                    check = subprocess.run([shell, "-n"], input=script, text=True, capture_output=True, check=False)
                    self.assertEqual(check.returncode, 0, check.stderr)

    def test_bash_completion_completes(self):
        script = self.run_ok("completion", "bash").stdout
        probe = script + (
            "\nfunction_name=$(complete -p trysquare | sed 's/.*-F \\([^ ]*\\).*/\\1/')\n"
            "COMP_WORDS=(trysquare eval); COMP_CWORD=1; COMP_LINE='trysquare eval'; COMP_POINT=14\n"
            '"$function_name" trysquare eval trysquare\necho "${COMPREPLY[@]}"\n'
        )
        done = subprocess.run(["bash", "--norc", "-c", probe], text=True, capture_output=True, check=False)
        self.assertIn("evaluate", done.stdout, done.stderr)


class SettingsTest(CliTest):
    """Command line > environment > config file > defaults."""

    def setUp(self):
        super().setUp()
        scans, poses = geometry.corner(num_scans=3, per_plane=60)
        self.inputs = write_data.write_dataset(self.folder, scans, poses)
        self.config = self.folder / "settings.toml"
        self.config.write_text('# settings\nradius = 0.5\nquery-every = 2\nmetrics = "mpv"\n')

    def settings(self, *options, environment=None):
        return self.evaluate(*self.inputs, *options, environment=environment, exit_codes=(0, 4))["settings"]

    def test_defaults_and_presets(self):
        self.assertEqual(self.settings()["radius_m"], 1.0)
        self.assertEqual(self.settings("--preset", "lidar")["radius_m"], 1.0)
        self.assertEqual(self.settings("--preset", "depth")["radius_m"], 0.2)
        self.assertEqual(self.settings("--preset", "depth", "--radius", 0.3)["radius_m"], 0.3)

    def test_config_file_over_defaults(self):
        settings = self.settings("--config", self.config)
        self.assertEqual((settings["radius_m"], settings["query_every"]), (0.5, 2))

    def test_environment_over_config_file(self):
        settings = self.settings("--config", self.config, environment={"TRYSQUARE_RADIUS": "0.7"})
        self.assertEqual((settings["radius_m"], settings["query_every"]), (0.7, 2))
        self.assertEqual(self.settings(environment={"TRYSQUARE_QUERY_EVERY": "3"})["query_every"], 3)

    def test_command_line_over_all(self):
        environment = {"TRYSQUARE_RADIUS": "0.7"}
        self.assertEqual(
            self.settings("--config", self.config, "--radius", 0.9, environment=environment)["radius_m"], 0.9
        )

    def test_bad_values_of_the_environment_and_the_config_are_named(self):
        result = self.run_ok("evaluate", *self.inputs, environment={"TRYSQUARE_RADIUS": "wide"}, exit_codes=(2,))
        self.assertIn("wide", result.stderr)
        self.config.write_text("radius = -2\n")
        result = self.run_ok("evaluate", *self.inputs, "--config", self.config, exit_codes=(2, 3))
        self.assertIn("-2", result.stderr)

    def test_unknown_keys_of_the_config_are_refused(self):
        self.config.write_text("radios = 0.5\n")
        result = self.run_ok("evaluate", *self.inputs, "--config", self.config, exit_codes=(2, 3))
        self.assertIn("radios", result.stderr)

    def test_missing_and_malformed_config(self):
        result = self.run_ok("evaluate", *self.inputs, "--config", self.folder / "missing.toml", exit_codes=(2, 3))
        self.assertIn("missing.toml", result.stderr)
        self.config.write_text("radius = = 3\n")
        self.run_ok("evaluate", *self.inputs, "--config", self.config, exit_codes=(2, 3))


class ExampleTest(CliTest):
    def test_the_readme_names_only_options_that_exist(self):
        readme = (REPOSITORY / "README.md").read_text()
        commands = [
            line.strip()
            for block in re.findall(r"```(?:sh|bash|console)?\n(.*?)```", readme, re.S)
            for line in re.sub(r"\\\n\s*", "", block).splitlines()
            if re.match(r"(\$ )?(trysquare|build/release/trysquare) ", line.strip())
        ]
        self.assertGreaterEqual(len(commands), 3)
        for command in commands:
            words = command.split("#")[0].split()
            verb = words[1 if words[0] != "$" else 2]
            help_text = self.run_ok(verb, "--help").stdout
            for option in re.findall(r"(?<!\S)(--[a-z_-]+)", command.split("#")[0]):
                self.assertRegex(help_text, rf"{option.replace('_', '-')}\b", command)
