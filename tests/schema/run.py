#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds what the report library writes against docs/schema: tests/schema/run.py PATH/TO/trysquare_schema_examples

Every document follows its schema, and no document with one thing wrong does. Figures are well-formed XML, alone and in
the page. Needs Python 3.10 with jsonschema.
"""

import copy
import json
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import jsonschema

SCHEMAS = Path(__file__).resolve().parents[2] / "docs" / "schema"
EXAMPLES = None  # set by main
KINDS = ("comparison", "diagnosis", "evaluation", "experiment", "orthogonal", "simulation", "trajectory")

# The only places where null needs no reason: nothing was given.
NULL_IS_ALLOWED = {("inputs", key) for key in ("poses", "poses_format", "extrinsic", "reference", "subset")}
NULL_IS_ALLOWED |= {("inputs", "reference_extrinsic"), ("inputs", "mesh")}
NULL_IS_ALLOWED |= {("settings", key) for key in ("max_range_m", "window", "stride")}
NULL_IS_ALLOWED |= {("trajectories", i, "extrinsic") for i in range(2)}
MAY_BE_ABSENT = {("timing",), ("quantiles", "0.5"), ("quantiles", "0.99")}
# Only some experiments have them.
MAY_BE_ABSENT |= {("settings", "point_sigma_m"), ("settings", "sensor")}


def validator(kind):
    schema = json.loads((SCHEMAS / f"{kind}.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def documents():
    for kind in KINDS:
        paths = sorted(EXAMPLES.glob(f"{kind}-*.json"))
        assert len(paths) >= 2, f"{kind}: {len(paths)} examples in {EXAMPLES}"
        for path in paths:
            yield kind, path.name, json.loads(path.read_text())


def places(value, path=()):
    """Every (path, value) of a document, the root first."""
    yield path, value
    children = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in children:
        yield from places(child, (*path, key))


def changed(document, path, change):
    """A copy of the document, with change(parent, key) applied to the place."""
    document = copy.deepcopy(document)
    parent = document
    for key in path[:-1]:
        parent = parent[key]
    change(parent, path[-1])
    return document


def replaced(document, path, value):
    return changed(document, path, lambda parent, key: parent.__setitem__(key, value))


class SchemaTest(unittest.TestCase):
    def test_every_document_follows_its_schema(self):
        for kind, name, document in documents():
            errors = [f"{'/'.join(map(str, e.path))}: {e.message}" for e in validator(kind).iter_errors(document)]
            self.assertEqual([], errors[:5], name)

    def test_every_null_has_its_reason_beside_it(self):
        evaluations = [(name, document) for kind, name, document in documents() if kind == "evaluation"]
        for name, document in evaluations:
            for path, value in places(document):
                nulls = [key for key, part in value.items() if part is None] if isinstance(value, dict) else []
                for key in (key for key in nulls if (*path, key) not in NULL_IS_ALLOWED):
                    reason = value.get(f"{key}_reason") or value.get("reason")
                    self.assertTrue(reason, f"{name}: {'/'.join(map(str, (*path, key)))}")

    def assert_refused(self, changes):
        """changes(document) yields (what was changed, the changed document)."""
        for kind, name, document in documents():
            check = validator(kind)
            num_changes = 0
            for what, wrong in changes(document):
                num_changes += 1
                self.assertFalse(check.is_valid(wrong), f"{name}: the schema accepts {what}")
            self.assertGreaterEqual(num_changes, 3, name)

    def test_no_key_may_be_missing(self):
        def changes(document):
            for path, _ in places(document):
                if path and isinstance(path[-1], str) and path not in MAY_BE_ABSENT:
                    yield f"no {path}", changed(document, path, lambda parent, key: parent.pop(key))

        self.assert_refused(changes)

    def test_no_key_may_be_unknown(self):
        def changes(document):
            yield "an unknown key", {**document, "unknown": 1}
            for path, value in places(document):
                if path and isinstance(value, dict):
                    yield f"{path}/unknown", replaced(document, path, {**value, "unknown": 1})

        self.assert_refused(changes)

    def test_no_value_may_be_null_without_a_reason(self):
        def changes(document):
            for path, value in places(document):
                if path and value is not None and path not in NULL_IS_ALLOWED:
                    yield f"null at {path}", replaced(document, path, None)

        self.assert_refused(changes)

    def test_no_number_may_be_a_string(self):
        def changes(document):
            for path, value in places(document):
                if isinstance(value, (int, float)):
                    yield f"'1' at {path}", replaced(document, path, "1")

        self.assert_refused(changes)

    def test_no_count_and_no_variance_may_be_negative(self):
        def changes(document):
            for path, value in places(document):
                is_size = path and re.match(r"num_|rmse|sse|path_length|mpv$|mom$", str(path[-1]))
                if is_size and type(value) in (int, float):
                    yield f"-1 at {path}", replaced(document, path, -1)

        self.assert_refused(changes)


class FigureTest(unittest.TestCase):
    def test_figures_are_well_formed_alone(self):
        figures = sorted(EXAMPLES.glob("*.svg"))
        self.assertIn("windows_heatmap_mpv.svg", [path.name for path in figures])
        for path in figures:
            self.assertEqual(ElementTree.parse(path).getroot().tag, "{http://www.w3.org/2000/svg}svg", path.name)

    def test_figures_are_well_formed_in_the_page(self):
        num_figures = 0
        for path in sorted(EXAMPLES.glob("*.html")):
            for figure in re.findall(r"<svg.*?</svg>", path.read_text(), re.DOTALL):
                ElementTree.fromstring(figure)
                num_figures += 1
        self.assertGreater(num_figures, 10)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="trysquare_schema_") as folder:
        EXAMPLES = Path(folder)
        subprocess.run([sys.argv.pop(1), folder], check=True)
        unittest.main()
