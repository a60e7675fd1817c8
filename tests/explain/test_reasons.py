"""Every reason not to answer: reached by asking in words, and told with the facts behind it."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache
from typing import get_args

import msgspec
import pytest

from planner.events import Event
from planner.trace import NotApplicable, PlanTrace, WhatIf
from tests.conftest import ROOT
from tests.fakes import again, inputs_of
from tests.traces import Aim, Ride, World, s1_ride, s1_world, s2_ride, trace_of
from xavi_dialogue.app.golden import recording
from xavi_dialogue.causal.influence import MIN_BITS
from xavi_dialogue.dialogue.events import (
    Answered,
    Asked,
    EventRecorded,
    Output,
    RideEnded,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    TraceRecorded,
    TurnedAway,
)
from xavi_dialogue.dialogue.manager import advance, fold
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state import Dialogue
from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.explanation import (
    Explanation,
    Facts,
    NeedRollout,
    NoExplanation,
    Reason,
)
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.ride import MIN_COVERAGE, MIN_DISTINCT, ROUNDS
from xavi_dialogue.language.parse import NotUnderstood, Parser

S1, S2 = s1_ride(), s2_ride()
PARSER = Parser()
Again = Callable[[NeedRollout], PlanTrace | Reason]


def parse(text: str, vehicles: frozenset[int], previous: Query | None) -> Query | NotUnderstood:
    return PARSER.follow(text, previous, vehicles)


@dataclass
class Talk:
    """A conversation with the real parser and explainer, which notes what was explained."""

    dialogue: Dialogue
    again: Again = lambda need: "planner-unavailable"
    wanted: list[NeedRollout] = field(default_factory=list)
    queries: dict[Query, NoExplanation] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.mind = Mind(parse, self._explain)

    def _explain(self, query: Query, record: Record) -> Explanation | NoExplanation | NeedRollout:
        found = explain(query, record)
        if isinstance(found, NoExplanation):
            self.queries[query] = found
        return found

    def put(self, event: Asked | TurnedAway | RolloutsArrived | RolloutsFailed) -> Output:
        self.dialogue, outputs = advance(self.mind, self.dialogue, event)
        [output] = outputs
        return output

    def ask(self, text: str, at: float) -> Reply:
        output = self.put(Asked("q", "ada", text, at))
        while isinstance(output, RolloutsWanted):
            self.wanted.append(output.need)
            came = self.again(output.need)
            if isinstance(came, PlanTrace):
                output = self.put(RolloutsArrived("q", "ada", again(came, output.need)))
            else:
                output = self.put(RolloutsFailed("q", "ada", came))
        assert isinstance(output, Answered)
        return output.reply

    def facts(self, reply: Reply) -> Facts:
        assert reply.query is not None
        return self.queries[reply.query].facts


def talk(ride: Ride, again: Again = lambda need: "planner-unavailable") -> Talk:
    return Talk(fold(Mind(parse, explain), inputs_of(ride)), again)


def cold() -> Ride:
    """A ride of which nothing is recorded yet."""
    return Ride(0.0, (), ())


def flat() -> Ride:
    """S1, where all that the ego may do comes to the same."""
    world = s1_world()
    same = World(world.aims, world.plans, lambda plan, chosen: world.simulate(("stop",), chosen))
    return Ride(7.0, (trace_of(same),), S1.events)


def sparse() -> Ride:
    """S1, where going on was tried once, in the unlikely case."""
    [_, trace, *_] = S1.traces
    others = [r for r in trace.rollouts if r.actions[0].action != "continue"]
    once = next(
        r for r in trace.rollouts if r.actions[0].action == "continue" and r.samples[0].goal == 1
    )
    return Ride(7.0, (msgspec.structs.replace(trace, rollouts=(*others, once)),), S1.events)


def stubborn(need: NeedRollout) -> PlanTrace:
    """Plans again and draws the same once more."""
    [trace] = sparse().traces
    made = WhatIf(actions=need.actions, rollouts=need.rollouts)
    more = tuple(r for r in trace.rollouts if r.actions[0].action == "continue")
    return msgspec.structs.replace(trace, rollouts=trace.rollouts + more, what_if=made)


def impossible(need: NeedRollout) -> PlanTrace:
    """Plans again and finds that the last action does not apply."""
    made = WhatIf(actions=need.actions, rollouts=need.rollouts)
    refused = NotApplicable(need.actions[:-1], need.actions[-1], "its lane ends there")
    trace = S1.traces[1]
    entries = (*trace.not_applicable, refused)
    return msgspec.structs.replace(trace, not_applicable=entries, what_if=made)


@dataclass(frozen=True)
class Case:
    """A question that is declined."""

    reason: Reason
    question: str
    says: str
    facts: Facts | None = None  # at least these; None where no explanation was tried
    ride: Callable[[], Ride] = lambda: S1
    at: float = 7.0
    again: Again = lambda need: "planner-unavailable"


CASES = (
    Case("not-understood", "blorp wug zzz", "I"),
    Case("ambiguous", "Why?", "I am not sure what you mean."),
    Case(
        "out-of-scope",
        "What is the weather like?",
        "That is beyond me: I only know about this drive.",
    ),
    Case("not-an-action", "Why did you not fly?", "I cannot fly"),
    Case(
        "unknown-vehicle",
        "Why did vehicle 9 stop?",
        "I know of no vehicle 9. I have seen vehicle 1 and vehicle 2.",
        {"vehicle": 9, "known": ("1", "2")},
    ),
    Case(
        "did-not-happen",
        "Why did you change lanes?",
        "I did not change lanes; so far I have only gone straight on.",
        {"asked": ("change-left",), "did": False, "happened": ("continue",)},
        at=2.5,
    ),
    Case(
        "did-not-happen",
        "Why did you turn left?",
        "I did not turn left. I moved to the left lane at 0:04.",
        {"asked": ("exit-left",), "did": False, "happened": ("change-left",), "time": 4.1},
    ),
    Case(
        "did-not-happen",
        "Why did you give way?",
        "I did not give way. ",
        {"asked": ("give-way",), "did": False},
    ),
    Case(
        "did-not-happen",
        "Why did you not change lanes?",
        "That is just what I did: I moved to the left lane at 0:04.",
        {"asked": ("change-left",), "did": True, "time": 4.1},
    ),
    Case(
        "did-not-happen",
        "Why did you not go straight on?",
        "That is just what I am doing: I am going straight on.",
        {"asked": ("continue",), "did": True},
        at=2.5,
    ),
    Case(
        "not-applicable",
        "Why did you not change to the right lane?",
        "I could not move to the right lane: there is no lane to the right.",
        {"asked": ("change-right",), "reason": "there is no lane to the right", "time": 4.0},
    ),
    Case(
        "not-applicable",
        "What if you had changed left and turned right?",
        "I could not turn right: my lane ends there.",
        {"asked": ("exit-right",), "reason": "its lane ends there", "time": 4.0},
        again=impossible,
    ),
    Case(
        "no-influence",
        "Did vehicle 2 have anything to do with it?",
        "The car ahead on the right (vehicle 2) had nothing to do with that",
        {"vehicle": 2, "seen": True, "time": 4.0},
    ),
    Case(
        "no-influence",
        "Why did you change lanes because of vehicle 2?",
        "The car ahead on the right (vehicle 2) had nothing to do with that",
        {"vehicle": 2, "seen": True, "time": 4.0},
    ),
    Case(
        "no-influence",
        "What mattered most?",
        "No other vehicle made a difference to that.",
        {},
        ride=flat,
    ),
    Case(
        "too-little-evidence",
        "Why did you not stay in your lane?",
        "I have tried that in only one situation",
        {"asked": ("continue",), "distinct": 1, "needed": MIN_DISTINCT},
        ride=sparse,
        again=stubborn,
    ),
    Case(
        "effect-too-small",
        "Why did you not stay in your lane?",
        "To stay in my lane would have made no difference worth speaking of: "
        "I compared the two, and both take as long.",
        {"asked": ("continue",), "chosen": ("change-left",), "delta": 0.0},
        ride=flat,
    ),
    Case(
        "trace-gap",
        "Why are you doing that?",
        "I have no record of my planning from that moment",
        {"time": 0.0},
        ride=cold,
        at=0.0,
    ),
    Case(
        "timed-out", "What if vehicle 1 had not been there?", "Working", again=lambda n: "timed-out"
    ),
    Case("busy", "What if vehicle 1 had not been there?", "I am still", again=lambda n: "busy"),
    Case(
        "planner-failed",
        "What if vehicle 1 had not been there?",
        "My planner could not work that out",
        again=lambda n: "planner-failed",
    ),
    Case(
        "planner-unavailable", "What if vehicle 1 had not been there?", "My planner is not running"
    ),
)


def certainly(aim: Aim) -> Aim:
    return replace(aim, probability=1.0)


def passing() -> Ride:
    """S1 with a vehicle 3 that was seen, but of which no decision expected anything."""
    first = S1.traces[0]
    seen = msgspec.structs.replace(first, scene={**first.scene, 3: first.scene[1]})
    return Ride(7.0, (seen, *S1.traces[1:]), S1.events)


OUTSIDE = Case(
    "outside-record",
    "Where is vehicle 3 going?",
    "I have no record of what happened at 0:07.",
    {"vehicle": 3, "time": 7.0},
    ride=passing,
)


@pytest.mark.parametrize("case", [*CASES, OUTSIDE], ids=lambda c: f"{c.reason}: {c.question}")
def test_a_reason_is_reached_by_asking_and_told_with_its_facts(case: Case) -> None:
    told = talk(case.ride(), case.again)
    reply = told.ask(case.question, case.at)
    assert reply.reason == case.reason, reply.text
    assert reply.kind == ("clarification" if case.reason == "ambiguous" else "refusal")
    assert reply.text.startswith(case.says), reply.text
    assert reply.explanation is None
    if case.facts is not None:
        facts = told.facts(reply)
        assert {name: facts.get(name) for name in case.facts} == case.facts


def test_every_reason_is_in_the_table() -> None:
    assert {case.reason for case in (*CASES, OUTSIDE)} == set(get_args(Reason))


@pytest.mark.parametrize("reason", ["timed-out", "busy", "planner-unavailable", "planner-failed"])
def test_who_is_turned_away_at_the_door_hears_why(reason: Reason) -> None:
    told = talk(S1)
    output = told.put(TurnedAway(Asked("q", "ada", "Why did you change lanes?", 7.0), reason))
    assert isinstance(output, Answered)
    assert (output.reply.kind, output.reply.reason) == ("refusal", reason)
    assert output.reply.text


def test_influence_is_denied_with_its_measure() -> None:
    told = talk(S1)
    reply = told.ask("Did vehicle 2 have anything to do with it?", 7.0)
    facts = told.facts(reply)
    assert facts["bits"] == pytest.approx(0.0, abs=MIN_BITS)
    assert facts.get("null", 0.0) == pytest.approx(0.0, abs=MIN_BITS)
    blamed = told.ask("Did vehicle 1 have anything to do with it?", 7.0)
    assert (blamed.kind, blamed.text[:4]) == ("answer", "Yes.")
    asked = told.ask("Did you change lanes because of vehicle 2?", 7.0)
    assert (asked.kind, asked.text[:3]) == ("answer", "No,")


def test_who_was_not_in_view_had_no_influence() -> None:
    world = s1_world()
    alone = World(
        {1: world.aims[1]}, world.plans, lambda p, c: world.simulate(p, {**c, 2: ("", 0)})
    )
    early = trace_of(alone, draws=60, time=4.0, decision=4)
    told = talk(Ride(7.0, (early, S1.traces[-1]), S1.events))
    reply = told.ask("Did vehicle 2 have anything to do with it?", 7.0)
    assert reply.reason == "no-influence"
    assert told.facts(reply)["seen"] is False
    assert "was not in view when I decided it" in reply.text


def test_thin_evidence_is_declined_after_every_round_and_with_its_size() -> None:
    told = talk(sparse(), stubborn)
    reply = told.ask("Why did you not stay in your lane?", 7.0)
    assert tuple(need.rollouts for need in told.wanted) == ROUNDS
    facts = told.facts(reply)
    assert (facts["rollouts"], facts["distinct"], facts["needed"]) == (2, 1, MIN_DISTINCT)
    assert isinstance(facts["coverage"], float)
    assert 0.0 < facts["coverage"] < MIN_COVERAGE


def test_few_situations_are_enough_where_no_more_exist() -> None:
    world = s1_world()
    certain = {1: (certainly(world.aims[1][0]),), 2: (certainly(world.aims[2][0]),)}
    only = World(certain, world.plans, world.simulate, world.not_applicable)
    told = talk(Ride(7.0, (trace_of(only, draws=3),), S1.events))
    reply = told.ask("Why did you not stay in your lane?", 7.0)
    assert reply.kind == "answer"
    assert reply.explanation is not None
    assert reply.explanation.evidence.distinct_samples == 1 < MIN_DISTINCT


# What is said of what was not done ---------------------------------------------------------------


def turning(time: float = 5.0) -> Ride:
    """S2 before the turn, of which the ego is about to be certain."""
    return Ride(time, S2.traces[:1], S2.events[:1])


@pytest.mark.parametrize(
    ("question", "reason", "says"),
    [
        (
            "Why did you turn right?",
            "did-not-happen",
            "I have not turned right yet, but I plan to.",
        ),
        (
            "Why did you not turn right?",
            "did-not-happen",
            "I have not turned right yet, but I plan to.",
        ),
        ("Why will you turn right?", None, "I will turn right"),
        ("Why did you not go straight on?", None, "I am turning right"),
        ("Why did you not turn left?", None, "I am turning right"),
        ("Why did you give way?", "did-not-happen", "I did not give way."),
        ("What if you had not given way?", "did-not-happen", "I did not give way."),
    ],
)
def test_a_turn_to_come_is_not_spoken_of_as_done(
    question: str, reason: Reason | None, says: str
) -> None:
    reply = talk(turning()).ask(question, 5.0)
    assert (reply.reason, reply.text[: len(says)]) == (reason, says)


def test_a_plan_to_stop_is_no_plan_to_give_way() -> None:
    world = s1_world()
    stopping = World(world.aims, world.plans, world.simulate, world.not_applicable, ("stop",))
    ride = Ride(4.0, (trace_of(stopping, draws=60),), S1.events[:1])
    told = talk(ride)
    reply = told.ask("Why did you give way?", 4.0)
    assert "planned" not in told.facts(reply)
    assert told.facts(told.ask("Why did you stop?", 4.0))["planned"] is True


def test_giving_way_is_no_choice_and_can_be_asked_about() -> None:
    waited = Event("gave-way", 6.5, "exit-right", 5, vehicle=1)
    told = talk(Ride(9.0, S2.traces, (*S2.events, waited)))
    reply = told.ask("What if you had not given way?", 9.0)
    assert (reply.reason, told.facts(reply)["undone"]) == ("not-applicable", True)
    assert reply.text.startswith("I could not have done without giving way: it follows from")
    assert reply.suggestions[0] == "Why did you give way?"


def test_why_not_another_way_is_asked_of_the_turn_and_not_of_what_came_later() -> None:
    reply = talk(S2).ask("Why did you not turn left?", 9.0)
    assert reply.kind == "answer"
    assert reply.text.startswith("At 0:05, I turned right")


def test_a_plan_that_was_given_up_is_not_spoken_of_as_done() -> None:
    world = s1_world()
    plans = {2.0: "continue", 4.0: "exit-right"}
    free = [
        trace_of(replace(world, plan=(action,)), draws=60, time=time, decision=int(time))
        for time, action in plans.items()
    ]
    hemmed_in = trace_of(
        World(world.aims, (("continue",),), world.simulate), draws=60, time=6.0, decision=6
    )
    events = (
        Event("action-started", 0.0, "continue", 0),
        Event("action-started", 4.0, "exit-right", 4),
        Event("action-ended", 6.0, "exit-right", 5),
        Event("action-started", 6.0, "continue", 6),
    )
    reply = talk(Ride(7.0, (*free, hemmed_in), events)).ask("Why did you not change lanes?", 7.0)
    assert reply.explanation is not None
    assert reply.explanation.sim_time == 2.0
    assert reply.explanation.factual == ("continue",)


# Suggestions -----------------------------------------------------------------------------------

PROVOKING = (
    "Why did you fly?",
    "Why did you change lanes?",
    "Why did you turn left?",
    "Why did you give way?",
    "What if you had not given way?",
    "Why did you not change to the right lane?",
    "Why did vehicle 1 stop?",
    "What if vehicle 1 had stopped?",
    "Did vehicle 2 have anything to do with it?",
    "Where is vehicle 9 going?",
    "What is the weather like?",
    "Help",
    "Hello",
    "blorp wug zzz",
)


@cache
def recorded(name: str) -> tuple[Dialogue, tuple[float, ...]]:
    """A recorded ride, and moments of it: early, at each third decision, and after its end."""
    ride = recording(ROOT / "transcripts" / "rides" / f"{name}.ride.jsonl.gz")
    inputs = [*map(TraceRecorded, ride.traces), *map(EventRecorded, ride.events)]
    over = [] if ride.ended is None else [RideEnded(ride.ended)]
    last = ride.traces[-1].sim_time
    times = (0.5, *(trace.sim_time for trace in ride.traces[3::3]), last + 2.0)
    return fold(Mind(parse, explain), [*inputs, *over]), times


@pytest.mark.parametrize("name", ["s1-0", "s2-0"])
def test_what_is_suggested_is_answered(name: str) -> None:
    dialogue, times = recorded(name)
    tried = 0
    for time in times:
        for question in PROVOKING:
            told = Talk(dialogue)
            reply = told.ask(question, time)
            if reply.explanation is not None:
                continue
            for suggestion in reply.suggestions:
                told = Talk(told.dialogue)
                again = told.ask(suggestion, time)
                assert again.explanation is not None, (time, question, suggestion, again.text)
                tried += 1
    assert tried > 20


@pytest.mark.parametrize("question", PROVOKING)
def test_nothing_is_suggested_where_nothing_is_recorded(question: str) -> None:
    reply = talk(cold()).ask(question, 0.0)
    assert reply.suggestions == ()
    assert "could ask" not in reply.text
