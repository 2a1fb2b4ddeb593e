#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fail if the documentation says what is not so.

- Relative links in *.md lead to a file, and their #fragments to a heading or anchor of it.
- Links of code comments to docs/*.md#anchor do too.
- The block under "## Layers" in ARCHITECTURE.md is src/trysquare/layers.txt, comments aside.
- Under "## Where is" in ARCHITECTURE.md every path exists, and every symbol stands in one of the paths of its row.
- Every `Suite.Name` of docs/definitions.md is a test, and every entry of the ledger names at least one.
"""
import argparse
import pathlib
import re
import sys
from collections.abc import Iterator

SKIPPED_FOLDERS = {".git", "build", "demo", "node_modules"}
CODE_FOLDERS = ("src", "apps", "python", "tests", "tools", "benchmarks")


def files(root: pathlib.Path, suffixes: set[str]) -> Iterator[pathlib.Path]:
    for path in sorted(root.rglob("*")):
        if path.suffix in suffixes and path.is_file() and not SKIPPED_FOLDERS & set(path.relative_to(root).parts):
            yield path


def without_fences(text: str) -> str:
    """The text with fenced code blanked, line numbers kept."""
    return re.sub(r"^```.*?^```", lambda block: "\n" * block[0].count("\n"), text, flags=re.S | re.M)


def anchors(text: str) -> set[str]:
    """Fragments that GitHub's rendering of this Markdown offers."""
    found = set(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", text))
    for heading in re.findall(r"^#{1,6} +(.+?) *$", without_fences(text), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        slug = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        number = 1
        unique = slug
        while unique in found:
            unique, number = f"{slug}-{number}", number + 1
        found.add(unique)
    return found


def section(text: str, heading: str) -> str:
    """What stands under `## heading`, up to the next heading of that level."""
    match = re.search(rf"^## {re.escape(heading)} *\n(.*?)(?=^## |\Z)", text, re.S | re.M)
    return match[1] if match else ""


def line_of(text: str, position: int) -> int:
    return text.count("\n", 0, position) + 1


def broken_links(root: pathlib.Path) -> list[str]:
    errors = []
    for path in files(root, {".md"}):
        text = without_fences(path.read_text(encoding="utf-8"))
        for match in re.finditer(r"\]\(<?([^)\s>]+)>?(?: \"[^\"]*\")?\)", text):
            if re.match(r"[a-z]+:", match[1]):
                continue
            target, _, fragment = match[1].partition("#")
            where = f"{path.relative_to(root)}:{line_of(text, match.start())}"
            file = (path.parent / target) if target else path
            if not file.exists():
                errors.append(f"{where}: link to {target}, which does not exist")
            elif fragment and file.suffix == ".md" and fragment not in anchors(file.read_text(encoding="utf-8")):
                errors.append(f"{where}: {file.name} has no heading #{fragment}")
    return errors


def broken_references_from_code(root: pathlib.Path) -> list[str]:
    errors = []
    for folder in CODE_FOLDERS:
        if not (root / folder).is_dir() or folder == "tools":
            continue
        for path in files(root / folder, {".h", ".cpp", ".py", ".txt"}):
            text = path.read_text(encoding="utf-8", errors="replace")
            for match in re.finditer(r"\b(docs/[\w./-]+\.md)(?:#([\w-]+))?", text):
                target = root / match[1]
                where = f"{path.relative_to(root)}:{line_of(text, match.start())}"
                if not target.exists():
                    errors.append(f"{where}: names {match[1]}, which does not exist")
                elif match[2] and match[2] not in anchors(target.read_text(encoding="utf-8")):
                    errors.append(f"{where}: {match[1]} has no heading #{match[2]}")
    return errors


def wrong_layers(root: pathlib.Path) -> list[str]:
    quoted = re.search(r"^```\w*\n(.*?)^```", section((root / "ARCHITECTURE.md").read_text(encoding="utf-8"), "Layers"),
                       re.S | re.M)
    truth = [line for line in (root / "src/trysquare/layers.txt").read_text(encoding="utf-8").splitlines()
             if line and not line.startswith("#")]
    if quoted is None:
        return ["ARCHITECTURE.md: no fenced block under '## Layers'"]
    if quoted[1].splitlines() != truth:
        return ["ARCHITECTURE.md: the block under '## Layers' differs from src/trysquare/layers.txt"]
    return []


def wrong_places(root: pathlib.Path) -> list[str]:
    errors = []
    table = section((root / "ARCHITECTURE.md").read_text(encoding="utf-8"), "Where is")
    rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in table.splitlines()
            if line.startswith("|")][2:]
    for row in rows:
        if len(row) != 3:
            errors.append(f"ARCHITECTURE.md#where-is: three cells expected (question, path, symbol): {row}")
            continue
        paths = re.findall(r"`([^`]+)`", row[1])
        if not paths:
            errors.append(f"ARCHITECTURE.md#where-is: no path for '{row[0]}'")
        texts = []
        for name in paths:
            if not (root / name).exists():
                errors.append(f"ARCHITECTURE.md#where-is: {name} does not exist")
            elif (root / name).is_file():
                texts.append((root / name).read_text(encoding="utf-8"))
        for symbol in re.findall(r"`([^`]+)`", row[2]):
            if not any(re.search(rf"(?<!\w){re.escape(symbol)}(?!\w)", text) for text in texts):
                errors.append(f"ARCHITECTURE.md#where-is: no '{symbol}' in {' '.join(paths)}")
    if not rows:
        errors.append("ARCHITECTURE.md: no table under '## Where is'")
    return errors


def known_tests(root: pathlib.Path) -> set[str]:
    """`Suite.Name` of GoogleTest and `test_name` or `Class.test_name` of Python."""
    names: set[str] = set()
    for folder in CODE_FOLDERS:
        if not (root / folder).is_dir():
            continue
        for path in files(root / folder, {".cpp", ".h"}):
            for suite, name in re.findall(r"\b(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)",
                                          path.read_text(encoding="utf-8")):
                names.add(f"{suite}.{name}")
        for path in files(root / folder, {".py"}):
            current = ""
            for line in path.read_text(encoding="utf-8").splitlines():
                if match := re.match(r"class (\w+)", line):
                    current = match[1]
                elif match := re.match(r"(\s*)(?:async )?def (test_\w+)", line):
                    names.update({match[2], f"{current}.{match[2]}"} if match[1] else {match[2]})
    return names


def wrong_ledger(root: pathlib.Path) -> list[str]:
    errors = []
    text = (root / "docs/definitions.md").read_text(encoding="utf-8")
    tests = known_tests(root)
    for match in re.finditer(r"`([A-Z]\w*\.(?:[A-Z]|test_)\w*|test_\w+)`", text):
        if match[1] not in tests:
            errors.append(f"docs/definitions.md:{line_of(text, match.start())}: no test is called {match[1]}")
    for match in re.finditer(r"^- Test:(.*(?:\n  .*)*)", text, re.M):
        if not re.search(r"`(?:[A-Z]\w*\.|test_)\w+`", match[1]):
            errors.append(f"docs/definitions.md:{line_of(text, match.start())}: an entry without a test")
    entries = len(re.findall(r"^- Ours:", text, re.M))
    fixed = len(re.findall(r"^- Test:", text, re.M))
    if entries == 0 or entries != fixed:
        errors.append(f"docs/definitions.md: {entries} entries ('- Ours:') but {fixed} with '- Test:'")
    return errors


def check(root: pathlib.Path) -> list[str]:
    return (broken_links(root) + broken_references_from_code(root) + wrong_layers(root) + wrong_places(root)
            + wrong_ledger(root))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=".", type=pathlib.Path, help="repository root")
    errors = check(parser.parse_args().root.resolve())
    print("\n".join(errors) or "documentation ok")
    return bool(errors)


if __name__ == "__main__":
    sys.exit(main())
