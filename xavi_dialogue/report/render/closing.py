"""Sections on what the record cannot show, and on where the report comes from."""

from planner.search.trees import trees_of
from xavi_dialogue.report.content import Limitation
from xavi_dialogue.report.render.markup import Markup, joined, listed, table, tag
from xavi_dialogue.report.render.notes import percent
from xavi_dialogue.report.render.observations import Page
from xavi_dialogue.report.render.words import capital, decisions_words, phrase


def limits(page: Page) -> Markup:
    """Return what the record cannot show."""
    return listed(_limit(page, one) for one in page.report.limits)


def _limit(page: Page, one: Limitation) -> Markup:
    who = " and ".join(page.names.of(vehicle) for vehicle in one.vehicles)
    fields = {
        "who": capital(who),
        "decisions": decisions_words(one.decisions) if one.decisions else "",
        "detail": one.detail,
        "time": "" if one.time is None else f"{one.time:.1f} s",
        "figure": "" if one.figure is None else percent(one.figure.value),
    }
    text = phrase("limit", one.kind)
    if one.kind == "no-scenes" and one.time is not None:
        text += " " + phrase("limit", "no-scenes-late")
    note = None if one.figure is None else page.notes.ref(one.figure.source)
    return joined((capital(text.format(**fields)), note))


def hashes(page: Page) -> Markup:
    """Return the identity of ride, traces and program."""
    known, subject = page.report.hashes, page.report.subject
    rows = [
        ("Ride, its decisions and events", tag("code", known.ride)),
        ("File", tag("code", known.file) if known.file else "driven, not read from a file"),
        ("Roads", tag("code", known.network)),
        (f"Program, version {known.version}", tag("code", known.program)),
    ]
    traces = (
        (f"D{one.number}", f"{one.time:.1f} s", tag("code", one.trace)) for one in known.traces
    )
    settings = subject.settings
    grown = "" if trees_of(settings) == 1 else f" in {trees_of(settings)} search trees"
    told = (
        f"The planner's settings: {settings.rollouts} rollouts{grown}, "
        f"{settings.depth} actions deep, {settings.horizon:g} s ahead, "
        f"a decision every {settings.period:g} s, view of {settings.view_radius:g} m."
    )
    return joined(
        (
            tag("p", "SHA-256 in hexadecimal. The hash of the file is what sha256sum prints; a "
                "trace has the first 16 digits. The same ride, moment and program give the same "
                "report, byte for byte."),
            table(("Of", "SHA-256"), rows, "hashes"),
            tag("p", told),
            table(("Decision", "Time", "Trace"), traces, "hashes long"),
        )
    )  # fmt: skip
