# SPDX-License-Identifier: Apache-2.0
"""The same input gives the same bytes, at every thread count."""

import geometry
import write_data
from support import CliTest, DataTest


class DeterminismTest(CliTest):
    def setUp(self):
        super().setUp()
        scans, poses = geometry.corner(num_scans=12, per_plane=300, noise_m=0.02)
        self.inputs = write_data.write_dataset(self.folder, scans, poses)
        self.options = ("--radius", 0.4, "--window", 4, "--stride", 2, "--reference", self.inputs[1])

    def output(self, threads, out=None):
        extra = ("--out", out, "--report", out.with_suffix(".html"), "--plot", out) if out else ()
        return self.run_ok("evaluate", *self.inputs, *self.options, "--threads", threads, "--json", "-", *extra).stdout

    def test_json_is_bit_identical_for_every_number_of_threads(self):
        one = self.output(1)
        self.assertGreater(len(one), 1000)
        for threads in (2, 3, 7):
            self.assertEqual(one, self.output(threads), f"{threads} threads")

    def test_the_same_call_twice_gives_the_same_files(self):
        self.output(1, self.folder / "a")
        self.output(3, self.folder / "b")
        names = sorted(p.relative_to(self.folder / "a") for p in (self.folder / "a").rglob("*") if p.is_file())
        self.assertGreaterEqual(len(names), 5)
        self.assertEqual(
            names, sorted(p.relative_to(self.folder / "b") for p in (self.folder / "b").rglob("*") if p.is_file())
        )
        for name in names:
            same = (self.folder / "a" / name).read_bytes() == (self.folder / "b" / name).read_bytes()
            self.assertTrue(same, f"{name} differs")
        self.assertEqual((self.folder / "a.html").read_bytes(), (self.folder / "b.html").read_bytes())

    def test_orthogonal_and_map_do_not_depend_on_threads(self):
        write_data.write_ply(self.folder / "map.ply", [p for s in geometry.corner()[0] for p in s])
        for call in (("orthogonal", *self.inputs), ("map", self.folder / "map.ply")):
            with self.subTest(verb=call[0]):
                outputs = [
                    self.run_ok(*call, "--radius", 0.4, "--threads", t, "--json", "-", exit_codes=(0, 4)).stdout
                    for t in (1, 2, 3)
                ]
                self.assertEqual(outputs[0], outputs[1])
                self.assertEqual(outputs[0], outputs[2])

    def test_where_the_command_is_called_from_does_not_matter(self):
        scans, poses = (str(p.relative_to(self.folder)) for p in self.inputs)
        relative = self.run_ok("evaluate", scans, poses, "--radius", 0.4, "--json", "-", cwd=self.folder).json()
        absolute = self.run_ok("evaluate", *self.inputs, "--radius", 0.4, "--json", "-").json()
        self.assertEqual(relative["metrics"], absolute["metrics"])


class DepthDeterminismTest(DataTest):
    def test_depth_data(self):
        depth = self.data / "arcore-depth"
        outputs = [
            self.run_ok(
                "evaluate", depth / "pcs", depth / "poses", "--preset", "depth", "--threads", threads, "--json", "-"
            ).stdout
            for threads in (1, 2, 3)
        ]
        self.assertEqual(outputs[0], outputs[1])
        self.assertEqual(outputs[0], outputs[2])
