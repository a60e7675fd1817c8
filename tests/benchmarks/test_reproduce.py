"""The paper's tables: rows, what counts as the same, and what we print beside them."""

import re
from pathlib import Path

import pytest
from msgspec.structs import replace

from benchmarks.drive.runs import in_processes
from benchmarks.fidelity.resimulate import Happened
from benchmarks.reproduce import rides, weighing
from benchmarks.reproduce.claims import Change, Claim, Doing, claim_of, differing
from benchmarks.reproduce.report import Reproduction, reproduction
from benchmarks.reproduce.rides import Told, Wording, broken, tell
from benchmarks.reproduce.rows import FOILS, ROWS, STRAIGHT_ON, Foil, Row, rows_of
from benchmarks.reproduce.tables import FoilFound, compare
from benchmarks.reproduce.weighing import Bearing, Weighed, weigh
from planner.counterfactuals.whatif import WhatIfError
from planner.record.trace import UNITS, Action, Component, Outcome, PlanTrace, WhatIf
from sim.roads.network import Network
from sim.setup.scenario import load
from tests.traces import s1_world, trace_of
from xavi_dialogue.domain.answers import (
    Cause,
    ChoiceReason,
    Contrast,
    Effect,
    Evidence,
    OutcomeEstimate,
)
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.say import say
from xavi_dialogue.vehicle.episode import network_of

FACT: tuple[Action, ...] = ("change-left", "continue")


def effect(component: Component, delta: float) -> Effect:
    return Effect(component, UNITS[component], delta, delta - 0.4, delta + 0.4, 60, 20)


def cause(vehicle: int, actions: tuple[Action, ...], probability: float) -> Cause:
    return Cause(vehicle, actions, probability)


def contrast(
    foil: tuple[Action, ...],
    outcome: Outcome = "done",
    probability: float = 1.0,
    effects: tuple[Effect, ...] = (),
    causes: tuple[Cause, ...] = (),
    *,
    hit: int | None = None,
) -> Contrast:
    ends = OutcomeEstimate(outcome, probability, hit)
    evidence = Evidence("tree", 120, 32, ("0123456789abcdef",))
    return Contrast(FACT, foil, ends, effects, causes, evidence, 3.0)


LATER = effect("time", 4.7)
JERK = effect("jerk", 0.3)
STEADY = effect("angular-acceleration", -0.04)
CUTS_IN = cause(1, ("change-right", "exit-right"), 0.9)
IN_LANE = cause(1, ("exit-right",), 0.9)
TURNS = cause(2, ("exit-right",), 0.5)
ENDS: dict[str, Outcome] = {"done": "done", "collision": "collision", "not-reached": "dead"}
DELTAS: dict[str, float] = {"time": 4.0, "jerk": 0.4, "angular-acceleration": 0.1}


def said(found: Contrast, effects: int = 1, causes: int = 1) -> Wording:
    context = SpeechContext(style="paper", max_effects=effects, max_causes=causes)
    text = say(ChoiceReason("why", None, found), context).text
    return Wording(effects, causes, text, claim_of(found, effects, causes))


def told(
    seed: int,
    causes: tuple[Cause, ...],
    foil: Foil = STRAIGHT_ON,
    weighed: Weighed | None = None,
    happened: Outcome | None = None,
) -> Told:
    found = contrast((foil.action,), "done", 1.0, (STEADY, LATER, JERK), causes)
    sizes = dict.fromkeys((row.effects, row.causes) for row in rows_of(foil))
    wordings = tuple(said(found, *size) for size in sizes)
    came = None if happened is None else Happened(happened)
    return Told(foil, seed, wordings[0].text, None, 3.0, wordings, weighed, came)


def table_1(asked: list[Told]) -> FoilFound:
    return compare(asked)[0]


def of_claim(row: Row) -> Contrast:
    """A contrast that claims what a row does."""
    sign = {"more": 1.0, "less": -1.0, "equal": 0.0}
    effects = []
    for change in row.claim.effects:
        component: Component = change.component  # type: ignore[assignment]
        effects.append(effect(component, sign[change.lean] * DELTAS[component]))
    causes = []
    for doing in row.claim.causes:
        actions: tuple[Action, ...] = doing.actions  # type: ignore[assignment]
        causes.append(cause(doing.vehicle, actions, 0.5))
    name, hit = ENDS[row.claim.outcome], row.claim.collided_with
    return contrast((row.foil.action,), name, 1.0, tuple(effects), tuple(causes), hit=hit)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.table}:{row.text[-60:]}")
def test_a_row_claims_what_its_sentence_says(row: Row) -> None:
    """Our car says the row, but for adverbs, when it is given the row's claim."""
    wording = said(of_claim(row), row.effects, row.causes)
    assert wording.claim == row.claim

    def bare(text: str) -> str:
        text = re.sub(r" (?:likely|probably)\b", "", text)
        return text.replace("changes right and exits", "changes right then exits")

    assert bare(wording.text) == bare(row.text)


