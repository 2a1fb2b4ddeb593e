# SPDX-License-Identifier: Apache-2.0
"""`ape` and `rpe` with evo's options against what evo says: 1e-9 relative, 1e-12 absolute near zero."""

import csv
import json
import os
import struct
import xml.etree.ElementTree as ElementTree
import zipfile
import zlib

import geometry
import write_data
from support import CliTest, DataTest, slow, validate

FILES = {
    "KITTI_00_ORB": ("KITTI_00_gt.txt", "KITTI_00_ORB.txt"),
    "fr2_desk_ORB": ("fr2_desk_groundtruth.txt", "fr2_desk_ORB.txt"),
    "V102": ("V102_groundtruth.csv", "V102.txt"),
}
RELATIONS = {
    "full_transformation": "full",
    "translation_part": "trans_part",
    "rotation_part": "rot_part",
    "rotation_angle_deg": "angle_deg",
    "point_distance": "point_distance",
}
UNITS = {"frames": "f", "meters": "m"}
ALIGNMENTS = {
    "none": [()],
    "se3": [("--align",), ("-a",)],
    "sim3": [("--align", "--correct_scale"), ("-as",), ("-a", "-s"), ("--align", "--correct-scale")],
    "origin": [("--align_origin",), ("--align-origin",)],
}


def arguments_of(record, number):
    """The command line of a record. `number` alternates between the spellings that mean the same."""
    words = [record["metric"].lower()]
    spellings = ALIGNMENTS[record["align"]]
    words += spellings[number % len(spellings)]
    relation = RELATIONS[record["relation"]]
    words += [("--pose_relation", "-r", "--pose-relation")[number % 3], relation]
    if record["metric"] == "RPE":
        words += [("--delta", "-d")[number % 2], record["delta"]]
        words += [("--delta_unit", "-u", "--delta-unit")[number % 3], UNITS[record["unit"]]]
        if record["all_pairs"]:
            words.append(("--all_pairs", "--all-pairs")[number % 2])
    return words


