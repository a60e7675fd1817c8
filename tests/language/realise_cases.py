"""Explanations to be put into words: hand-made ones, and a Hypothesis strategy for any."""

from typing import get_args

from hypothesis import strategies as st
from msgspec.structs import replace

from planner.trace import ACTIONS, COMPONENTS, UNITS, Action, Component, Outcome
from xavi_dialogue.explain.details import (
    Avoidance,
    Certainty,
    Choices,
    Contrary,
    Grounds,
    Mishap,
    Need,
    Option,
    Pivot,
    Sight,
    Staying,
    Step,
    Suspect,
)
from xavi_dialogue.explain.explanation import (
    Activity,
    Cause,
    Destination,
    Effect,
    Evidence,
    Explanation,
    Mechanism,
    OutcomeEstimate,
)
from xavi_dialogue.explain.query import Query, QueryType
from xavi_dialogue.language.context import SpeechContext, VehicleWords

CUT_AND_TURN: tuple[Action, ...] = ("change-right", "exit-right")


def explanation(
    foil: tuple[Action, ...],
    outcome: Outcome = "done",
    probability: float = 1.0,
    effects: tuple[Effect, ...] = (),
    causes: tuple[Cause, ...] = (),
    *,
    fact: tuple[Action, ...] = ("change-left", "continue"),
    hit: int | None = None,
) -> Explanation:
    return Explanation(
        factual=fact,
        counterfactual=foil,
        outcome=OutcomeEstimate(outcome, probability, hit),
        effects=effects,
        causes=causes,
        evidence=Evidence("tree", 120, 32, ("0123456789abcdef",)),
    )


def effect(component: Component, delta: float, spread: float = 0.4) -> Effect:
    return Effect(component, UNITS[component], delta, delta - spread, delta + spread, 60, 20)


def cause(
    vehicle: int,
    actions: tuple[Action, ...],
    probability: float,
    mechanism: Mechanism | None = None,
    decision_changes: bool | None = None,
) -> Cause:
    return Cause(vehicle, actions, probability, mechanism, 0.3, decision_changes)


def watching(activity: Activity, arrival: float | None = None) -> Explanation:
    """An answer to "what"."""
    evidence = Evidence("tree", 100, 20, ("0123456789abcdef",))
    return Explanation(
        factual=(),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=evidence,
        activity=activity,
        arrival=arrival,
    )


_probabilities = st.one_of(st.sampled_from([0.0, 1.0, 1 - 1e-12]), st.floats(0, 1))
_numbers = st.integers(1, 5)
_plans = st.lists(st.sampled_from(ACTIONS), max_size=4).map(tuple)
_some_plans = st.lists(st.sampled_from(ACTIONS), min_size=1, max_size=3).map(tuple)
_speeds = st.none() | st.floats(0, 40)
_mechanisms = st.builds(
    Mechanism,
    how=st.sampled_from(["leader", "right-of-way", "cut-in", "blocked", "collision"]),
    speed_from=_speeds,
    speed_to=_speeds,
    delay=st.none() | st.floats(0, 20),
    share=st.floats(0, 1),
)
_causes = st.lists(
    st.builds(
        Cause,
        vehicle=_numbers,
        actions=_plans,
        probability=_probabilities,
        mechanism=st.none() | _mechanisms,
        influence=st.none() | st.floats(0, 2),
        decision_changes=st.none() | st.booleans(),
    ),
    max_size=4,
    unique_by=lambda c: c.vehicle,
).map(tuple)


@st.composite
def _effects(draw: st.DrawFn) -> tuple[Effect, ...]:
    components = draw(st.lists(st.sampled_from(COMPONENTS), unique=True))
    return tuple(effect(c, draw(st.floats(-20, 20)), draw(st.floats(0, 20))) for c in components)


_activities = st.builds(
    Activity,
    vehicle=st.integers(0, 5),
    actions=_plans,
    probability=st.none() | _probabilities,
    speed=_speeds,
    trend=st.sampled_from([None, "slowing", "steady", "speeding-up", "standing"]),
)