def test_claims_differ_by_content_and_not_by_adverbs() -> None:
    likely = contrast(("continue",), "done", 0.8, (LATER,), (CUTS_IN,))
    surely = contrast(("continue",), "done", 1.0, (LATER,), (cause(1, CUTS_IN.actions, 0.4),))
    assert said(likely).text != said(surely).text
    assert differing(said(likely).claim, said(surely).claim) == ()


@pytest.mark.parametrize(
    ("other", "parts"),
    [
        (Claim("collision", 1, (), (Doing(1, ("exit-right",)),)), ("outcome", "effects")),
        (Claim("done", effects=(Change("time", "less"),)), ("effects", "causes")),
        (
            Claim(
                "done",
                effects=(Change("time", "more"),),
                causes=(Doing(1, ("change-right", "exit-right")),),
            ),
            ("first action",),
        ),
        (
            Claim("done", effects=(Change("time", "more"),), causes=(Doing(2, ("exit-right",)),)),
            ("causes",),
        ),
    ],
)
def test_what_tells_claims_apart(other: Claim, parts: tuple[str, ...]) -> None:
    ours = said(contrast(("continue",), "done", 1.0, (LATER,), (IN_LANE,))).claim
    assert differing(ours, other) == parts


def test_sentences_are_counted_under_the_row_that_claims_the_same() -> None:
    asked = [told(0, (CUTS_IN,)), told(1, (IN_LANE,)), told(2, (CUTS_IN,)), told(3, (TURNS,))]
    found = table_1(asked)
    (size,) = found.sizes
    slower, collided = size.rows
    assert (slower.borne_out, slower.verbatim) == (2, 0)
    assert [one.seeds for one in slower.ours] == [(0, 2)]
    assert (collided.borne_out, collided.ours) == (0, ())
    assert [(one.seeds, one.differs) for one in size.others] == [
        ((1,), ("first action",)),
        ((3,), ("causes",)),
    ]
    assert (found.answered, found.declined, found.seeds) == (4, 0, 4)


def test_a_row_is_had_word_for_word_where_the_adverbs_agree() -> None:
    found = contrast(("continue",), "done", 0.9, (LATER,), (cause(1, CUTS_IN.actions, 0.5),))
    one = Told(STRAIGHT_ON, 0, wordings=(said(found),))
    (size,) = table_1([one]).sizes
    assert (size.rows[0].borne_out, size.rows[0].verbatim) == (1, 1)
    assert size.rows[0].ours[0].text == ROWS[0].text


def test_table_3_grows_by_effects_and_by_causes() -> None:
    found = compare([told(0, (CUTS_IN, TURNS)), told(1, (CUTS_IN,))])[-1]
    assert [(s.effects, s.causes) for s in found.sizes] == [(1, 1), (1, 2), (2, 1), (3, 1)]
    assert [size.rows[0].borne_out for size in found.sizes] == [2, 1, 2, 2]
    assert [one.seeds for one in found.sizes[1].others] == [(1,)]


def test_refusals_and_broken_rides_are_no_answers() -> None:
    refused = Told(STRAIGHT_ON, 4, "I cannot say.", "too-little-evidence")
    asked = [told(0, (CUTS_IN,)), refused, *broken(("s1", 5), "SimulationError: gone")]
    found = table_1(asked)
    assert (found.seeds, found.answered, found.declined) == (3, 1, 1)
    assert found.refusals[0].text == "too-little-evidence: I cannot say."
    assert found.errors == ("seed 5: SimulationError: gone",)
    shown = reproduction(asked, 3)
    assert (shown.answered, shown.declined, shown.asked) == (1, 1, 4)
    assert "broke off: seed 5: SimulationError: gone" in shown.table()


def test_a_row_that_is_not_supported_comes_with_its_figures() -> None:
    bearing = Bearing(1, 0.9, 0.2, True, 6.0, 1.0, 1.0, 20.0, 15.0, True)
    weighed = [
        Weighed(
            {"done": 0.8, "collision": p, "termination": 0.0, "dead": 0.2 - p},
            q,
            4,
            0.4,
            4.0,
            -3.0,
            (bearing,),
        )
        for p, q in ((0.1, 0.15), (0.0, 0.0))
    ]
    outcomes: tuple[Outcome, ...] = ("done", "collision")
    asked = [
        told(seed, (IN_LANE,), weighed=one, happened=outcome)
        for seed, (one, outcome) in enumerate(zip(weighed, outcomes, strict=True))
    ]
    text = reproduction(asked, 2).table()
    assert (
        "p(collision | do(continue)) at most 0.100 at the decision,"
        " 0.150 in the 8 decisions up to it; driven on in SUMO: collision 1, done 1"
    ) in text
    assert (
        "vehicle 1 does so with p 0.90; influence beyond chance in 2 of 2;"
        " holds the ego up for 6.0 s; takes 20.0 s if it does so, 15.0 s else;"
        " without it the decision changes in 2 of 2"
    ) in text
    assert "rollouts, mean of 2 seeds: done 0.800, collision 0.050, dead 0.150" in text


