# SPDX-License-Identifier: Apache-2.0
"""Files are written by the library: whole or not at all, through links, and devices as they are."""

from __future__ import annotations

import os
from pathlib import Path

from trysquare import _core


def write_text(path: str | Path, text: str) -> None:
    """Writes UTF-8. Raises IoError naming the file."""
    _core.write_file(os.fspath(path), text)
