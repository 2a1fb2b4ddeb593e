# SPDX-License-Identifier: Apache-2.0
"""Malformed input: exit 3, the path and the line or byte on stderr, nothing written, little memory, little time.

And wrong usage: exit 2 with the option, the value and what would be right.
"""

import struct

import geometry
import write_data
from support import MEMORY_LIMIT_BYTES, REPOSITORY, CliTest, mentions_place

POINTS = geometry.corner(num_scans=1, per_plane=20)[0][0]
HUGE = 10**12


def replaced(data, old, new):
    assert old in data, (old, data[:300])
    return data.replace(old, new, 1)


def pcd(encoding, **options):
    return write_data.pcd_bytes(POINTS, encoding, **options)


def ply(encoding, **options):
    return write_data.ply_bytes(POINTS, encoding, **options)


def claiming(data):
    """The same file with a header that promises 10^12 points."""
    for old, new in (
        (f"WIDTH {len(POINTS)}\n", f"WIDTH {HUGE}\n"),
        (f"POINTS {len(POINTS)}\n", f"POINTS {HUGE}\n"),
        (f"element vertex {len(POINTS)}\n", f"element vertex {HUGE}\n"),
    ):
        data = data.replace(old.encode(), new.encode())
    return data


def ascii_with_word(data):
    """The last number of an ascii file becomes a word."""
    return data.rstrip().rsplit(b" ", 1)[0] + b" three\n"


XYZ = "".join(" ".join(map(str, p)) + "\n" for p in POINTS).encode()
NPY = write_data.npy_bytes(POINTS)
PLY_LIST = (
    b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list uint float x\nproperty float y\n"
    b"property float z\nend_header\n" + struct.pack("<I", 0xFFFFFFFF)
)