def test_what_breaks_off_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    def load(name: str, seed: int) -> None:
        raise OSError(f"{name} is gone")

    monkeypatch.setattr(rides, "load", load)
    found = tell(("s2", 3))
    assert [(one.foil.action, one.seed, one.error) for one in found] == [
        ("exit-straight", 3, "OSError: s2 is gone"),
        ("exit-left", 3, "OSError: s2 is gone"),
    ]


class Without:
    """Planning again without a vehicle: the ego then stays in its lane, or it cannot be had."""

    def __init__(self, plan: Action | None) -> None:
        self.plan = plan

    def __call__(self, trace: PlanTrace, network: object, change: WhatIf) -> PlanTrace:
        assert change.removed is not None
        if self.plan is None:
            raise WhatIfError("the goal is out of reach")
        return replace(trace, plan=(replace(trace.plan[0], action=self.plan),))


@pytest.mark.parametrize(
    ("plan", "decides"), [("continue", True), ("change-left", False), (None, None)]
)
def test_the_evidence_on_a_foil(
    monkeypatch: pytest.MonkeyPatch, plan: Action | None, decides: bool | None
) -> None:
    """A world in which the foil collides just where vehicle 1, in our lane already, turns."""
    monkeypatch.setattr(weighing, "replan", Without(plan))
    trace = trace_of(s1_world(cut_in_collides=True))
    found = weigh(trace, (), FACT, "continue", rows_of(STRAIGHT_ON), network())
    assert found is not None
    assert found.outcomes["collision"] == pytest.approx(0.8, abs=0.02)
    assert (found.collision, found.decisions) == (found.outcomes["collision"], 1)
    first, second = found.bearings
    assert (first.vehicle, second.vehicle) == (1, 2)
    assert (first.does, second.does) == (pytest.approx(0.8), pytest.approx(0.6))
    assert (first.done_if, first.done_else) == (0.0, 1.0)
    assert (first.time_if, first.time_else) == (None, pytest.approx(11.5))
    assert first.bits > second.bits
    assert first.decides is decides
    # Late where it arrives at all: 11.5 s against 12 s; Equation 8 as printed turns that over.
    assert (found.later, found.printed) == (pytest.approx(-0.5), pytest.approx(0.5))


def test_the_worst_of_all_decisions_up_to_then_counts() -> None:
    worse, now = trace_of(s1_world(cut_in_collides=True)), trace_of(s1_world())
    found = weigh(now, (worse,), FACT, "continue", (), network())
    assert found is not None
    assert found.outcomes["collision"] == 0.0
    assert (found.collision, found.decisions) == (pytest.approx(0.8, abs=0.02), 2)
    assert weigh(now, (), FACT, "change-right", (), network()) is None


def network() -> Network:
    return network_of(load("s1"))


@pytest.fixture(scope="module")
def seed_0() -> Reproduction:
    """Both stories with one seed, in a process of its own as SUMO needs it."""
    rides = in_processes(tell, [("s1", 0), ("s2", 0)], 1, lambda task: broken(task, "died"))
    return reproduction([one for ride in rides for one in ride], 1)


def test_every_foil_gets_a_sentence_and_is_driven_in_sumo(seed_0: Reproduction) -> None:
    assert (seed_0.answered, seed_0.declined, seed_0.asked) == (4, 0, 4)
    assert {found.foil for found in seed_0.foils} == {foil.action for foil in FOILS}
    for found in seed_0.foils:
        assert found.errors == ()
        assert found.grounds is not None
        assert sum(found.grounds.driven.values()) == 1
        assert "not driven" not in found.grounds.driven
        assert sum(found.grounds.outcomes.values()) == pytest.approx(1.0)


@pytest.fixture(scope="module")
def page() -> str:
    return (Path(__file__).parents[2] / "docs" / "paper.md").read_text(encoding="utf-8")


def test_the_document_says_what_is_said(seed_0: Reproduction, page: str) -> None:
    """`xavi reproduce` prints what docs/paper.md shows; checked for one seed of its ten."""
    said = re.findall(r"\(seeds ([\d ]+)\) (If ego had .*?\.)", page)
    shown = {text for seeds, text in said if "0" in seeds.split()}
    ours = {
        sentence.text
        for found in seed_0.foils
        for size in found.sizes
        for sentence in (*size.others, *(s for row in size.rows for s in row.ours))
    }
    assert ours == shown


def test_the_summary_in_the_document_is_that_of_its_tables(page: str) -> None:
    printed = re.findall(
        r"^  paper: (.*)\n    (?:borne out in (\d+ of \d+)|not supported)", page, re.M
    )
    assert [text for text, _ in printed] == [row.text for row in ROWS]
    summary = re.findall(r"^\| \d \| .* \| (no|\d+ of \d+) \|$", page, re.M)
    assert summary == [count or "no" for _, count in printed]
    complete = re.search(r"(\d+) counterfactuals: (\d+) complete sentences", page)
    assert complete is not None
    assert complete[1] == complete[2] == "40"
