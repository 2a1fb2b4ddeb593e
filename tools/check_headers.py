#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fail if a public header does not compile alone, declares something without a doc comment, or is in no HEADERS list.

Public is what the HEADERS list of its folder's CMakeLists.txt names. A header that is in no such list must live under
internal/ or serve tests only (`test` is a word of its name, or the TESTS list names it).

A header that the source of the same stem includes before anything else is compiled alone by every build already; the
others are compiled here.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

DECLARATION = re.compile(r"^(?:template\b|struct\b|class\b|enum\b|union\b|using\b|.*[\w>&*\]]\s*(?:\(|=|\{|;))", re.S)
FORWARD_DECLARATION = re.compile(r"^(?:template\b[^;{]*)?(?:class|struct|enum(?: class)?) \w+(?: : [\w:]+)?;$")


def listed_files(cmake_lists: str, keyword: str) -> list[str]:
    """File names after `keyword` in the trysquare_module() calls of a CMakeLists.txt."""
    names: list[str] = []
    without_comments = re.sub(r"#.*", "", cmake_lists)
    for call in re.findall(r"trysquare_module\s*\((.*?)\)", without_comments, re.S):
        current = ""
        for word in call.split():
            if word in {"LIBRARY", "HEADERS", "SOURCES", "TESTS"}:
                current = word
            elif current == keyword:
                names.append(word)
    return names


def is_test_helper(path: pathlib.Path) -> bool:
    return re.search(r"(?:^|_)test(?:_|$)", path.stem) is not None


def is_proven_by_build(header: pathlib.Path, include_root: pathlib.Path, sources: list[str]) -> bool:
    """Whether x.cpp is a listed source and its first #include is x.h."""
    source = header.with_suffix(".cpp")
    if source.name not in sources or not source.exists():
        return False
    first = re.search(r"^\s*#\s*include\s*(\S+)", source.read_text(encoding="utf-8"), re.M)
    return first is not None and first[1] == f'"{header.relative_to(include_root).as_posix()}"'


def blank_comments_and_strings(line: str) -> str:
    line = re.sub(r'"(?:\\.|[^"\\])*"' + r"|'(?:\\.|[^'\\])'", '""', line)
    line = re.sub(r"/\*.*?\*/", " ", line)
    return line.split("//")[0].rstrip()


def undocumented(text: str) -> list[tuple[int, str]]:
    """Line and text of every declaration at namespace scope that no `///` comment stands directly above of.

    One comment may serve several functions that follow each other without an empty line.
    """
    found = []
    inside = 0  # braces open below namespace scope
    documented = False
    grouped = False  # the comment belongs to a function just above
    statement: list[str] = []
    start = 0
    for number, raw in enumerate(text.splitlines(), 1):
        stripped = raw.strip()
        code = blank_comments_and_strings(raw).strip()
        if inside == 0 and not statement:
            if stripped.startswith("///"):
                documented, grouped = True, False
                continue
            if not code or code.startswith("#"):
                documented = documented and bool(stripped)  # an empty line parts a comment from what follows
                continue
            if re.match(r"^(?:inline )?namespace\b[^;]*\{$", code) or code == "}":
                documented = False
                continue
            start = number
        if inside == 0:
            statement.append(code)
        inside += code.count("{") - code.count("}") + code.count("(") - code.count(")")
        if inside == 0 and statement and code.endswith((";", "}")):
            declaration = " ".join(statement)
            is_function = "(" in declaration and not re.match(r"(?:struct|class|enum|union)\b", declaration)
            covered = documented and (is_function or not grouped)
            if not covered and DECLARATION.match(declaration) and not FORWARD_DECLARATION.match(declaration):
                found.append((start, declaration.split("{")[0].strip()[:100]))
                documented = False
            statement, documented, grouped = [], documented and is_function, True
    return found


def compiles_alone(header: pathlib.Path, include_root: pathlib.Path, compiler: str) -> str:
    """Empty, or what the compiler said."""
    source = f'#include "{header.relative_to(include_root).as_posix()}"\n'
    command = [compiler, "-std=c++20", "-fsyntax-only", f"-I{include_root}", "-isystem", "/usr/include/eigen3", "-xc++",
               "-"]
    done = subprocess.run(command, input=source, capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stderr.strip() or f"{compiler} exited with {done.returncode}"


def check(root: pathlib.Path, compiler: str) -> tuple[list[str], int]:
    include_root = root / "src"
    errors: list[str] = []
    public: list[pathlib.Path] = []
    to_compile: list[pathlib.Path] = []
    for folder in sorted(path for path in (include_root / "trysquare").iterdir() if path.is_dir()):
        lists = folder / "CMakeLists.txt"
        text = lists.read_text(encoding="utf-8") if lists.exists() else ""
        headers = [folder / name for name in listed_files(text, "HEADERS")]
        for_tests = {folder / name for name in listed_files(text, "TESTS")}
        errors += [f"{lists}: HEADERS names {path.name}, which does not exist" for path in headers if not path.exists()]
        public += [path for path in headers if path.exists()]
        sources = listed_files(text, "SOURCES")
        to_compile += [path for path in headers
                       if path.exists() and not is_proven_by_build(path, include_root, sources)]
        for path in sorted(folder.rglob("*.h")):
            if path not in headers and "internal" not in path.relative_to(folder).parts and path not in for_tests \
                    and not is_test_helper(path):
                errors.append(f"{path}: in no HEADERS list; list it, or move it to internal/")
    for path in public:
        errors += [f"{path}:{line}: no /// comment on: {what}" for line, what in
                   undocumented(path.read_text(encoding="utf-8"))]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        said = pool.map(lambda header: compiles_alone(header, include_root, compiler), to_compile)
        errors += [f"{path}: does not compile alone:\n{text}"
                   for path, text in zip(to_compile, said, strict=True) if text]
    if not public:
        errors.append(f"{include_root}: no public header found")
    return errors, len(public)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", nargs="?", default=".", type=pathlib.Path, help="repository root")
    parser.add_argument("--compiler", default=os.environ.get("CXX", "c++"))
    arguments = parser.parse_args()
    errors, count = check(arguments.root, arguments.compiler)
    print("\n".join(errors) or f"headers ok: {count} public headers")
    return bool(errors)


if __name__ == "__main__":
    sys.exit(main())