def read_png(path):
    """(width, height, number of different lines) of a PNG of 8 bits a channel; of a blank one no more than two differ."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", data[:8]
    place, packed, header = 8, b"", None
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place : place + 8])
        body = data[place + 8 : place + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack(">I", data[place + 8 + length : place + 12 + length])[0]
        header = struct.unpack(">IIBBBBB", body) if kind == b"IHDR" else header
        packed += body if kind == b"IDAT" else b""
        place += 12 + length
    width, height, depth, color_type = header[:4]
    assert depth == 8 and color_type in (2, 6), header
    size = 1 + width * (3 if color_type == 2 else 4)
    pixels = zlib.decompress(packed)
    assert len(pixels) == height * size
    return width, height, len({pixels[y * size : (y + 1) * size] for y in range(height)})


class EvoTest(DataTest):
    def close(self, actual, expected):
        return actual is not None and abs(actual - expected) <= max(1e-9 * abs(expected), 1e-12)

    def check_records(self, step):
        records = self.oracle("trajectory_oracle.json")["records"]
        self.assertGreater(len(records), 100)
        for number, record in list(enumerate(records))[::step]:
            with self.subTest(**{k: v for k, v in record.items() if k != "stats"}):
                self.check_record(number, record)

    def check_record(self, number, record):
        verb, *options = arguments_of(record, number)
        reference, estimate = (self.data / "trajectories" / name for name in FILES[record["case"]])
        result = self.run_ok(verb, reference, estimate, *options, "--json", "-")
        document = result.json()
        self.assertEqual(document["schema"], "trysquare.trajectory/1")
        self.assertEqual(document["num_pairs"], record["pairs"], result)
        actual = document["statistics"]
        wrong = {k: (actual.get(k), v) for k, v in record["stats"].items() if not self.close(actual.get(k), v)}
        self.assertEqual({}, wrong, result)

    def test_no_axes_are_doubted_on_real_data(self):
        for reference, estimate in FILES.values():
            folder = self.data / "trajectories"
            document = self.run_ok("rpe", folder / reference, folder / estimate, "--json", "-").json()
            self.assertNotIn("renamed_axes", [w["code"] for w in document["warnings"]])

    def test_every_fifth_record(self):
        self.check_records(5)

    @slow
    def test_every_record(self):
        self.check_records(1)


class SmallTrajectoryTest(CliTest):
    """What can be worked out by hand."""

    def setUp(self):
        super().setUp()
        self.poses = geometry.sensor_path(12)
        moved = geometry.pose(0.7, 0.1, -0.2, (10.0, -4.0, 2.0))
        self.estimate = [geometry.compose(moved, p) for p in self.poses]
        self.reference_file = self.folder / "reference.txt"
        self.estimate_file = self.folder / "estimate.txt"
        write_data.write_kitti(self.reference_file, self.poses)
        write_data.write_kitti(self.estimate_file, self.estimate)

    def statistics(self, verb, *options):
        return self.run_ok(verb, self.reference_file, self.estimate_file, *options, "--json", "-").json()["statistics"]

    def test_rpe_does_not_see_the_frame_of_the_world(self):
        self.assertLess(self.statistics("rpe", "--all_pairs")["max"], 1e-12)

    def test_ape_sees_it_unless_aligned(self):
        self.assertGreater(self.statistics("ape")["min"], 1.0)
        for option in ("-a", "--align_origin"):
            self.assertLess(self.statistics("ape", option)["max"], 1e-12, option)

    def test_scale_is_corrected_only_when_asked(self):
        write_data.write_kitti(self.estimate_file, [geometry.scaled(p, 3.0) for p in self.estimate])
        self.assertGreater(self.statistics("ape", "-a")["rmse"], 0.1)
        self.assertLess(self.statistics("ape", "-as")["max"], 1e-12)

    def test_angle_in_degrees_and_radians(self):
        """A sensor that does not turn, and an estimate that turns by 0.01 rad from pose to pose."""
        places = [tuple(row[3] for row in p) for p in self.poses]
        write_data.write_kitti(self.reference_file, [geometry.pose(translation=p) for p in places])
        turned = [geometry.pose(yaw=0.01 * i, translation=p) for i, p in enumerate(places)]
        write_data.write_kitti(self.estimate_file, turned)
        radians = self.statistics("rpe", "-r", "angle_rad")
        degrees = self.statistics("rpe", "-r", "angle_deg")
        self.assert_relative(radians["mean"], 0.01, 1e-9)
        self.assert_relative(degrees["mean"], 0.5729577951308232, 1e-9)

    def test_pairs_are_matched_by_time_within_the_greatest_difference(self):
        reference, estimate = self.folder / "reference.tum", self.folder / "estimate.tum"
        write_data.write_tum(reference, self.poses)
        late = [f"{i * 0.1 + (0.004 if i % 2 else 0.03):.9f}" for i in range(len(self.poses))]
        write_data.write_tum(estimate, self.poses, late)
        default = self.run_ok("ape", reference, estimate, "--json", "-").json()
        self.assertEqual(default["num_pairs"], 6)
        for option in ("--t_max_diff", "--t-max-diff"):
            wide = self.run_ok("ape", reference, estimate, option, 0.04, "--json", "-").json()
            self.assertEqual(wide["num_pairs"], 12)

    def test_text_has_the_numbers_of_the_json(self):
        text = self.run_ok("ape", self.reference_file, self.estimate_file).stdout
        for word in ("rmse", "mean", "median", "std", "min", "max", "sse"):
            self.assertIn(word, text)

    def test_unknown_relation_is_a_usage_error(self):
        result = self.run_ok("ape", self.reference_file, self.estimate_file, "-r", "sideways", exit_codes=(2,))
        self.assert_usage_error(result, "sideways", "trans_part")

    def test_the_format_as_a_word_before_the_files_is_not_needed(self):
        result = self.run_ok("ape", "tum", self.reference_file, self.estimate_file, exit_codes=(2,))
        self.assert_usage_error(result, "leave out the word tum", "--poses-format tum")

    def test_times_that_convert_invents_are_told(self):
        result = self.run_ok("convert", self.reference_file, self.folder / "a.tum")
        self.assertIn("no time stamps", result.stderr)
        self.assertEqual(self.run_ok("convert", self.folder / "a.tum", self.folder / "b.kitti").stderr, "")

    def test_different_lengths_without_stamps_are_refused(self):
        write_data.write_kitti(self.estimate_file, self.estimate[:-1])
        result = self.run_ok("ape", self.reference_file, self.estimate_file, exit_codes=(3,))
        self.assertIn("12", result.stderr)
        self.assertIn("11", result.stderr)

    def test_the_alignment_of_a_straight_line_is_undefined_and_says_why(self):
        line = [geometry.pose(0, 0, 0, (float(i), 0.0, 0.0)) for i in range(5)]
        write_data.write_kitti(self.reference_file, line)
        write_data.write_kitti(self.estimate_file, line)
        result = self.run_ok("ape", self.reference_file, self.estimate_file, "-a", "--json", "-", exit_codes=(4,))
        document = result.json()
        validate(self, document, "trajectory")
        self.assertIsNone(document["statistics"])
        self.assertIn("do not fix a rotation", document["reason"])

    def test_interpolation_meets_every_time_inside_the_reference_and_counts_the_rest(self):
        """A reference at constant speed: between its poses it is where the estimate says."""
        reference, estimate = self.folder / "reference.tum", self.folder / "estimate.tum"
        write_data.write_tum(reference, [geometry.pose(translation=(float(i), 0, 0)) for i in range(5)])
        times = [-0.01, 0.05, 0.15, 0.27, 0.41]
        poses = [geometry.pose(translation=(10 * t, 0, 0)) for t in times]
        write_data.write_tum(estimate, poses, [f"{t:.3f}" for t in times])
        document = self.run_ok("ape", reference, estimate, "--interpolate", "--json", "-").json()
        validate(self, document, "trajectory")
        self.assertEqual(document["num_pairs"], 3)
        self.assertLess(document["statistics"]["max"], 1e-12)
        self.assertEqual(document["inputs"]["num_extrapolated"], 2)
        self.assertAlmostEqual(document["inputs"]["median_time_difference_s"], 0.05, delta=1e-9)
        self.assertTrue(document["settings"]["interpolate"])
        gap = self.run_ok("ape", reference, estimate, "--interpolate", "--max-gap", 0.05, exit_codes=(3,))
        self.assertIn("max_gap_s", gap.stderr)

    def test_kitti_drift_of_a_scale_error(self):
        line = [geometry.pose(translation=(1.0 * i, 0.0, 0.0)) for i in range(151)]
        write_data.write_kitti(self.reference_file, line)
        write_data.write_kitti(self.estimate_file, [geometry.scaled(p, 1.02) for p in line])
        result = self.run_ok(
            "rpe", self.reference_file, self.estimate_file, "--kitti", "--lengths", "50,500", "--every-pair", "--json", "-"
        )
        document = result.json()
        validate(self, document, "trajectory")
        self.assertAlmostEqual(document["kitti_drift"]["translation_percent"], 2.02, delta=1e-9)
        self.assertEqual(document["kitti_drift"]["rotation_deg_per_100m"], 0)
        self.assertIsNone(document["kitti_drift"]["by_length"][1]["translation_percent"])
        self.assertEqual([e["num_pairs"] > 0 for e in document["by_length"]], [True, False])
        self.assertEqual(document["every_pair"]["num_pairs"], 151 * 150 // 2)
        self.assertGreater(document["paper_rpe_m2"], 0)
        table = self.run_ok("rpe", self.reference_file, self.estimate_file, "--kitti", "--lengths", "50,500").stdout
        self.assertIn("2.0200", table)
        self.assertIn("no part of the reference is 500 m long", table)

    def test_quantiles_and_units(self):
        centimetres = self.run_ok(
            "ape", self.reference_file, self.estimate_file, "--change_unit", "cm", "--quantiles", "0,0.5,1", "--json", "-"
        ).json()
        metres = self.statistics("ape")
        self.assertEqual(centimetres["unit"], "cm")
        self.assert_relative(centimetres["statistics"]["rmse"], 100 * metres["rmse"])
        self.assert_relative(centimetres["quantiles"]["1"], 100 * metres["max"])
        self.assert_relative(centimetres["quantiles"]["0.5"], 100 * metres["median"])
        wrong = self.run_ok("ape", self.reference_file, self.estimate_file, "--change_unit", "deg", exit_codes=(2,))
        self.assert_usage_error(wrong, "trans_part", "deg")
        ratio = self.run_ok(
            "ape", self.reference_file, self.estimate_file, "-r", "point_distance_error_ratio", exit_codes=(2,)
        )
        self.assert_usage_error(ratio, "point_distance_error_ratio")

    def test_the_extrinsic_is_given_or_found(self):
        body_from_sensor = geometry.pose(0.4, -0.3, 1.2, (0.3, -0.1, 1.7))
        turning = [
            geometry.pose(0.3 * i, 0.4 * (i % 3), -0.2 * (i % 5), (0.5 * i, (i % 4) * 0.3, (i % 2) * 0.2)) for i in range(40)
        ]
        write_data.write_kitti(self.reference_file, turning)
        write_data.write_kitti(self.estimate_file, [geometry.compose(p, body_from_sensor) for p in turning])
        self.assertGreater(self.statistics("ape")["min"], 0.1)
        numbers = " ".join(write_data.number(v) for row in body_from_sensor for v in row)
        self.assertLess(self.statistics("ape", "-r", "full", "--extrinsic", numbers)["max"], 1e-12)
        document = self.run_ok(
            "ape", self.reference_file, self.estimate_file, "-r", "full", "--estimate-extrinsic", "--json", "-"
        ).json()
        validate(self, document, "trajectory")
        self.assertLess(document["statistics"]["max"], 1e-9)
        found = document["estimated_extrinsic"]["body_from_sensor"]
        for a, b in zip(found, [*(v for row in body_from_sensor for v in row), 0, 0, 0, 1], strict=True):
            self.assertAlmostEqual(a, b, delta=1e-10)

    def test_transforms_from_the_left_and_the_right(self):
        left = geometry.pose(0.7, 0.1, -0.2, (10.0, -4.0, 2.0))
        inverse = " ".join(write_data.number(v) for row in geometry.inverse(left) for v in row)
        self.assertLess(self.statistics("ape", "--transform-left", inverse)["max"], 1e-12)
        write_data.write_kitti(self.estimate_file, [geometry.compose(p, left) for p in self.poses])
        self.assertLess(self.statistics("ape", "--transform-right", inverse)["max"], 1e-12)

    def test_every_error_goes_into_a_file_and_into_figures(self):
        errors, plots = self.folder / "errors.csv", self.folder / "plots"
        self.run_ok("rpe", self.reference_file, self.estimate_file, "--csv", errors, "--plot", plots)
        lines = errors.read_text().splitlines()
        self.assertEqual(len(lines), 12)
        self.assertEqual(lines[0], "first,second,stamp_s,reference_distance_m,error_m")
        self.assertEqual(sorted(p.name for p in plots.iterdir()), ["error_map.svg", "error_over_distance.svg"])

    def test_figures_begin_with_the_name_that_was_given_and_png_shows_what_svg_does(self):
        self.run_ok("ape", self.reference_file, self.estimate_file, "--save_plot", self.folder / "run.svg")
        self.run_ok("ape", self.reference_file, self.estimate_file, "--plot", self.folder / "run.png")
        for figure in ("run_error_map", "run_error_over_distance"):
            svg = ElementTree.parse(self.folder / f"{figure}.svg").getroot()
            width, height, num_lines = read_png(self.folder / f"{figure}.png")
            self.assertAlmostEqual(width, 2 * float(svg.get("width")), delta=1)
            self.assertAlmostEqual(height, 2 * float(svg.get("height")), delta=1)
            self.assertGreater(num_lines, 50)
        self.assertEqual(len(list(self.folder.glob("run*"))), 4)

    def test_png_without_its_program_says_what_to_install_before_anything_is_read(self):
        result = self.run_ok(
            "ape", "no.txt", "no.txt", "--plot", self.folder / "run.png", environment={"PATH": "/nowhere"}, exit_codes=(2,)
        )
        self.assert_usage_error(result, "rsvg-convert", "librsvg2-bin")

    def test_png_of_a_program_that_fails_is_an_error_that_repeats_what_it_said(self):
        program = self.folder / "bin" / "rsvg-convert"
        program.parent.mkdir()
        program.write_text("#!/bin/sh\necho it rains >&2\nexit 7\n")
        program.chmod(0o755)
        path = {"PATH": f"{program.parent}:{os.environ['PATH']}"}
        arguments = ("ape", self.reference_file, self.estimate_file, "--plot", self.folder / "run.png")
        result = self.run_ok(*arguments, environment=path, exit_codes=(3,))
        self.assertIn("exit code 7: it rains", result.stderr)
        self.assertEqual(list(self.folder.glob("run*")), [])

    def test_out_writes_everything_there_is(self):
        for verb in ("ape", "rpe"):
            out = self.folder / "out" / verb
            result = self.run_ok(verb, self.reference_file, self.estimate_file, "--out", out, "--json", "-")
            names = {f"{verb}.json", f"{verb}.csv", f"{verb}.zip", f"{verb}_error_map.svg", f"{verb}_error_over_distance.svg"}
            self.assertEqual({p.name for p in out.iterdir()}, names)
            self.assertEqual((out / f"{verb}.json").read_text(), result.stdout)
            rows = list(csv.reader((out / f"{verb}.csv").open()))
            self.assertEqual(len(rows) - 1, result.json()["num_pairs"])
            with zipfile.ZipFile(out / f"{verb}.zip") as archive:
                self.assertIsNone(archive.testzip())
                self.assertIn("reference.txt.kitti", archive.namelist())
                self.assertIn("estimate.txt.kitti", archive.namelist())

    def test_out_has_the_json_of_errors_that_are_undefined(self):
        line = [geometry.pose(0, 0, 0, (float(i), 0.0, 0.0)) for i in range(5)]
        write_data.write_kitti(self.reference_file, line)
        write_data.write_kitti(self.estimate_file, line)
        out = self.folder / "out"
        self.run_ok("ape", self.reference_file, self.estimate_file, "-a", "--out", out, exit_codes=(4,))
        self.assertEqual([p.name for p in out.iterdir()], ["ape.json"])
        self.assertIsNone(json.loads((out / "ape.json").read_text())["statistics"])

    def test_result_files_tell_trajectories_of_one_name_apart(self):
        other = self.folder / "other" / "reference.txt"
        other.parent.mkdir()
        write_data.write_kitti(other, self.estimate)
        self.run_ok("ape", self.reference_file, other, "--save-results", self.folder / "a.zip")
        names = zipfile.ZipFile(self.folder / "a.zip").namelist()
        self.assertEqual(names[-2:], ["reference_reference.txt.kitti", "estimate_reference.txt.kitti"])
        self.run_ok("rpe", self.reference_file, other, "--all_pairs", "--save-results", self.folder / "b.zip")
        self.assertNotIn(".kitti", " ".join(zipfile.ZipFile(self.folder / "b.zip").namelist()))

    def test_a_camera_compared_with_its_body_is_noticed_and_the_extrinsic_it_names_mends_it(self):
        body_from_camera = [[0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0]]
        write_data.write_kitti(self.estimate_file, [geometry.compose(p, body_from_camera) for p in self.poses])
        for verb in ("ape", "rpe"):
            result = self.run_ok(verb, self.reference_file, self.estimate_file, "--json", "-")
            self.assertIn("[renamed_axes]", result.stderr)
            document = result.json()
            validate(self, document, "trajectory")
            self.assertEqual([w["code"] for w in document["warnings"]], ["renamed_axes"])
            extrinsic = document["warnings"][0]["message"].split('--extrinsic "')[1].split('"')[0]
            mended = self.run_ok(
                verb, self.reference_file, self.estimate_file, "-r", "full", "--extrinsic", extrinsic, "--json", "-"
            )
            self.assertLess(mended.json()["statistics"]["max"], 1e-12)
            self.assertEqual(mended.json()["warnings"], [])
            self.assertNotIn("renamed_axes", mended.stderr)

    def test_no_common_time_is_refused(self):
        reference, estimate = self.folder / "reference.tum", self.folder / "estimate.tum"
        write_data.write_tum(reference, self.poses)
        write_data.write_tum(estimate, self.poses, [f"{1000 + i}.0" for i in range(12)])
        result = self.run_ok("ape", reference, estimate, exit_codes=(3, 4))
        self.assertIn("estimate.tum", result.stderr)
