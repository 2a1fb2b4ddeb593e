# SPDX-License-Identifier: Apache-2.0
"""The command `trysquare` of the wheel: runs the program that lies in the package.

A module of its own, so that the command does not wait for numpy."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def main() -> None:
    """Becomes the program: its exit code, signals and streams are the command's own."""
    program = Path(__file__).parent / "trysquare" / "bin" / "trysquare"
    os.execv(program, [str(program), *sys.argv[1:]])
