"""The page: a report as one self-contained HTML file. The same content gives the same bytes."""

from collections.abc import Callable
from importlib.resources import files

from xavi_dialogue.report.content import SCHEMA, Incident
from xavi_dialogue.report.render import avoidance, closing, observations, priority, reasons
from xavi_dialogue.report.render.markup import Markup, joined, tag
from xavi_dialogue.report.render.notes import Notes
from xavi_dialogue.report.render.observations import Page
from xavi_dialogue.report.render.summary import summary
from xavi_dialogue.report.render.words import Names, phrase, seconds

SECTIONS: tuple[tuple[str, str, Callable[[Page], Markup]], ...] = (
    ("summary", "Summary", summary),
    ("involved", "Who is involved", observations.involved),
    ("timeline", "Timeline", observations.timeline),
    ("maps", "Maps", observations.maps),
    ("motion", "Speeds and distances", observations.motions),
    ("lights", "Lights and right of way", priority.lights),
    ("beliefs", "What was believed, and how it moved", reasons.beliefs),
    ("decision", "What was decided", reasons.decisions),
    ("causes", "What it hangs on", reasons.causes),
    ("avoidance", "From when it could have been avoided, and how", avoidance.avoidance),
    ("limits", "What the record cannot show", closing.limits),
    ("hashes", "Ride, traces and program", closing.hashes),
)
POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
CAUTION = (
    "This report states what a record shows. It finds nobody at fault, and says nothing on "
    "whether anybody kept to a law or a regulation."
)


def html(report: Incident) -> str:
    """Return a report as an HTML document."""
    page = Page(report, Names(report.involved), Notes())
    parts = [
        tag("section", tag("h2", f"{k}. {title}"), make(page), id=name)
        for k, (name, title, make) in enumerate(SECTIONS, start=1)
    ]
    last = len(SECTIONS) + 1
    sources = tag(
        "section",
        tag("h2", f"{last}. Sources of the figures"),
        tag("p", "Fields are those of plan traces (docs/trace.md); [*] stands for all entries. "
            "Decision 7 is the trace with that running number, whose id is in the list above."),
        page.notes.all(),
        id="sources",
    )  # fmt: skip
    body = tag("body", _head(page), _contents(last), *parts, sources)
    style = tag("style", Markup(_style()))
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", name="generator", content=SCHEMA),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", http_equiv="Content-Security-Policy", content=POLICY),
        tag("title", _title(report)),
        style,
    )
    return f"<!doctype html>\n{tag('html', head, body, lang='en')}\n"


def _title(report: Incident) -> str:
    kind = phrase("title", report.moment.kind)
    scenario = report.subject.scenario.rstrip("/").rpartition("/")[2]
    return f"{kind} at {seconds(report.moment.time)}: {scenario}"


def _head(page: Page) -> Markup:
    report, subject = page.report, page.report.subject
    why = phrase("asked", report.moment.kind)
    return joined(
        (
            tag("h1", f"Incident report: {_title(report)}"),
            tag("p", f"Ride {subject.scenario}, seed {subject.seed}, of {subject.car!r}: "
                f"{subject.decisions} decisions from {subject.begin:g} to {subject.end:g} s. "
                f"The moment is {why}. The report covers {report.since:.1f} to "
                f"{report.until:.1f} s of simulation time.", class_="lead"),
            tag("p", CAUTION, " Small numbers lead to the source of each figure; in brackets is "
                "its interval.", class_="caution"),
        )
    )  # fmt: skip


def _contents(last: int) -> Markup:
    """Return the table of contents."""
    names = [*((name, title) for name, title, _ in SECTIONS), ("sources", "Sources of the figures")]
    assert len(names) == last
    return tag("nav", tag("ol", *(tag("li", tag("a", t, href=f"#{n}")) for n, t in names)))


def _style() -> str:
    return files("xavi_dialogue.report.render").joinpath("page.css").read_text(encoding="utf-8")
