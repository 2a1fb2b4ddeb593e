# SPDX-License-Identifier: Apache-2.0
"""The tutorials run as they are written, and say what they find."""

from __future__ import annotations

from pathlib import Path

import pytest
from tutorials import agree, figures_of, parts_of, require_claim, require_output, run, with_outputs

TUTORIALS = Path(__file__).parents[2] / "docs" / "tutorials"


def run_in(folder: Path, name: str, units: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs a page in a folder, and looks for its figures there and beside the page."""
    pytest.importorskip("matplotlib").use("Agg")
    (folder / "figures").mkdir()
    monkeypatch.chdir(folder)
    page = (TUTORIALS / name).read_text()
    run(page, name, units)
    figures = figures_of(page)
    assert figures
    for figure in figures:
        assert (folder / figure).stat().st_size > 10_000, f"{figure}: {name} does not draw it"
        assert (TUTORIALS / figure).is_file(), f"{figure} is missing beside {name}"


@pytest.mark.slow
def test_first_evaluation(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run_in(tmp_path, "first-evaluation.md", 1, monkeypatch)


@pytest.mark.slow
def test_comparing_odometries(tmp_path: Path, data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("small_gicp")
    pytest.importorskip("kiss_icp")
    (tmp_path / "sequences").mkdir()
    (tmp_path / "poses").mkdir()
    (tmp_path / "sequences" / "00").symlink_to(data / "kitti00")
    (tmp_path / "poses" / "00.txt").symlink_to(data / "kitti00" / "poses.txt")
    run_in(tmp_path, "comparing-odometries.md", 2, monkeypatch)


PAGE = """
Two and two are 4.0.
<!-- 4.0: total -->

```python
total = 2 + 2
print("total:", total / 3, "of", 1e-7)
```

```text
total: 1.3333 of 1e-07
```

The sum is 4.0, and a third of it 1.33.
<!-- 4.0: total -->
<!-- 1.33: total / 3 -->
"""


def test_a_page_runs_in_order() -> None:
    parts = parts_of(PAGE)
    assert [part.kind for part in parts] == ["claim", "python", "text", "claim", "claim"]
    assert parts[4].paragraph == "The sum is 4.0, and a third of it 1.33."
    with pytest.raises(NameError):
        run(PAGE, "page", 0)  # the first claim comes before the code
    assert run(PAGE.replace("<!-- 4.0: total -->\n", "", 1), "page", 0) == [f"total: {4 / 3} of 1e-07\n"]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("1.3333 of", "1.3335 of", "prints 1.33.* instead of 1.3335"),
        ("total: 1.3333", "sum: 1.3333", "instead of"),
        ("a third of it 1.33", "a third of it 1.34", "does not say 1.33"),
        ("1.33: total / 3", "1.33: total / 4", "total / 4 is 1.0, and the text says 1.33"),
        ("2 + 2", "2 + 2.1", r"prints 1\.36"),
    ],
)
def test_a_page_that_is_wrong_fails(old: str, new: str, message: str) -> None:
    page = PAGE.replace("<!-- 4.0: total -->\n", "", 1).replace(old, new)
    with pytest.raises(AssertionError, match=message):
        run(page, "page", 0)


def test_numbers_agree_up_to_their_last_digit() -> None:
    assert agree("0.573", 0.57349, 0) and not agree("0.573", 0.57351, 0)
    assert agree("0.573", 0.5742, 1) and not agree("0.573", 0.5746, 1)
    assert agree("2,452,809", 2452809, 2) and not agree("2,452,809", 2452810, 2)
    assert agree("35", 34.6, 2) and not agree("35", 34.4, 2)
    assert agree("−1.2e-3", -0.00124, 0) and not agree("−1.2e-3", -0.00126, 0)
    require_output("a  1.0\n", "a 1.0", "here", 0)
    with pytest.raises(AssertionError, match="here"):
        require_output("a 1 2", "a 1", "here", 0)


def test_a_claim_is_about_its_own_paragraph() -> None:
    part = parts_of("It is 5.\n\nIt is 6.\n<!-- 5: 5 -->\n")[0]
    with pytest.raises(AssertionError, match="does not say 5"):
        require_claim(part, {}, "here", 0)


def test_outputs_are_written_into_the_page() -> None:
    page = "```python\nprint(1)\n```\n\n```text\nold\n```\n\n```python\nprint(2)\n```\n```text\n```\n"
    assert with_outputs(page, ["1\n", "2\n"]) == page.replace("old\n", "1\n").replace("```text\n```", "```text\n2\n```")
