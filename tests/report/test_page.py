"""The page: one file, escaped, with a source for every figure."""

import re
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest
from msgspec.structs import replace

from tests.report.records import BRAKING, LIGHT, TOWN, UNHEEDED, incident, report, traces
from xavi_dialogue.report.content import Incident, Jump
from xavi_dialogue.report.figures import Figure, Source
from xavi_dialogue.report.render.jumps import told_jump
from xavi_dialogue.report.render.markup import Markup, joined, tag
from xavi_dialogue.report.render.notes import TIE, Notes, percent, told
from xavi_dialogue.report.render.observations import Page
from xavi_dialogue.report.render.page import CAUTION, html
from xavi_dialogue.report.render.words import Names, decisions_words, seconds

EVIL = "<script>alert('x')</script>"
CASES = [(UNHEEDED, None), (BRAKING, "hardest braking"), (LIGHT, "red light")]
every_case = pytest.mark.parametrize(("path", "at"), CASES, ids=lambda x: getattr(x, "stem", x))


class Reader(HTMLParser):
    """Checks that elements are closed in order, and collects what they refer to."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.names: set[str] = set()
        self.text = ""

    def handle_starttag(self, name: str, attributes: list[tuple[str, str | None]]) -> None:
        self.names.add(name)
        known = dict(attributes)
        self.ids += [known["id"] or ""] if "id" in known else []
        self.links += [known["href"] or ""] if "href" in known else []
        if name != "meta":
            self.open.append(name)

    def handle_endtag(self, name: str) -> None:
        assert self.open.pop() == name

    def handle_data(self, data: str) -> None:
        self.text += data.replace(TIE, " ")


def read(text: str) -> Reader:
    reader = Reader()
    reader.feed(text)
    assert reader.open == []
    return reader


@every_case
def test_it_is_whole_and_needs_no_other_file(path, at) -> None:
    page = report(path, at).html()
    reader = read(page)
    assert not reader.names & {"script", "link", "img", "iframe", "object", "form"}
    outside = re.findall(r"https?://[^\s\"<]+", page)
    assert set(outside) <= {"http://www.w3.org/2000/svg"}
    assert "url(" not in page
    assert all(link.startswith("#") for link in reader.links)
    assert len(reader.ids) == len(set(reader.ids))
    assert {link[1:] for link in reader.links} <= set(reader.ids)


@every_case
def test_every_note_is_listed_and_used(path, at) -> None:
    page = report(path, at).html()
    listed = re.findall(r'id="source-(\d+)"', page)
    used = re.findall(r'href="#source-(\d+)"', page)
    assert listed == [str(k + 1) for k in range(len(listed))]
    assert set(used) == set(listed)
    assert len(listed) > 30


@every_case
def test_drawings_are_well_formed(path, at) -> None:
    drawings = re.findall(r"<svg.*?</svg>", report(path, at).html(), re.DOTALL)
    assert len(drawings) >= 6
    for one in drawings:
        root = ElementTree.fromstring(one)
        for element in root.iter():
            assert "nan" not in "".join(element.attrib.values())


@every_case
def test_nobody_is_found_at_fault(path, at) -> None:
    text = read(report(path, at).html()).text
    assert CAUTION in text
    rest = text.replace(CAUTION, "").lower()
    for word in ("fault", "guilt", "blame", "liable", "negligen", "violat", "complian", "unlawful"):
        assert word not in rest


def test_whatever_was_recorded_is_escaped() -> None:
    found = incident(UNHEEDED)
    decided = tuple(replace(one, ruled_out={"stop": EVIL}) for one in found.decided)
    beliefs = tuple(
        replace(known, goals=tuple(replace(goal, place=EVIL) for goal in known.goals))
        for known in found.beliefs
    )
    forged = replace(
        found,
        subject=replace(found.subject, scenario=EVIL, car=EVIL),
        involved=tuple(replace(one, colour=EVIL, kind=EVIL) for one in found.involved),
        decided=decided,
        beliefs=beliefs,
        hashes=replace(found.hashes, network=EVIL),
    )
    page = html(forged)
    assert "<script" not in page
    assert page.count("&lt;script&gt;") >= 8
    read(page)


def test_what_the_summary_says_stands_in_the_content() -> None:
    text = read(report(UNHEEDED).html()).text
    assert "This car and vehicle 1 (blue truck) touched at 11.1 s" in text
    assert "this car goes before the other (decision 11)" in text
    assert "decision 9, 2.1 s before: to stop" in text.replace("\n", " ")
    assert (
        "Decision 9 (\N{MINUS SIGN}2.1 s) expected vehicle 1 (blue truck) to drive 11.5 km/h"
        in text
    )
    light = read(report(LIGHT, "red light").html()).text
    assert "turned green again at 26.0 s" in light
    town = read(report(TOWN, "hardest braking").html()).text
    assert "a collision with vehicle 5 (blue bus) in 100 %" in town
    assert "Decisions 16 to 21 did not foresee it" in town
    assert "Decision 22 (\N{MINUS SIGN}1.0 s) is planned otherwise by this program with" in town
    assert town.count("this program plans it otherwise than recorded: another version") == 2
    assert "faster: pedestrian 9, which goes first, and a traffic light." in light
    assert "The light ahead, in " in light
    assert "The light ahead showed red from " in light


def test_columns_say_what_their_probabilities_are_of() -> None:
    crash = read(report(UNHEEDED).html()).text
    assert "Probability of a collision with anybody, as believed then" in crash
    assert "a collision has two figures. The share of the rollouts is what the reward" in crash
    braking = read(report(BRAKING, "hardest braking").html()).text
    assert re.search(r"Probability of braking at \d\.?\d* m/s² or more by \d+\.\d s, as", braking)
    light = read(report(LIGHT, "red light").html()).text
    assert "Probability that a light holds the car up, as believed then" in light
    assert "Decision 8: changed what to do next" in crash
    bare = re.sub(r"(?<=%)\d+", "", crash)  # without the numbers of notes
    assert "arrives 92.9 %, collides 7.1 % (vehicle 1 7.1 %)" in bare
    assert "Decision 10: the last from which it was avoidable, but off the route" in crash


def standard_error_of_the_lead() -> float:
    """Return it of turning right over going straight on in decision 10, by the rollouts."""
    rows = [one for one in traces(UNHEEDED)[10].rollouts if one.weight is not None]
    ours, theirs = (
        [one for one in rows if one.actions[0].action == a] for a in ("continue", "exit-right")
    )
    leads = [b.reward - a.reward for a, b in zip(ours, theirs, strict=True)]
    weights = [one.weight or 0.0 for one in ours]
    mean = sum(w * lead for w, lead in zip(weights, leads, strict=True))
    squares = ((w * (lead - mean)) ** 2 for w, lead in zip(weights, leads, strict=True))
    return float(sum(squares) ** 0.5)


def test_a_choice_that_was_not_the_best_is_explained() -> None:
    crash = read(report(UNHEEDED).html()).text
    told_of = "To turn right came out better, but by no more than the standard error of that"
    assert crash.count(told_of) == 1
    (kept,) = (one.kept for one in incident(UNHEEDED).decided if one.number == 10)
    assert kept is not None
    assert kept.value == pytest.approx(standard_error_of_the_lead(), abs=1e-3)
    assert "came out better" not in read(report(LIGHT, "red light").html()).text


@every_case
def test_options_with_more_rollouts_are_explained(path, at) -> None:
    known = incident(path, at).avoidability
    assert known is not None
    again = any(way.planned for chance in known.chances for way in chance.ways)
    text = read(report(path, at).html()).text
    assert ("(more rollouts)" in text) == ("figures are those of all of them" in text) == again


def test_people_who_may_cross_are_told_where_nobody_on_a_lane_does() -> None:
    light = report(LIGHT, "red light").html()
    rows = re.findall(r"<tr>(.*?)</tr>", light, re.DOTALL)
    cells = [re.findall(r"<td[^>]*>(.*?)</td>", row, re.DOTALL) for row in rows]
    told_of = [row for row in cells if len(row) == 5 and "nobody on a lane" in row[3]]
    assert told_of
    assert any("pedestrian 8" in row[4] and "%" in row[4] for row in told_of)


def test_a_report_of_another_moment_differs() -> None:
    assert isinstance(incident(UNHEEDED), Incident)
    other = report(UNHEEDED, "8.5").html()
    assert "Moment at 8.5 s" in other
    assert "vehicle 1" in other


def test_plain_text_is_escaped_and_markup_is_not() -> None:
    assert joined(("a < b", Markup("<b>"), None)) == "a &lt; b<b>"
    assert tag("p", 'say "x"', title='"') == '<p title="&quot;">say &quot;x&quot;</p>'


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0 %"), (0.0004, "<0.1 %"), (0.0123, "1.2 %"), (0.5, "50 %"), (0.987, "98.7 %"),
     (0.99999, ">99.9 %"), (1.0, "100 %")],
)  # fmt: skip
def test_probabilities_are_told_apart_from_certainty(value: float, text: str) -> None:
    assert percent(value) == text.replace(" ", TIE)


def test_figures_are_told_with_unit_and_interval() -> None:
    source = Source("ride", "x")
    assert told(Figure(10.0, "m/s", source)) == f"36.0{TIE}km/h"
    assert told(Figure(-2.0, "s", source, -3.0, 1.0, "range")) == (
        f"\N{MINUS SIGN}2.0{TIE}s (\N{MINUS SIGN}3.0 to 1.0)"
    )
    notes = Notes()
    first, same, other = (notes.ref(Source("ride", f)) for f in ("x", "x", "y"))
    assert first == same != other


def test_numbers_of_decisions_and_times_are_told_shortly() -> None:
    assert decisions_words((3, 4, 5, 8)) == "decisions 3 to 5 and 8"
    assert decisions_words((3,)) == "decision 3"
    assert [seconds(t) for t in (21.65, 11.1, 3.0)] == ["21.65 s", "11.1 s", "3.0 s"]


def test_what_moved_far_is_told_with_what_changed() -> None:
    crash = re.sub(r"(?<=[%h])\d+", "", read(report(UNHEEDED).html()).text)
    assert "the share of the rollouts of the plan that collide went from 0 % to 85 %" in crash
    assert "vehicle 1 (blue truck) drove 26.5 km/h where 22.3 km/h had been expected" in crash
    town = read(report(TOWN, "hardest braking").html()).text
    assert "vehicle 5 (blue bus) came from a junction to road C3_D3" in town


def test_a_jump_without_anything_seen_says_that_the_record_does_not_show_why() -> None:
    content = report(TOWN, "hardest braking").content
    page = Page(content, Names(content.involved), Notes())
    text = told_jump(page, Jump(5, 22, 23, None, None, "exit-right", "the road to the right"))
    assert "turns right (the road to the right) went from “not among its goals” to" in text
    assert text.endswith("so it does not show why.")


def test_colours_are_said_to_be_those_of_the_drawings() -> None:
    page = report(UNHEEDED).html()
    assert "they are not those of the vehicles" in page
    assert page.count('class="key"') == 3  # this car, the other and anybody else


def test_braking_alone_is_told_apart_from_the_options() -> None:
    text = read(report(UNHEEDED).html()).text
    assert text.count("Apart from the options: braking at 7 m/s² on its own line") == 2
    assert "Options begin at decisions, which come 1 s apart" in text
    assert "what was expected of the option, not what was driven" in text