_destinations = st.builds(
    Destination,
    vehicle=st.integers(0, 5),
    edge=st.sampled_from([None, "main_out"]),
    kind=st.none() | st.sampled_from(ACTIONS),
    place=st.sampled_from([None, "the road to the left"]),
    probability=st.none() | _probabilities,
)

_moments = st.floats(0, 3600)
_shares = st.floats(0, 1)
_counts = st.integers(0, 60)
_deeds = st.sampled_from([*ACTIONS, "slow-down", "speed-up"])


@st.composite
def _certainties(draw: st.DrawFn) -> Certainty:
    """As sure as the situations are in which it did well, and no surer."""
    situations = draw(st.integers(1, 60))
    good = draw(st.integers(0, situations))
    share = good / situations
    about = draw(st.sampled_from(["plan", "choice"]))
    low = draw(st.floats(0.2 * share, 0.99 * share))
    return Certainty(about, share, low, good, situations, draw(st.integers(0, good)))


_details_of_answers = st.fixed_dictionaries(
    {},
    optional={
        "span": st.tuples(_moments, _moments).map(sorted).map(tuple),
        "least": st.floats(0, 90),
        "seen": _moments,
        "options": _some_plans,
        "steps": st.lists(st.builds(Step, action=st.sampled_from(ACTIONS), moment=_moments)).map(
            tuple
        ),
        "grounds": st.builds(
            Grounds,
            vehicle=_numbers,
            actions=_some_plans,
            done=st.booleans(),
            probability=_shares,
            latest=_shares,
            since=st.none() | _moments,
            start=_moments,
            end=_moments,
            before=_shares,
            after=_shares,
            deed=st.none() | _deeds,
            speed_from=_speeds,
            speed_to=_speeds,
            rival=_plans,
            fit=st.none() | st.floats(0, 1000),
        ),
        "certainty": _certainties(),
        "avoidance": st.builds(
            Avoidance,
            mishap=st.sampled_from(get_args(Mishap)),
            possible=st.booleans(),
            risk=_shares,
            other=_shares,
            decisions=_counts,
            options=_counts,
        ),
        "pivot": st.builds(
            Pivot,
            kind=st.sampled_from(["conduct", "removal", "factor", "none"]),
            vehicle=st.none() | _numbers,
            actions=_plans,
            probability=st.none() | _shares,
        ),
        "suspect": st.builds(
            Suspect, vehicle=_numbers, part=st.sampled_from(["main", "some", "none"])
        ),
        "contrary": st.builds(
            Contrary,
            asked=_some_plans,
            done=st.none() | _moments,
            deed=st.none() | _deeds,
            chance=st.none() | _shares,
        ),
    },
)

_plain_explanations = st.builds(
    Explanation,
    factual=_plans,
    counterfactual=_plans,
    outcome=st.none()
    | st.builds(
        OutcomeEstimate,
        name=st.sampled_from(["done", "collision", "termination", "dead"]),
        probability=_probabilities,
        collided_with=st.none() | _numbers,
    ),
    effects=_effects(),
    causes=_causes,
    evidence=st.builds(
        Evidence,
        method=st.sampled_from(["tree", "rollouts"]),
        rollouts=st.integers(0, 400),
        distinct_samples=st.integers(0, 200),
        traces=st.just(("0123456789abcdef",)),
    ),
    activity=st.none() | _activities,
    sim_time=st.floats(0, 3600),
    arrival=st.none() | st.floats(0, 200),
    destination=st.none() | _destinations,
    moment=st.none() | st.floats(0, 3600),
)


@st.composite
def _any_explanation(draw: st.DrawFn) -> Explanation:
    """What any question may bring; details of the types of questions one at a time and mixed."""
    return replace(draw(_plain_explanations), **draw(_details_of_answers))


