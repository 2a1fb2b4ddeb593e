# SPDX-License-Identifier: Apache-2.0
"""Runs the tutorials: the code blocks of a page, in order, in one namespace.

A ```text block after a ```python block is what that block prints. Prose is held to its numbers by a line such as

    <!-- 0.573: comparison["ground truth"].rpe_m -->

after the paragraph: the paragraph must contain the number, and the expression must round to it. In both, numbers may
differ by `units` in the last digit behind the point; whole numbers and the rest must be equal.

    python python/tests/tutorials.py docs/tutorials/first-evaluation.md

runs a page in the current folder, writes what it prints into its ```text blocks and leaves its figures in figures/.
"""

from __future__ import annotations

import contextlib
import dataclasses
import io
import re
import sys
from pathlib import Path
from typing import Any

BLOCK = re.compile(r"^```(?P<language>\w*)\n(?P<body>.*?)^```$", re.MULTILINE | re.DOTALL)
CLAIM = re.compile(r"^<!-- (?P<number>[^ :]+): (?P<expression>.+) -->$", re.MULTILINE)
NUMBER = re.compile(r"(?<![\w.])[-−]?\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?")
FIGURE = re.compile(r"!\[[^\]]*\]\((?P<path>[^)]+)\)")


@dataclasses.dataclass
class Part:
    """A piece of a page that is run or compared, and where it starts."""

    kind: str  # "python", "text" or "claim"
    text: str
    line: int
    start: int = 0
    number: str = ""
    paragraph: str = ""


def parts_of(page: str) -> list[Part]:
    """Code, outputs and claims in the order of the page."""
    parts = []
    for match in BLOCK.finditer(page):
        if match["language"] in ("python", "text"):
            line = page[: match.start("body")].count("\n")
            parts.append(Part(match["language"], match["body"], line, match.start("body")))
    for match in CLAIM.finditer(page):
        paragraph = CLAIM.sub("", page[: match.start()]).rstrip().rsplit("\n\n", 1)[-1]
        line = page[: match.start()].count("\n")
        parts.append(Part("claim", match["expression"], line, match.start(), match["number"], paragraph))
    return sorted(parts, key=lambda part: part.start)


def last_digit(number: str) -> float:
    """The worth of the last digit that is written: 0.01 for 0.573e1 and for 5.73."""
    mantissa, _, exponent = number.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return float(10.0 ** (int(exponent or 0) - decimals))


def value_of(number: str) -> float:
    return float(number.replace(",", "").replace("−", "-"))


def agree(written: str, value: float, units: float) -> bool:
    """Whether a value could be written so, up to `units` in the last digit behind the point, and rounding."""
    allowed = units + 0.5 if "." in written else 0.5
    return abs(value_of(written) - value) <= allowed * last_digit(written) * (1 + 1e-9)


def require_output(written: str, printed: str, where: str, units: float) -> None:
    """AssertionError unless both are the same up to the last digits of their numbers."""
    wanted, found = (re.sub(r"[ \t]+", " ", text.strip()) for text in (written, printed))
    assert NUMBER.sub("#", wanted) == NUMBER.sub("#", found), f"{where}: prints\n{printed}\ninstead of\n{written}"
    for one, other in zip(NUMBER.findall(wanted), NUMBER.findall(found), strict=True):
        assert agree(one, value_of(other), units), f"{where}: prints {other} instead of {one}, in\n{printed}"


def require_claim(part: Part, names: dict[str, Any], where: str, units: float) -> None:
    """AssertionError unless the paragraph says the number and the expression has it."""
    assert part.number in NUMBER.findall(part.paragraph), f"{where}: the text before does not say {part.number}"
    value = float(eval(part.text, names))  # the expression stands in a page of this repository
    assert agree(part.number, value, units), f"{where}: {part.text} is {value}, and the text says {part.number}"


def run(page: str, name: str, units: float) -> list[str]:
    """Runs a page in the current folder; what its blocks of code printed. AssertionError where it is wrong."""
    names: dict[str, Any] = {"__name__": name}
    printed: list[str] = []
    for part in parts_of(page):
        where = f"{name}, line {part.line + 1}"
        if part.kind == "python":
            output = io.StringIO()
            with contextlib.redirect_stdout(output):
                exec(compile("\n" * part.line + part.text, name, "exec"), names)
            printed.append(output.getvalue())
        elif part.kind == "text" and units >= 0:
            require_output(part.text, printed[-1], where, units)
        elif part.kind == "claim" and units >= 0:
            require_claim(part, names, where, units)
    return printed


def figures_of(page: str) -> list[str]:
    """The figures that a page shows, as paths relative to it."""
    return [match["path"] for match in FIGURE.finditer(page)]


def with_outputs(page: str, printed: list[str]) -> str:
    """The page with its ```text blocks replaced by what was printed."""
    parts = [part for part in parts_of(page) if part.kind != "claim"]
    index = sum(part.kind == "python" for part in parts)
    for part in reversed(parts):
        if part.kind == "python":
            index -= 1
        else:
            page = page[: part.start] + printed[index - 1] + page[part.start + len(part.text) :]
    return page


if __name__ == "__main__":
    for path in map(Path, sys.argv[1:]):
        text = path.read_text()
        path.write_text(with_outputs(text, run(text, path.name, units=-1)))
