# SPDX-License-Identifier: Apache-2.0
"""pandas is not required: only to_pandas() asks for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas


def frame_of(rows: list[dict[str, Any]]) -> pandas.DataFrame:
    """A table of rows; what is None is missing."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_pandas() needs pandas: pip install pandas") from error
    return pandas.DataFrame(rows)
