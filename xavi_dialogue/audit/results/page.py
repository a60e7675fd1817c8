"""The page of an audit: one HTML file that needs no other."""

from collections.abc import Sequence
from importlib.resources import files
from shlex import quote
from typing import Any, Final

import msgspec

from xavi_dialogue.audit.audit import Audit, Looked
from xavi_dialogue.audit.errors import needing
from xavi_dialogue.audit.results.findings import KINDS, Finding
from xavi_dialogue.audit.results.plots import anchor
from xavi_dialogue.audit.results.reports import Written, command
from xavi_dialogue.audit.results.tables import ride_row

with needing("audit", "pip install jinja2"):
    from jinja2 import Environment, StrictUndefined

TEMPLATE: Final = "page.html.jinja"
TITLES: Final = {
    "collision": "Collisions",
    "close-call": "Closest calls",
    "hard-braking": "Hardest braking",
    "wrong-prediction": "Wrong predictions that mattered",
    "close-decision": "Close decisions",
    "refusal": "Questions declined or asked back",
    "changed-answer": "Changed answers",
}
ONE: Final = {  # the same of a single finding
    "collision": "Collision",
    "close-call": "Closest call",
    "hard-braking": "Hardest braking",
    "wrong-prediction": "Wrong prediction that mattered",
    "close-decision": "Close decision",
    "refusal": "Question declined or asked back",
    "changed-answer": "Changed answer",
}
NOTES: Final = {
    "collision": "The car touched somebody.",
    "close-call": "The shortest time to a collision of each ride without one, up to 10 s, had both "
    "kept their speeds: along the way if one follows the other, else straight on, unless one of "
    "them is turning.",
    "hard-braking": "The hardest braking of each ride.",
    "wrong-prediction": "Where another goal was held more likely than the one a vehicle went to; "
    "planned again with the truth, the decision is another one.",
    "close-decision": "The next best option was as good within the error of the comparison.",
    "refusal": "By question and reason; the text is from the first ride.",
    "changed-answer": "What the earlier audit answered otherwise.",
}


def page(
    audit: Audit,
    findings: Sequence[Finding],
    pictures: Sequence[tuple[str, str]],
    top: int,
    against: str | None,
    reported: Written,
) -> bytes:
    """Return the page.

    Args:
        audit: the rides.
        findings: what was found in them.
        pictures: SVG and captions.
        top: number of findings of each kind that are shown.
        against: the program of the earlier audit, if there is one.
        reported: the files of reports that there are.
    """
    environment = Environment(
        autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined
    )
    source = files(__package__).joinpath(TEMPLATE).read_text(encoding="utf-8")
    places = {one.source.ride: k for k, one in enumerate(audit.rides)}
    text = environment.from_string(source).render(
        audit=audit,
        against=against,
        counts=_counts(audit),
        sections=[_section(audit, places, kind, findings, top, reported) for kind in KINDS
                  if kind != "changed-answer" or against is not None],
        pictures=pictures,
        rides=[_ride(audit, k, one) for k, one in enumerate(audit.rides)],
    )  # fmt: skip
    return text.encode()


def _counts(audit: Audit) -> dict[str, int]:
    answers = [answer for one in audit.rides for answer in one.answers]
    return {
        "rides": len(audit.rides),
        "scenarios": len({one.facts.scenario for one in audit.rides}),
        "decisions": sum(one.facts.decisions for one in audit.rides),
        "asked": sum(answer.at is not None for answer in answers),
        "answered": sum(answer.kind == "answer" for answer in answers),
        "arrived": sum(one.facts.ending == "arrived" for one in audit.rides),
    }


def _section(
    audit: Audit,
    places: dict[str, int],
    kind: str,
    findings: Sequence[Finding],
    top: int,
    reported: Written,
) -> dict[str, Any]:
    several = [one for one in findings if one.kind == kind]
    rows = [
        {
            **msgspec.structs.asdict(one),
            "anchor": anchor(places[one.ride]),
            "file": audit.rides[places[one.ride]].file,
            "report": reported.get((one.kind, one.rank)),
            "command": command(audit.rides[places[one.ride]], one),
            "again": _again(audit, audit.rides[places[one.ride]], one),
        }
        for one in several[:top]
    ]
    return {
        "kind": kind, "title": TITLES[kind], "note": NOTES[kind], "rows": rows,
        "more": len(several) - len(rows), "count": len(several),
    }  # fmt: skip


def _again(audit: Audit, ride: Looked, finding: Finding) -> str:
    """Return the command that asks about a finding again."""
    question = finding.question or _QUESTIONS[finding.kind]
    if finding.kind == "close-call" and finding.vehicle is not None:
        question = f"How close did we get to vehicle {finding.vehicle}?"
    at = "" if finding.at is None else f" --at {_asked(ride, finding):g}"
    return f"xavi explain {quote(ride.file)} {quote(question)}{at}"


def _asked(ride: Looked, finding: Finding) -> float:
    """Return the time [s] at which to ask: a second later, but decisions at once."""
    assert finding.at is not None
    exact = finding.question is not None or finding.trace_id is not None
    return finding.at if exact else min(finding.at + 1.0, ride.facts.end)


_QUESTIONS: Final = {
    "collision": "Why did we crash?",
    "close-call": "Was that dangerous?",
    "hard-braking": "Why did you brake?",
    "wrong-prediction": "Why did you decide that?",
    "close-decision": "How close was that decision?",
}


def _ride(audit: Audit, index: int, one: Looked) -> dict[str, Any]:
    row = ride_row(audit.program, one)
    names = ("braking", "distance", "time_to_collision")
    return {**dict.fromkeys(names), **row, "anchor": anchor(index), "answers": one.answers}
