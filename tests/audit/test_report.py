"""The files of an audit: tables, page, what changed."""

import hashlib
import json
import shutil
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import msgspec
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from tests.audit.made import answered, audit, choice, facts, mistake
from xavi_dialogue.audit.audit import Audit
from xavi_dialogue.audit.errors import AuditError
from xavi_dialogue.audit.report import LIST, PAGE, write
from xavi_dialogue.audit.results.changes import earlier
from xavi_dialogue.audit.results.tables import ANSWERS, CHANGES, FINDINGS, RIDES, read
from xavi_dialogue.audit.store import Store
from xavi_dialogue.audit.values import Peak

HOSTILE = "<script>alert(1)</script> $x_{"


def some() -> Audit:
    found = facts(choices=(choice(2.0, 0.1),), mistakes=(mistake(1.5),))
    return audit((found, answered()), (facts(), answered("I cannot say.", kind="refusal")))


def test_tables_hold_rides_answers_and_findings(tmp_path: Path) -> None:
    summary = write(some(), Store(tmp_path), 10, None)
    rides = read(tmp_path / RIDES)
    assert [row["ride"] for row in rides] == ["s1-0", "s1-1"]
    assert [(row["close_decisions"], row["mattered"], row["refusals"]) for row in rides] == [
        (1, 1, 0),
        (0, 0, 1),
    ]
    assert rides[0]["braking"] == 2.0
    assert rides[0]["collision_speed"] is None
    assert [row["text"] for row in read(tmp_path / ANSWERS)] == ["Because.", "I cannot say."]
    kinds = {row["kind"] for row in read(tmp_path / FINDINGS)}
    assert kinds == {name for name, count in summary.findings.items() if count}
    assert not (tmp_path / CHANGES).exists()


def test_the_list_has_the_hash_of_every_file(tmp_path: Path) -> None:
    write(some(), Store(tmp_path), 10, None)
    listed = json.loads((tmp_path / LIST).read_bytes())["files"]
    for name in (RIDES, ANSWERS, PAGE):
        assert listed[name] == hashlib.sha256((tmp_path / name).read_bytes()).hexdigest()


def test_the_same_audit_gives_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a", "b"):
        write(some(), Store(tmp_path / name), 10, None)
    files = [path.relative_to(tmp_path / "a") for path in (tmp_path / "a").rglob("*.*")]
    assert len(files) >= 7
    for file in files:
        assert (tmp_path / "a" / file).read_bytes() == (tmp_path / "b" / file).read_bytes(), file


def test_changed_answers_are_shown(tmp_path: Path) -> None:
    write(some(), Store(tmp_path / "old"), 10, None)
    first, second = some().rides
    other = replace(first, answers=(answered("For a reason."),))
    driven = replace(second, facts=facts(ride_hash="bb"), answers=(answered("Well."),))
    now = replace(some(), rides=(other, driven))
    summary = write(now, Store(tmp_path / "new"), 10, earlier(tmp_path / "old"))
    assert summary.findings["changed-answer"] == 2
    rows = read(tmp_path / "new" / CHANGES)
    assert [(r["ride"], r["before"], r["now"], r["ride_changed"]) for r in rows] == [
        ("s1-0", "Because.", "For a reason.", False),
        ("s1-1", "I cannot say.", "Well.", True),
    ]


def test_an_audit_without_changes_says_so(tmp_path: Path) -> None:
    write(some(), Store(tmp_path / "old"), 10, None)
    summary = write(some(), Store(tmp_path / "new"), 10, earlier(tmp_path / "old"))
    assert summary.findings["changed-answer"] == 0


def test_what_cannot_be_compared_is_said(tmp_path: Path) -> None:
    with pytest.raises(AuditError, match="is no folder"):
        earlier(tmp_path / "nothing")
    with pytest.raises(AuditError, match=r"holds no audit: answers\.parquet is missing"):
        earlier(tmp_path)
    (tmp_path / ANSWERS).write_bytes(b"no table")
    with pytest.raises(AuditError, match=r"answers\.parquet cannot be read"):
        earlier(tmp_path)
    other = msgspec.structs.replace(answered(), question="Why not?")
    write(audit((facts(), other)), Store(tmp_path / "old"), 10, None)
    with pytest.raises(AuditError, match="asked no ride"):
        write(some(), Store(tmp_path / "new"), 10, earlier(tmp_path / "old"))


def _empty(folder: Path) -> None:
    for path in folder.iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def _cut(folder: Path) -> None:
    data = (folder / ANSWERS).read_bytes()
    (folder / ANSWERS).write_bytes(data[:-20])


def _column(name: str, values: Any) -> Any:
    """Return what replaces a column of the answers."""

    def spoil(folder: Path) -> None:
        table = pq.read_table(folder / ANSWERS)
        at, column = table.schema.get_field_index(name), pa.array([values] * table.num_rows)
        pq.write_table(table.set_column(at, name, column), folder / ANSWERS)

    return spoil


def _doubled(folder: Path) -> None:
    table = pq.read_table(folder / ANSWERS)
    pq.write_table(pa.concat_tables([table, table]), folder / ANSWERS)


