# SPDX-License-Identifier: Apache-2.0
"""Each check must fail on what it is there to find. Run: python3 -m unittest discover -s tools/tests"""
import contextlib
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest
from collections.abc import Iterator
from typing import ClassVar

TOOLS = pathlib.Path(__file__).resolve().parent.parent


def load(name: str) -> types.ModuleType:
    spec = importlib.util.spec_from_file_location(name, TOOLS / f"{name}.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


check_headers = load("check_headers")
check_docs = load("check_docs")


@contextlib.contextmanager
def tree(files: dict[str, str]) -> Iterator[pathlib.Path]:
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        yield root


def run_tool(name: str, root: pathlib.Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(TOOLS / name), str(root)], capture_output=True, text=True, check=False)


class CheckLayers(unittest.TestCase):
    LAYERS = "core:\nparallel: core\nmetrics: core parallel\n"

    def run_on(self, files: dict[str, str]) -> str:
        with tree({"layers.txt": self.LAYERS, **files}) as root:
            done = run_tool("check_layers.py", root)
        self.assertEqual(done.returncode != 0, "layers ok" not in done.stdout)
        return done.stdout

    def test_accepts_an_include_downwards(self) -> None:
        self.assertIn("layers ok", self.run_on({"metrics/a.h": '#include "trysquare/core/b.h"\n'}))

    def test_refuses_an_include_upwards(self) -> None:
        self.assertIn("core may not include metrics", self.run_on({"core/a.h": '#include "trysquare/metrics/b.h"\n'}))

    def test_refuses_another_folders_internals(self) -> None:
        self.assertIn("private to core", self.run_on({"metrics/a.cpp": '#include "trysquare/core/internal/b.h"\n'}))

    def test_refuses_tbb_outside_parallel(self) -> None:
        self.assertIn("belongs to parallel", self.run_on({"metrics/a.cpp": "#include <tbb/parallel_for.h>\n"}))

    def test_refuses_embree_outside_simulation(self) -> None:
        self.assertIn("belongs to simulation", self.run_on({"metrics/a.cpp": "#include <embree3/rtcore.h>\n"}))

    def test_refuses_iostream(self) -> None:
        self.assertIn("no library folder", self.run_on({"core/a.cpp": "#include <iostream>\n"}))

    def test_refuses_a_cycle(self) -> None:
        with tree({"layers.txt": "core: metrics\nmetrics: core\n"}) as root:
            self.assertIn("not declared above it", run_tool("check_layers.py", root).stdout)


class CheckHeaders(unittest.TestCase):
    LISTS = "trysquare_module(LIBRARY trysquare HEADERS a.h SOURCES a.cpp TESTS a_test.cpp)\n"

    def errors(self, header: str, more: dict[str, str] | None = None) -> str:
        files = {"src/trysquare/core/CMakeLists.txt": self.LISTS, "src/trysquare/core/a.h": header, **(more or {})}
        with tree(files) as root:
            return "\n".join(check_headers.check(root, "c++")[0])

    def test_accepts_a_documented_header(self) -> None:
        header = ("#pragma once\nnamespace t {\n\n/// Doc.\nstruct S {\n  int a = 0;\n};\n\n"
                  "/// Doc\n/// of two lines.\nint f(int a,\n      int b);\n\nclass Later;\n\n}\n")
        self.assertEqual(self.errors(header), "")

    def test_refuses_a_header_that_needs_another_include_before_it(self) -> None:
        self.assertIn("does not compile alone", self.errors("#pragma once\n/// Doc.\nstd::size_t f();\n"))

    def test_leaves_a_header_to_the_build_only_if_its_source_includes_it_first(self) -> None:
        header = "#pragma once\n/// Doc.\nstd::size_t f();\n"
        includes = '#include "trysquare/core/a.h"\n#include <vector>\n'
        self.assertEqual(self.errors(header, {"src/trysquare/core/a.cpp": includes}), "")
        other_order = "".join(reversed(includes.splitlines(keepends=True)))
        self.assertIn("does not compile alone", self.errors(header, {"src/trysquare/core/a.cpp": other_order}))

    def test_refuses_an_undocumented_function(self) -> None:
        self.assertIn("a.h:3: no /// comment on: int f();",
                      self.errors("#pragma once\nnamespace t {\nint f();\n}\n"))

    def test_refuses_an_undocumented_struct_after_a_documented_one(self) -> None:
        header = "#pragma once\nnamespace t {\n/// Doc.\nstruct S {};\nstruct T {\n};\n}\n"
        self.assertIn("struct T", self.errors(header))

    def test_refuses_a_comment_that_an_empty_line_parts_from_its_function(self) -> None:
        self.assertIn("int f();", self.errors("#pragma once\n/// Doc.\n\nint f();\n"))

    def test_takes_one_comment_for_functions_that_follow_each_other(self) -> None:
        self.assertEqual(self.errors("#pragma once\n/// Doc.\nint f();\nint g();\nint h();\n"), "")
        self.assertIn("int g();", self.errors("#pragma once\n/// Doc.\nint f();\n\nint g();\n"))
        self.assertIn("struct S", self.errors("#pragma once\n/// Doc.\nint f();\nstruct S {};\n"))
        self.assertIn("int g();", self.errors("#pragma once\n/// Doc.\nstruct S {};\nint g();\n"))

    def test_refuses_an_undocumented_constant_and_template(self) -> None:
        said = self.errors("#pragma once\nnamespace t {\ninline constexpr double kA = 1;\n"
                           "template <class T>\nT g(T a) {\n  return a;\n}\n}\n")
        self.assertIn("kA", said)
        self.assertIn("template", said)

    def test_refuses_a_header_in_no_list(self) -> None:
        self.assertIn("b.h: in no HEADERS list", self.errors("#pragma once\n", {"src/trysquare/core/b.h": ""}))

    def test_accepts_internal_and_test_headers(self) -> None:
        self.assertEqual(self.errors("#pragma once\n", {"src/trysquare/core/internal/b.h": "",
                                                        "src/trysquare/core/test_clouds.h": ""}), "")

    def test_refuses_a_listed_header_that_does_not_exist(self) -> None:
        with tree({"src/trysquare/core/CMakeLists.txt": self.LISTS}) as root:
            self.assertIn("does not exist", "\n".join(check_headers.check(root, "c++")[0]))