_trends = st.sampled_from([None, "slowing", "steady", "speeding-up", "standing"])
_aspects = st.one_of(
    st.fixed_dictionaries(
        {
            "sight": st.builds(
                Sight,
                about=st.sampled_from(["speed", "distance", "place", "count", "nobody"]),
                vehicle=_numbers,
                place=st.sampled_from(["ahead", "behind", "left", "ahead-right", "behind-left"]),
                oncoming=st.booleans(),
                distance=st.floats(0, 2000),
                speed=st.floats(0, 120),
                trend=_trends,
                others=st.lists(_numbers, unique=True).map(sorted).map(tuple),
            )
        }
    ),
    st.fixed_dictionaries(
        {
            "choices": st.builds(
                Choices,
                about=st.sampled_from(["options", "second", "worst", "sooner"]),
                chosen=st.sampled_from(ACTIONS),
                others=st.lists(
                    st.builds(
                        Option,
                        action=st.sampled_from(ACTIONS),
                        outcome=st.sampled_from(get_args(Outcome)),
                        probability=st.floats(0.3, 1),
                        delta=st.none() | st.floats(-60, 5000),
                        collided_with=st.none() | _numbers,
                    ),
                    max_size=6,
                    unique_by=lambda option: option.action,
                ).map(tuple),
            )
        }
    ),
    st.fixed_dictionaries(
        {
            "need": st.builds(
                Need,
                asked=st.sampled_from(["necessary", "other-way", "better-way"]),
                kind=st.sampled_from(["only", "bad", "worse", "equal", "driving"]),
                foil=st.none() | st.sampled_from(ACTIONS),
            )
        }
    ),
    st.fixed_dictionaries(
        {
            "staying": st.builds(
                Staying,
                deed=st.sampled_from(["change-left", "change-right", "exit-left", "exit-right"]),
                since=_moments,
                under_way=st.booleans(),
                only=st.booleans(),
                reason=st.sampled_from([None, "the lane ends too soon to change"]),
                same=st.booleans(),
            )
            | st.just(Staying())
        }
    ),
)


@st.composite
def _beyond_the_type(draw: st.DrawFn) -> Explanation:
    """What a question brings that asks for something beyond its type."""
    return replace(draw(_plain_explanations), **draw(_aspects))


aspects = _beyond_the_type()
explanations = st.one_of(_plain_explanations, _any_explanation(), aspects)

QUESTION_TYPES: tuple[QueryType, ...] = (
    "why",
    "why_not",
    "what_if",
    "what",
    "where_goal",
    "confidence",
    "compare",
    "when",
    "how",
    "how_avoid",
    "sensitivity",
)
_tenses = st.sampled_from(["past", "present", "future"])
_details = st.sampled_from([None, "more", "less"])
_asked = st.none() | _some_plans
queries = st.builds(
    Query,
    type=st.sampled_from(QUESTION_TYPES),
    actor=st.sampled_from(["ego", "vehicle:1", "vehicle:2", "vehicle:front"]),
    factual=_asked,
    counterfactual=_asked,
    negated=st.booleans(),
    tense=_tenses,
    detail=_details,
    intervention=st.sampled_from([None, "remove"]),
    event=st.sampled_from([None, "could"]),
    condition=st.sampled_from(
        [None, "if vehicle 1 had not been there", "if vehicle 1 had turned left"]
    ),
)

_descriptions = st.sampled_from([None, "the car ahead", "the car behind", "the car on our left"])
contexts = st.builds(
    SpeechContext,
    style=st.just("passenger"),
    vehicles=st.dictionaries(
        _numbers,
        st.builds(VehicleWords, kind=st.sampled_from(["car", "truck"]), description=_descriptions),
    ),
    named=st.frozensets(_numbers),
    detail=_details,
    max_causes=st.integers(0, 3),
    max_effects=st.integers(0, 4),
    done=_plans,
    now=st.floats(0, 3600),
    turn=st.integers(0, 5),
    told=st.frozensets(st.tuples(_numbers, _plans)),
    repeated=st.booleans(),
)
