"""Every question form works with every predicate that docs/forms.md says it works with."""

from pathlib import Path

from tests.nlu import forms

PAGE = (Path(__file__).parents[2] / "docs" / "forms.md").read_text(encoding="utf-8")
CELLS = {cell.text: cell for cell in forms.cells()}


def test_what_is_covered_stays_covered() -> None:
    lost = [
        (CELLS[text].form, CELLS[text].predicate.name, text)
        for text in sorted(forms.covered(PAGE))
        if text in CELLS and not forms.holds(CELLS[text])
    ]
    assert lost == [], "no longer understood; or run: python -m tests.nlu.forms docs/forms.md"


def test_the_page_has_a_row_for_every_text() -> None:
    listed = {text for _, text, _ in forms.ROW.findall(PAGE)}
    assert listed == set(CELLS), "run: python -m tests.nlu.forms docs/forms.md"


def test_the_table_is_broad_and_mostly_covered() -> None:
    assert len({cell.predicate.name for cell in CELLS.values()}) > 80
    assert len(CELLS) > 2000
    assert len(forms.covered(PAGE)) > 0.85 * len(CELLS)


def test_no_text_stands_for_two_cells() -> None:
    assert len(CELLS) == len(list(forms.cells()))
