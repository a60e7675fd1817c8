"""Suppositions, sudden acts and requests: what each is to be answered with."""

from msgspec.structs import replace

from tests.nlg.answer_cases import E
from tests.nlg.causal_cases import LATER, PRIORITY, RISKY, SLOWED, ends
from tests.nlg.scenery import NOW
from xavi_dialogue.domain.answers import (
    Activity,
    Answer,
    Declined,
    Reaction,
    Share,
    SupposedOfOther,
    SupposedOfUs,
    Unslowed,
)
from xavi_dialogue.domain.evidence import Effect, OutcomeEstimate
from xavi_dialogue.domain.meaning import Request
from xavi_dialogue.domain.reasons import MotionCause, Performed
from xavi_dialogue.domain.terms import Event, Vehicle

STOPS = Event("stop", Vehicle(2))
STANDING = Activity(E, NOW, (), 0.0, "standing")
SLOWING = Activity(E, NOW, (), 5.0, "slowing")
LETS = MotionCause("right-of-way", 2)
GAIN = replace(
    LATER,
    verdict="worse",
    terms=(Share("effort", 2.0), Share("time", -3.0)),
    told=(Share("time", -3.0), Share("effort", 2.0)),
    effects=(Effect("time", "s", -3.0, -4.0, -2.0, 20, 8),),
)
SAME = replace(LATER, effects=(), verdict="close", told=())
TINY_RISK = replace(
    GAIN,
    verdict="better",
    terms=(Share("collision", 4.0, 0.004, 0.0), Share("time", -3.0)),
    told=(Share("collision", 4.0, 0.004, 0.0), Share("time", -3.0)),
    causes=(),
)
BOTH_LATE = ends("termination", 0.97, fact_outcome=OutcomeEstimate("termination", 0.93), causes=())
SAFER = replace(LATER, fact_collision=0.05)
RISKIER = replace(LATER, collision=0.05, collided_with=2)