class CheckDocs(unittest.TestCase):
    ARCHITECTURE = ("# A\n\n## Layers\n\n```\ncore:\nio: core\n```\n\n## Where is\n\n| q | p | s |\n|---|---|---|\n"
                    "| where is MOM? | `src/mom.cpp` | `mom` |\n")
    GOOD: ClassVar[dict[str, str]] = {
        "ARCHITECTURE.md": ARCHITECTURE, "src/trysquare/layers.txt": "# graph\ncore:\nio: core\n",
        "src/mom.cpp": "int mom();\n", "src/mom_test.cpp": "TEST(Mom, IsRight) {}\nTEST_P(\n    Mom, Scales) {}\n",
        "docs/definitions.md": "# D\n\n## mom\n\n- Ours: mean\n- Test: `Mom.IsRight`,\n  `Mom.Scales`\n"}

    def errors(self, changed: dict[str, str]) -> str:
        with tree({**self.GOOD, **changed}) as root:
            return "\n".join(check_docs.check(root))

    def test_accepts_true_documentation(self) -> None:
        self.assertEqual(self.errors({}), "")

    def test_refuses_a_link_to_nowhere(self) -> None:
        self.assertIn("README.md:3: link to gone.md", self.errors({"README.md": "a\n\n[b](gone.md)\n"}))

    def test_refuses_a_fragment_that_no_heading_has(self) -> None:
        self.assertIn("no heading #mpv", self.errors({"README.md": "[b](docs/definitions.md#mpv)\n"}))
        self.assertEqual(self.errors({"README.md": "[b](docs/definitions.md#mom)\n"}), "")

    def test_ignores_links_in_code_blocks_and_to_the_web(self) -> None:
        self.assertEqual(self.errors({"README.md": "```\n[b](gone.md)\n```\n[c](https://example.org/x)\n"}), "")

    def test_refuses_a_comment_that_names_a_heading_that_is_gone(self) -> None:
        self.assertIn("src/a.h:1: docs/definitions.md has no heading #ape",
                      self.errors({"src/a.h": "/// docs/definitions.md#ape\n"}))

    def test_refuses_other_layers(self) -> None:
        self.assertIn("differs", self.errors({"src/trysquare/layers.txt": "core:\nio: core stats\n"}))

    def test_refuses_a_place_that_does_not_exist(self) -> None:
        self.assertIn("src/mpv.cpp does not exist",
                      self.errors({"ARCHITECTURE.md": self.ARCHITECTURE.replace("src/mom.cpp", "src/mpv.cpp")}))

    def test_refuses_a_symbol_that_is_not_in_its_place(self) -> None:
        self.assertIn("no 'mom' in", self.errors({"src/mom.cpp": "int momentum();\n"}))

    def test_refuses_a_test_that_does_not_exist(self) -> None:
        self.assertIn("no test is called Mom.Scales", self.errors({"src/mom_test.cpp": "TEST(Mom, IsRight) {}\n"}))

    def test_refuses_an_entry_without_a_test(self) -> None:
        self.assertIn("an entry without a test",
                      self.errors({"docs/definitions.md": "# D\n\n## mom\n\n- Ours: mean\n- Test: none yet\n"}))
        self.assertIn("1 entries", self.errors({"docs/definitions.md": "# D\n\n- Ours: mean\n"}))


class CheckSpdx(unittest.TestCase):
    LINE = "SPDX-License-Identifier: Apache-2.0"

    def run_on(self, files: dict[str, str]) -> str:
        scripts = {"run": f"#!/bin/bash\n# {self.LINE}\n", ".ci/run": f"#!/bin/bash\n# {self.LINE}\n"}
        with tree({**scripts, **files}) as root:
            return run_tool("check_spdx.py", root).stdout

    def test_accepts_the_first_line_and_the_one_after_a_shebang(self) -> None:
        self.assertIn("ok", self.run_on({"src/a.h": f"// {self.LINE}\n"}))

    def test_refuses_a_file_without_it(self) -> None:
        self.assertIn("src/a.cpp", self.run_on({"src/a.cpp": f"#include <a>\n// {self.LINE}\n"}))

    def test_leaves_test_data_alone(self) -> None:
        self.assertIn("ok", self.run_on({"tests/data/a.py": "x\n"}))


if __name__ == "__main__":
    unittest.main()