@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        (_empty, r"answers\.parquet is missing"),
        (_cut, r"answers\.parquet cannot be read"),
        (lambda folder: (folder / ANSWERS).write_bytes(b""), r"answers\.parquet cannot be read"),
        (lambda folder: (folder / RIDES).unlink(), r"rides\.parquet is missing"),
        (lambda folder: shutil.copy(folder / RIDES, folder / ANSWERS), "has other columns"),
        (
            lambda folder: pq.write_table(pa.table({"a": [1]}), folder / ANSWERS),
            "has other columns",
        ),
        (_column("at", "x"), "has other columns"),
        (_column("text", "\x1b[31mred"), r"answers\.parquet: .*U\+001B, which cannot be printed"),
        (_doubled, "has two rows of the same ride and question and when"),
    ],
)
def test_a_foreign_or_spoilt_folder_is_no_earlier_audit(
    spoil: Any, told: str, tmp_path: Path
) -> None:
    write(some(), Store(tmp_path), 10, None)
    spoil(tmp_path)
    with pytest.raises(AuditError, match=rf"holds no audit: .*{told}.*; give the folder of an"):
        earlier(tmp_path)


def test_an_earlier_audit_with_empty_fields_is_refused(tmp_path: Path) -> None:
    write(some(), Store(tmp_path), 10, None)
    table = pq.read_table(tmp_path / RIDES)
    nothing = pa.array([None] * table.num_rows, pa.string())
    at = table.schema.get_field_index("ride_hash")
    pq.write_table(table.set_column(at, "ride_hash", nothing), tmp_path / RIDES)
    with pytest.raises(AuditError, match="has rows that lack ride or ride_hash or program"):
        earlier(tmp_path)


class _Elements(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.ids: set[str] = set()
        self.links: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        for name, value in attrs:
            if name == "id" and value:
                self.ids.add(value)
            if name in ("href", "xlink:href", "src") and value:
                self.links.append(value)


def elements(page: Path) -> _Elements:
    found = _Elements()
    found.feed(page.read_text(encoding="utf-8"))
    return found


def test_the_page_stands_alone_and_its_links_lead_somewhere(tmp_path: Path) -> None:
    write(some(), Store(tmp_path), 10, None)
    found = elements(tmp_path / PAGE)
    assert found.tags.count("svg") == 4
    assert {"script", "link", "img", "iframe"}.isdisjoint(found.tags)
    assert [link for link in found.links if link.startswith(("http", "//"))] == []
    inner = {link[1:] for link in found.links if link.startswith("#")}
    assert {"ride-0", "ride-1", "close-call"} <= inner <= found.ids
    assert {"rides/0.gz", "rides/1.gz"} <= set(found.links)


def test_what_was_recorded_cannot_become_markup(tmp_path: Path) -> None:
    hostile = facts(scenario=HOSTILE, time_to_collision=None)
    write(audit((hostile, answered(HOSTILE))), Store(tmp_path), 10, None)
    assert "script" not in elements(tmp_path / PAGE).tags
    assert "&lt;script&gt;" in (tmp_path / PAGE).read_text(encoding="utf-8")


def test_the_page_shows_the_foremost_and_says_how_many_more(tmp_path: Path) -> None:
    write(audit(*[(facts(), answered())] * 5), Store(tmp_path), 2, None)
    text = (tmp_path / PAGE).read_text(encoding="utf-8")
    assert text.count("3 more in findings.parquet") == 2  # close calls and hard braking


def test_an_audit_of_nothing_has_a_page(tmp_path: Path) -> None:
    write(Audit("program", (), (), ()), Store(tmp_path), 10, None)
    assert "Audit of 0 rides" in (tmp_path / PAGE).read_text(encoding="utf-8")


def driven(folder: Path) -> Audit:
    """Return an audit of one ride that is stored in its folder."""
    path = Path(__file__).parents[2] / "transcripts" / "rides" / "s2-2.ride.jsonl.gz"
    (folder / "rides").mkdir(parents=True)
    shutil.copy(path, folder / "rides" / "0.gz")
    known = facts(
        scenario="s2", ride_hash=hashlib.sha256(path.read_bytes()).hexdigest(),
        braking=Peak(4.0, 3.4), time_to_collision=None,
    )  # fmt: skip
    made = audit((known, answered()))
    source = msgspec.structs.replace(made.rides[0].source, place="s2")
    return replace(made, rides=(replace(made.rides[0], source=source),))


def test_findings_lead_to_reports_beside_the_page(tmp_path: Path) -> None:
    found = driven(tmp_path)
    summary = write(found, Store(tmp_path), 10, None, reports=1)
    (link,) = [one for one in elements(tmp_path / PAGE).links if one.startswith("reports/")]
    page = (tmp_path / link).read_text(encoding="utf-8")
    assert "Incident report: Hardest braking at 3.4 s: s2" in page
    assert "planned again" in page
    assert summary.files[link] == hashlib.sha256(page.encode()).hexdigest()
    written = (tmp_path / link).stat().st_mtime_ns
    assert write(found, Store(tmp_path), 10, None, reports=1) == summary
    assert (tmp_path / link).stat().st_mtime_ns == written
    (tmp_path / link).write_text("<html>cut off", encoding="utf-8")
    assert write(found, Store(tmp_path), 10, None, reports=1) == summary
    assert (tmp_path / link).read_text(encoding="utf-8") == page


def test_without_a_report_the_page_has_its_command(tmp_path: Path) -> None:
    write(driven(tmp_path), Store(tmp_path), 10, None)
    text = (tmp_path / PAGE).read_text(encoding="utf-8")
    assert "<code>xavi report rides/0.gz --at &#39;hardest braking&#39;</code>" in text
    assert not (tmp_path / "reports").exists()


def test_a_report_that_cannot_be_made_leaves_the_command(tmp_path: Path) -> None:
    write(some(), Store(tmp_path), 10, None, reports=3)  # its rides are not there
    text = (tmp_path / PAGE).read_text(encoding="utf-8")
    assert "xavi report rides/0.gz --at 5.5" in text
    assert "reports/" not in text