CASES: tuple[Answer, ...] = (
    Reaction(2, "room", STOPS, NOW, 13.9, 26.3, 40.0, 12.0),
    Reaction(2, "room", STOPS, NOW, 13.9, 26.3, 40.0, asked="stop"),
    Reaction(2, "room", STOPS, 10.0, 13.9, 26.3, 40.0, past=True, asked="collide"),
    Reaction(2, "room", None, NOW, 13.9, 26.3, 40.0, negated=True),
    Reaction(2, "short", STOPS, NOW, 13.9, 26.3, 10.0, -16.0, asked="stop"),
    Reaction(2, "short", STOPS, 10.0, 13.9, 26.3, 10.0, -16.0, past=True),
    Reaction(2, "short", STOPS, NOW, 13.9, 26.3, 10.0, asked="collide"),
    Reaction(2, "short", STOPS, 10.0, 13.9, 26.3, 0.0, past=True),
    Reaction(2, "first", STOPS, NOW, 13.9, 26.3, 10.0),
    Reaction(2, "first", STOPS, 10.0, 13.9, 26.3, 10.0, past=True),
    Reaction(2, "behind", STOPS, NOW, 13.9),
    Reaction(2, "behind", STOPS, 10.0, 13.9, past=True, asked="stop"),
    Reaction(2, "behind", STOPS, NOW, 13.9, asked="collide"),
    Reaction(2, "apart", STOPS, NOW, 13.9),
    Reaction(2, "apart", STOPS, NOW, 13.9, asked="stop"),
    Reaction(2, "beside", STOPS, NOW, 13.9),
    Reaction(2, "beside", STOPS, 10.0, 13.9, past=True),
    Reaction(2, "standing", STOPS, NOW, 0.0, room=6.0),
    Reaction(2, "standing", STOPS, 10.0, 0.0, room=0.5, past=True),
    Reaction(2, "joins", STOPS, NOW, 13.9, 26.3, 8.0),
    Reaction(2, "joins", STOPS, 10.0, 13.9, 26.3, 8.0, past=True),
    Reaction(None, "anybody", None, NOW, 13.9, 26.3),
    SupposedOfUs(BOTH_LATE),
    SupposedOfUs(BOTH_LATE, past=False),
    SupposedOfUs(TINY_RISK),
    SupposedOfUs(TINY_RISK, past=False),
    SupposedOfUs(LATER, form="could"),
    SupposedOfUs(GAIN, form="could"),
    SupposedOfUs(RISKIER, form="could"),
    SupposedOfUs(ends("collision", 0.8, 2), form="could"),
    SupposedOfUs(ends("dead"), form="could"),
    SupposedOfUs(replace(LATER, continued=("change-left",)), form="could"),
    SupposedOfUs(LATER, form="crash"),
    SupposedOfUs(LATER, form="crash", past=False),
    SupposedOfUs(SAME, form="crash"),
    SupposedOfUs(RISKIER, form="crash"),
    SupposedOfUs(replace(RISKY, collision=0.9), form="crash"),
    SupposedOfUs(LATER, form="better"),
    SupposedOfUs(GAIN, form="better"),
    SupposedOfUs(SAME, form="better"),
    SupposedOfUs(RISKIER, form="better"),
    SupposedOfUs(ends("collision", 0.8, 2, fact_collision=0.3), form="better"),
    SupposedOfUs(LATER, form="safe", past=False),
    SupposedOfUs(RISKIER, form="safe", past=False),
    SupposedOfUs(replace(RISKY, collision=0.9), form="safe", past=False),
    SupposedOfUs(RISKIER, form="quicker"),
    SupposedOfUs(LATER, form="quicker"),
    SupposedOfUs(GAIN, form="quicker"),
    SupposedOfUs(ends("collision", 0.8, 2), form="quicker"),
    SupposedOfUs(SAFER, form="safer"),
    SupposedOfUs(RISKIER, form="safer"),
    SupposedOfUs(replace(RISKIER, fact_collision=0.05), form="safer"),
    SupposedOfUs(SAME, form="safer"),
    SupposedOfUs(LATER, form="arrival", arrival=40.0),
    SupposedOfUs(SAME, form="arrival", arrival=40.0),
    SupposedOfUs(SAME, form="arrival"),
    SupposedOfOther(2, None, None, (), (), True, LATER, form="arrival", arrival=40.0),
    SupposedOfOther(2, STOPS, None, (), (), True, GAIN, form="arrival", arrival=40.0),
    SupposedOfOther(2, None, None, (), (), True, SAME, form="arrival"),
    SupposedOfOther(2, None, None, (), (), True, GAIN, form="quicker"),
    SupposedOfOther(2, None, None, (), (), True, LATER, form="quicker"),
    SupposedOfOther(2, None, None, (), (), True, SAME, form="quicker"),
    SupposedOfOther(2, None, None, (), (), True, SAME, form="quicker", past=False),
    SupposedOfOther(2, STOPS, 0.1, LATER.fact, LATER.fact, True, None, slows=True),
    SupposedOfOther(2, STOPS, 0.1, LATER.fact, LATER.fact, True, None, False, slows=True),
    Unslowed(SLOWED, PRIORITY, 14.0, 14.5, vehicle=2),
    Unslowed(SLOWED, PRIORITY, 14.0, 14.5, vehicle=2, past=False),
    Unslowed(SLOWED, PRIORITY, 14.0, 16.0, vehicle=2, form="crash"),
    Unslowed(SLOWED, PRIORITY, 14.0, 14.5, vehicle=2, form="crash"),
    Unslowed(SLOWED, PRIORITY, 14.0, 24.5, vehicle=2, right=False, form="crash"),
    Unslowed(SLOWED, PRIORITY, 14.0, 14.5, vehicle=2, form="could"),
    Unslowed(SLOWED, PRIORITY, 14.0, 16.0, vehicle=2, form="could"),
    Unslowed(SLOWED, PRIORITY, 14.0, 24.0, vehicle=2, form="could"),
    Unslowed(SLOWED, PRIORITY, 14.0, 4.0, vehicle=2, form="could"),
    Unslowed(SLOWED, PRIORITY, form="could"),
    Unslowed(SLOWED, MotionCause("plan"), form="crash"),
    Unslowed(SLOWED, PRIORITY, 14.0, 24.0, vehicle=2, past=False, form="crash", red=True),
    Unslowed(SLOWED, PRIORITY, form="arrival", saved=3.0, arrival=40.0),
    Unslowed(SLOWED, PRIORITY, form="arrival", saved=3.0, arrival=NOW),
    Unslowed(SLOWED, PRIORITY, form="arrival", saved=0.1, arrival=40.0),
    Declined(Request(Event("go", tense="present")), cause=LETS, doing=STANDING),
    Declined(Request(Event("go", tense="present")), cause=LETS, doing=SLOWING),
    Declined(Request(Event("follow", object=Vehicle(2))), already=True, doing=SLOWING),
    Declined(Request(Event("stop"), negated=True), already=True),
    Declined(Request(Event("stop"), negated=True), cause=LETS),
    Declined(Request(Event("stop"), negated=True)),
    Declined(Request(Event("do"), negated=True), cause=LETS),
    Declined(Request(Event("do"), negated=True), already=True),
    Declined(Request(Event("brake", manner=("hard",)), negated=True), already=True),
    SupposedOfUs(GAIN, later=Performed("change-left", "did", 4.0)),
    SupposedOfUs(GAIN, later=Performed("change-left", "doing", 4.0)),
    SupposedOfUs(GAIN, past=False, later=Performed("change-left", "will")),
    SupposedOfUs(SAME, done=Performed("exit-right", "did", 4.0)),
    SupposedOfUs(SAME, past=False, done=Performed("exit-right", "doing", 4.0)),
    SupposedOfUs(SAME, past=False, done=Performed("exit-right", "will")),
    SupposedOfOther(2, None, None, LATER.fact, LATER.fact, True, others=(1,)),
    SupposedOfOther(2, STOPS, None, LATER.fact, LATER.fact, True, left_out=(1,)),
    SupposedOfOther(2, STOPS, None, LATER.fact, LATER.fact, True, within=LATER),
    SupposedOfOther(2, None, None, LATER.fact, LATER.fact, True, within=LATER, past=False),
)