# name of the file → (its bytes, does the message have to say the line or the byte?)
BAD_SCANS = {
    "truncated.bin": (b"\0" * 16 * 5 + b"\0" * 7, True),
    "empty.bin": (b"", False),
    "truncated.pcd.bin": (b"\0" * 20 * 5 + b"\0" * 7, True),
    "truncated_ascii.pcd": (b"\n".join(pcd("ascii").split(b"\n")[:-4]) + b"\n", True),
    "truncated_binary.pcd": (pcd("binary")[:-5], True),
    "truncated_double.pcd": (pcd("binary", double=True)[:-5], True),
    "truncated_compressed.pcd": (pcd("binary_compressed")[:-5], True),
    "corrupt_compressed.pcd": (pcd("binary_compressed")[:-40] + b"\xff" * 40, True),
    "compressed_claims_4gb.pcd": (
        write_data.pcd_header(0xFFFFFFF0 // 12, "binary_compressed").encode()
        + struct.pack("<2I", 64, 0xFFFFFFF0)
        + b"\xe0" * 64,
        True,
    ),
    "claims_ascii.pcd": (claiming(pcd("ascii")), True),
    "claims_binary.pcd": (claiming(pcd("binary")), True),
    "claims_compressed.pcd": (claiming(pcd("binary_compressed")), True),
    "negative.pcd": (replaced(pcd("binary"), b"POINTS 60", b"POINTS -5"), True),
    "overflow.pcd": (
        replaced(replaced(pcd("binary"), b"WIDTH 60", b"WIDTH 4294967296"), b"HEIGHT 1", b"HEIGHT 4294967296"),
        True,
    ),
    "huge_count.pcd": (replaced(pcd("binary"), b"COUNT 1 1 1", b"COUNT 1 1 1000000000"), True),
    "unknown_type.pcd": (replaced(pcd("binary"), b"TYPE F F F", b"TYPE F F X"), True),
    "no_xyz.pcd": (replaced(pcd("binary"), b"FIELDS x y z", b"FIELDS a b c"), True),
    "no_data_line.pcd": (pcd("ascii").split(b"DATA")[0], True),
    "text.pcd": (ascii_with_word(pcd("ascii")), True),
    "empty.pcd": (b"", False),
    "truncated_ascii.ply": (b"\n".join(ply("ascii").split(b"\n")[:-4]) + b"\n", True),
    "truncated_little.ply": (ply("binary_little_endian")[:-5], True),
    "truncated_big.ply": (ply("binary_big_endian")[:-5], True),
    "truncated_double.ply": (ply("binary_little_endian", double=True)[:-5], True),
    "claims_ascii.ply": (claiming(ply("ascii")), True),
    "claims_little.ply": (claiming(ply("binary_little_endian")), True),
    "claims_big.ply": (claiming(ply("binary_big_endian")), True),
    "negative.ply": (replaced(ply("ascii"), b"element vertex 60", b"element vertex -5"), True),
    "list_claims_4gb.ply": (PLY_LIST, True),
    "no_end_header.ply": (ply("ascii").split(b"end_header")[0], True),
    "long_header.ply": (b"ply\nformat ascii 1.0\ncomment " + b"x" * 10_000_000, False),
    "no_xyz.ply": (replaced(ply("ascii"), b"property float x", b"property float a"), True),
    "text.ply": (ascii_with_word(ply("ascii")), True),
    "not_a_ply.ply": (XYZ, True),
    "empty.ply": (b"", False),
    "text.xyz": (ascii_with_word(XYZ), True),
    "two_columns.xyz": (XYZ + b"1.0 2.0\n", True),
    "empty.xyz": (b"", False),
    "text.csv": (b"x,y,z\n1,2,3\n4,five,6\n", True),
    "short_row.csv": (b"x,y,z\n1,2,3\n4,5\n", True),
    "empty.csv": (b"", False),
    "pickled.npy": (write_data.npy_header("|O", (3,)) + b"\x80\x04]q\x00.", False),
    "truncated.npy": (NPY[:-5], True),
    "truncated_header.npy": (NPY[:40], True),
    "claims.npy": (write_data.npy_header("<f8", (HUGE, 3)) + b"\0" * 240, True),
    "overflow.npy": (write_data.npy_header("<f8", (2**62, 3)) + b"\0" * 240, True),
    "two_columns.npy": (write_data.npy_header("<f8", (15, 2)) + b"\0" * 240, False),
    "strings.npy": (write_data.npy_header("<U8", (15, 3)) + b"\0" * 1440, False),
    "not_numpy.npy": (XYZ, False),
    "empty.npy": (b"", False),
    "scan.unknown": (XYZ, False),
}

GOOD_ROW = "1 0 0 0 0 1 0 0 0 0 1 0\n"
BAD_POSES = {
    "nan.txt": (GOOD_ROW * 2 + "1 0 0 nan 0 1 0 0 0 0 1 0\n" + GOOD_ROW, "3"),
    "infinite.txt": (GOOD_ROW * 2 + "1 0 0 inf 0 1 0 0 0 0 1 0\n" + GOOD_ROW, "3"),
    "rotation_off.txt": (GOOD_ROW + "1 0.002 0 0 0 1 0 0 0 0 1 0\n" + GOOD_ROW * 2, "2"),
    "scaled_rotation.txt": (GOOD_ROW + "1.01 0 0 0 0 1.01 0 0 0 0 1.01 0\n" + GOOD_ROW * 2, "2"),
    "mirrored.txt": (GOOD_ROW + "1 0 0 0 0 1 0 0 0 0 -1 0\n" + GOOD_ROW * 2, "2"),
    "zero_rotation.txt": (GOOD_ROW + "0 0 0 0 0 0 0 0 0 0 0 0\n" + GOOD_ROW * 2, "2"),
    "eleven.txt": (GOOD_ROW * 3 + "1 0 0 0 0 1 0 0 0 0 1\n", "4"),
    "text.txt": (GOOD_ROW * 3 + "1 0 0 0 0 one 0 0 0 0 1 0\n", "4"),
    "trailing_text.txt": (GOOD_ROW * 3 + "1 0 0 0 0 1 0 0 0 0 1 0x\n", "4"),
    "huge_number.txt": (GOOD_ROW * 3 + "1 0 0 1e999 0 1 0 0 0 0 1 0\n", "4"),
    "quaternion_zero.tum": ("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 0\n2 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n", "2"),
    "quaternion_off.tum": ("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1.5\n2 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n", "2"),
    "nan.tum": ("0 0 0 0 0 0 0 1\n1 0 nan 0 0 0 0 1\n2 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n", "2"),
    "seven.tum": ("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n2 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n", "2"),
}


class BadInputTest(CliTest):
    def setUp(self):
        super().setUp()
        self.scans, self.poses = geometry.corner(num_scans=4, per_plane=40)
        self.scans_folder, self.poses_file = write_data.write_dataset(self.folder, self.scans, self.poses)
        self.one_pose = self.folder / "one_pose.txt"
        write_data.write_kitti(self.one_pose, self.poses[:1])

    def outputs(self):
        return [self.folder / "out", self.folder / "e.json", self.folder / "r.html", self.folder / "plots"]

    def refused(self, *words, names, place=False, json_to_stdout=False):
        """One call that has to fail as INTERFACE says; returns its stderr."""
        out, json_file, report, plots = self.outputs()
        json_target = "-" if json_to_stdout else json_file
        result = self.run_ok(
            *words,
            "--out",
            out,
            "--json",
            json_target,
            "--report",
            report,
            "--plot",
            plots,
            exit_codes=(3,),
            timeout_s=20,
        )
        self.check_refusal(result, names, place)
        for path in self.outputs():
            left = list(path.rglob("*")) if path.is_dir() else path.exists()
            self.assertFalse(left, f"partial output: {path}\n{result}")
        return result.stderr

    def check_refusal(self, result, names, place=False):
        self.assertEqual(result.stdout, "", result)
        for name in [names] if isinstance(names, str) else names:
            self.assertIn(name, result.stderr, result)
        if place:
            self.assertTrue(mentions_place(result.stderr), f"no line or byte: {result}")
        self.assertNotIn("terminate called", result.stderr, result)
        self.assertLess(result.peak_bytes, MEMORY_LIMIT_BYTES, result)
        self.assertLess(result.seconds, 10, result)

    def refused_evaluate(self, scans, poses, *options, **expectations):
        return self.refused("evaluate", scans, poses, "--radius", 0.5, *options, **expectations)

    # --- scans

    def test_every_bad_scan_is_refused_with_its_name_and_place(self):
        for name, (content, place) in BAD_SCANS.items():
            with self.subTest(scan=name):
                folder = self.folder / f"case_{name}"
                folder.mkdir()
                (folder / name).write_bytes(content)
                self.refused_evaluate(folder / "*", self.one_pose, names=name, place=place)

    def test_a_bad_scan_in_the_middle_is_the_one_that_is_named(self):
        bad = self.scans_folder / "scan-2.bin"
        bad.write_bytes(bad.read_bytes()[:-3])
        for threads in (1, 3):
            stderr = self.refused_evaluate(
                self.scans_folder, self.poses_file, "--threads", threads, names="scan-2.bin", place=True
            )
            self.assertNotIn("scan-1.bin", stderr)

    def test_json_on_stdout_stays_empty_too(self):
        bad = self.scans_folder / "scan-3.bin"
        bad.write_bytes(b"\0" * 17)
        self.refused_evaluate(self.scans_folder, self.poses_file, names="scan-3.bin", json_to_stdout=True)

    def test_pickle_is_named(self):
        folder = self.folder / "pickled"
        folder.mkdir()
        (folder / "a.npy").write_bytes(BAD_SCANS["pickled.npy"][0])
        stderr = self.refused_evaluate(folder, self.one_pose, names="a.npy")
        self.assertIn("pickle", stderr.lower())

    def test_unknown_format_lists_the_known_ones(self):
        folder = self.folder / "unknown"
        folder.mkdir()
        (folder / "a.unknown").write_bytes(XYZ)
        stderr = self.refused_evaluate(folder / "*", self.one_pose, names="a.unknown")
        for known in (".bin", ".pcd", ".ply", ".npy"):
            self.assertIn(known, stderr)

    def test_scans_that_are_not_there(self):
        empty = self.folder / "nothing_here"
        empty.mkdir()
        for scans in (self.folder / "missing_scans", empty, self.folder / "nothing_*.bin"):
            with self.subTest(scans=scans.name):
                self.refused_evaluate(scans, self.poses_file, names=scans.name)

    # --- poses

    def test_every_bad_pose_file_is_refused_with_its_line(self):
        for name, (text, line) in BAD_POSES.items():
            with self.subTest(poses=name):
                poses = self.folder / name
                poses.write_text(text)
                stderr = self.refused_evaluate(self.scans_folder, poses, names=name)
                self.assertRegex(stderr, rf"line {line}\b")

    def test_a_bad_pose_in_a_folder_of_matrices_names_its_file(self):
        write_data.write_matrices(self.folder / "matrices", self.poses)
        (self.folder / "matrices" / "pose-2.txt").write_text("1 0 0 0\n0 1 0 zero\n0 0 1 0\n0 0 0 1\n")
        self.refused_evaluate(self.scans_folder, self.folder / "matrices", names="pose-2.txt", place=True)

    def test_wrong_number_of_poses_says_both_numbers(self):
        for count in (3, 5):
            with self.subTest(poses=count):
                poses = self.folder / "count.txt"
                write_data.write_kitti(poses, [geometry.identity()] * count)
                stderr = self.refused_evaluate(self.scans_folder, poses, names="count.txt")
                self.assertRegex(stderr, rf"\b{count}\b")
                self.assertRegex(stderr, r"\b4\b")

    def test_poses_that_are_not_there(self):
        empty_file = self.folder / "empty.txt"
        empty_file.write_text("")
        comments = self.folder / "comments.txt"
        comments.write_text("# timestamp tx ty tz qx qy qz qw\n")
        empty_folder = self.folder / "no_poses"
        empty_folder.mkdir()
        for poses in (self.folder / "missing.txt", empty_file, comments, empty_folder, self.folder / "pose_*.txt"):
            with self.subTest(poses=poses.name):
                self.refused_evaluate(self.scans_folder, poses, names=poses.name)

    def test_binary_garbage_as_poses(self):
        garbage = self.folder / "garbage.txt"
        garbage.write_bytes(bytes(range(256)) * 20)
        self.refused_evaluate(self.scans_folder, garbage, names="garbage.txt")

    def test_scans_given_as_poses(self):
        self.refused_evaluate(self.scans_folder, self.scans_folder, names="scans")

    def test_a_rotation_slightly_off_is_a_warning_and_tiny_errors_are_silent(self):
        for off, warned in ((1e-4, True), (1e-6, False)):
            with self.subTest(off=off):
                poses = [[list(row) for row in p] for p in self.poses]
                poses[1][0][0] += off
                file = self.folder / "slightly.txt"
                write_data.write_kitti(file, poses)
                document = self.evaluate(self.scans_folder, file, "--radius", 0.5, "--metrics", "mpv")
                text = " ".join(f"{w['code']} {w['message']}" for w in document["warnings"])
                self.assertEqual("rotation" in text, warned, text)
                self.assertEqual("slightly.txt: line 2" in text, warned, text)

    # --- other inputs

    def test_other_files_that_are_missing_or_malformed(self):
        words = self.folder / "words.txt"
        words.write_text("these are words\n")
        no_tr = self.folder / "no_tr.txt"
        no_tr.write_text("P0: 1 0 0 0 0 1 0 0 0 0 1 0\n")
        cases = (
            ("--calib", self.folder / "missing_calib.txt"),
            ("--calib", no_tr),
            ("--calib", words),
            ("--extrinsic", words),
            ("--reference", self.folder / "missing_reference.txt"),
            ("--reference", words),
            ("--subset", self.folder / "missing_*.npy"),
            ("--subset-pose", self.folder / "missing_pose.txt"),
        )
        for option, path in cases:
            with self.subTest(option=option, path=path.name):
                extra = (
                    ("--subset", write_data.write_subset(self.folder, [POINTS])) if option == "--subset-pose" else ()
                )
                self.refused_evaluate(self.scans_folder, self.poses_file, option, path, *extra, names=path.name)

    def test_reference_of_another_length(self):
        reference = self.folder / "short.txt"
        write_data.write_kitti(reference, self.poses[:3])
        self.refused_evaluate(self.scans_folder, self.poses_file, "--reference", reference, names="short.txt")

    def test_the_other_verbs_refuse_the_same_way(self):
        bad = self.folder / "bad.pcd"
        bad.write_bytes(BAD_SCANS["truncated_binary.pcd"][0])
        missing = self.folder / "missing.pcd"
        bad_poses = self.folder / "bad_poses.txt"
        bad_poses.write_text(BAD_POSES["text.txt"][0])
        calls = (
            (("map", bad, "--radius", 0.5), "bad.pcd"),
            (("map", missing, "--radius", 0.5), "missing.pcd"),
            (("info", bad), "bad.pcd"),
            (("info", missing), "missing.pcd"),
            (("convert", bad, self.folder / "converted.ply"), "bad.pcd"),
            (("convert", bad_poses, self.folder / "converted.tum"), "bad_poses.txt"),
            (("orthogonal", bad), "bad.pcd"),
            (("ape", self.poses_file, bad_poses), "bad_poses.txt"),
            (("rpe", bad_poses, self.poses_file), "bad_poses.txt"),
        )
        for call, name in calls:
            with self.subTest(verb=call[0], file=name):
                self.check_refusal(self.run_ok(*call, exit_codes=(3,), timeout_s=20), name)
                self.assertFalse((self.folder / "converted.ply").exists())
                self.assertFalse((self.folder / "converted.tum").exists())

    def test_output_that_cannot_be_written_is_named(self):
        for option in ("--json", "--report"):
            with self.subTest(option=option):
                target = self.folder / "no" / "such" / "folder" / "file.x"
                result = self.run_ok(
                    "evaluate", self.scans_folder, self.poses_file, "--radius", 0.5, option, target, exit_codes=(3,)
                )
                self.assertIn(str(target.parent), result.stderr)


class UsageTest(CliTest):
    def setUp(self):
        super().setUp()
        scans, poses = geometry.corner(num_scans=3, per_plane=30)
        self.inputs = write_data.write_dataset(self.folder, scans, poses)

    def refused(self, *words, says):
        with self.subTest(words=" ".join(map(str, words))):
            result = self.run_ok(*words, exit_codes=(2,))
            self.assert_usage_error(result, *says)

    def test_unknown_verb_and_option(self):
        self.refused("evalute", says=["evalute"])
        self.refused("evaluate", *self.inputs, "--radios", 1, says=["--radios"])

    def test_no_verb(self):
        result = self.run_ok(exit_codes=(0, 2))
        self.assertRegex(result.stdout + result.stderr, "evaluate|--help")

    def test_missing_arguments(self):
        self.refused("evaluate", says=[])
        self.refused("evaluate", self.inputs[0], says=[])
        self.refused("ape", self.inputs[1], says=[])

    def test_values_out_of_range_name_the_option_and_the_value(self):
        for option, value in (
            ("--radius", "0"),
            ("--radius", "-1"),
            ("--radius", "nan"),
            ("--radius", "inf"),
            ("--radius", "wide"),
            ("--radius", "1x"),
            ("--min-neighbors", "0"),
            ("--min-neighbors", "-3"),
            ("--min-neighbors", "2.5"),
            ("--query-every", "0"),
            ("--query-every", "-1"),
            ("--every", "-1"),
            ("--window", "-2"),
            ("--stride", "-2"),
            ("--window", "1"),
            ("--window", "0"),
            ("--every", "0"),
            ("--threads", "-1"),
            ("--threads", "many"),
            ("--subset-scans", "0"),
        ):
            self.refused("evaluate", *self.inputs, f"{option}={value}", says=[option.lstrip("-").split("-")[0], value])

    def test_the_range_is_said(self):
        for option, value in (("--radius", "0"), ("--min-neighbors", "0"), ("--query-every", "0"), ("--window", "1")):
            with self.subTest(option=option):
                result = self.run_ok("evaluate", *self.inputs, option, value, exit_codes=(2,))
                self.assertRegex(result.stderr, r"[<>]|at least|positive|between|greater|range|\[\d")

    def test_stride_zero_with_a_window(self):
        self.refused("evaluate", *self.inputs, "--window", 2, "--stride", 0, says=["stride", "0"])

    def test_windows_of_the_orthogonal_verb(self):
        self.refused("orthogonal", *self.inputs, "--window", 0, says=["--window 0", "at least 1"])
        self.refused("orthogonal", *self.inputs, "--window", 2, "--stride", 0, says=["--stride 0", "at least 1"])
        self.refused("orthogonal", *self.inputs, "--stride", 2, says=["--stride", "without --window"])
        self.refused("orthogonal", *self.inputs, "--subset-scans", 0, says=["--subset-scans 0"])
        self.refused("orthogonal", *self.inputs, "--subset-method", "magic", says=["magic", "patches", "map-metrics"])
        self.refused("orthogonal", *self.inputs, "--radius", "nan", says=["radius"])
        self.refused("orthogonal", self.inputs[0], says=["3 scans without poses"])

    def test_unknown_words_are_answered_with_the_known_ones(self):
        self.refused("evaluate", *self.inputs, "--metrics", "mme,mpx", says=["mpx", "mpv", "mom"])
        self.refused(
            "evaluate", *self.inputs, "--definition", "papers", says=["papers", "paper", "map-metrics", "mapeval"]
        )
        self.refused("evaluate", *self.inputs, "--preset", "sonar", says=["sonar", "lidar", "depth"])
        self.refused("evaluate", *self.inputs, "--poses-format", "rosbag", says=["rosbag", "kitti", "tum"])
        self.refused("evaluate", *self.inputs, "--progress", "sometimes", says=["sometimes", "never"])
        self.refused("evaluate", *self.inputs, "--subset-method", "magic", says=["magic", "paper"])

    def test_ranges_that_are_empty(self):
        self.refused("evaluate", *self.inputs, "--min-range", 5, "--max-range", 2, says=["range"])
        self.refused("evaluate", *self.inputs, "--first", 2, "--last", 1, says=["first", "last"])

    def test_calib_and_no_calib_exclude_each_other(self):
        self.refused("evaluate", *self.inputs, "--calib", self.inputs[1], "--no-calib", says=["calib"])

    def test_unknown_shell_for_completion(self):
        self.refused("completion", "tcsh", says=["tcsh"])


class MalformedTrajectoryTest(CliTest):
    """The table of docs/user/trajectories.md, row by row."""

    def rows(self):
        text = (REPOSITORY / "docs" / "user" / "trajectories.md").read_text()
        table = text[text.index("| format | file | message |") :].splitlines()[2:]
        for line in table:
            named, content, message = (cell.strip() for cell in line.strip("|").split("|"))
            yield named.strip("`"), content.strip("`").replace("↵", "\n"), message

    def test_each_file_of_the_table_gets_its_message(self):
        rows = list(self.rows())
        self.assertGreater(len(rows), 20)
        for named, content, message in rows:
            with self.subTest(format=named, content=content):
                file = self.folder / "poses.txt"
                file.write_text(content)
                out = self.folder / "out.kitti"
                result = self.run_ok("convert", file, out, "--from", named, exit_codes=(3,))
                self.assertIn(f"{file}: {message}", result.stderr)
                self.assertFalse(out.exists())
