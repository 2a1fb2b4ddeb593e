#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fail if a source file does not name its licence in its first line (its second after a #! line)."""
import pathlib
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
LINE = "SPDX-License-Identifier: Apache-2.0"
FOLDERS = ("src", "apps", "tests", "tools", "benchmarks", "python")
SUFFIXES = {".h", ".cpp", ".py", ".sh"}

files = [ROOT / "run", ROOT / ".ci/run"]
for folder in FOLDERS:
    files += (path for path in sorted((ROOT / folder).rglob("*")) if path.suffix in SUFFIXES and path.is_file())

errors = []
for path in files:
    if "data" in path.relative_to(ROOT).parts[:-1]:  # inputs of tests are taken byte for byte
        continue
    head = path.read_text(encoding="utf-8").splitlines()[:2]
    first = head[1:] if head and head[0].startswith("#!") else head[:1]
    if not first or LINE not in first[0]:
        errors.append(f"{path}: the first line must be '{'//' if path.suffix in {'.h', '.cpp'} else '#'} {LINE}'")

print("\n".join(errors) or f"licence lines ok: {len(files)} files")
sys.exit(bool(errors))
