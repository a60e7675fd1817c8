"""Texts for browsers: actions, goals, hold-ups, causes and events in the car's own words."""

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache, lru_cache
from importlib.resources import files
from itertools import groupby

from planner.prediction.goals import PLACES
from planner.record.events import Event
from planner.record.trace import Action, GoalPrediction, HoldUp
from xavi_dialogue.domain.answers import Cause, Mechanism
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.manoeuvres import CHANGES, other_verbs, own_verbs, plain
from xavi_dialogue.nlg.content.reasons.contrasts import SLOWING, STANDING
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.narration import narrate
from xavi_dialogue.nlg.surface.chances import chance
from xavi_dialogue.nlg.surface.generator import Slot, Token, fill
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.morphology import inflect
from xavi_dialogue.nlg.surface.orthography import capitalise, join, sentence
from xavi_dialogue.nlg.surface.realiser import grammar
from xavi_dialogue.nlg.surface.values import Clause, Quantity, Range, Who

POSSIBLE = 0.3  # expectations with a lower probability are stated as what might be


@cache
def deed(action: str, form: str = "base", *, in_lane: bool = False) -> str:
    """Return what the ego does, in a verb form: "move to the left lane".

    Args:
        action: of the ego.
        form: base, past, participle or gerund.
        in_lane: a change of lane is the other choice: who goes on stays in the lane.
    """
    return _said((Slot(own_verbs((action,), CHANGES if in_lane else ()), form),))


def has_lane_change(actions: Iterable[str]) -> bool:
    """Check whether a lane change is one of the choices."""
    return any(action in CHANGES for action in actions)


def refusals(
    refused: Iterable[tuple[Action, str]], tried: Iterable[Action]
) -> tuple[tuple[Action, str], ...]:
    """List inapplicable actions with reasons, except those named like one that was tried.

    "Straight on" is one name for two macro actions, of which one or the other applies.
    """
    names = {deed(action) for action in tried}
    return tuple((action, why) for action, why in refused if deed(action) not in names)


def plan_words(plan: Iterable[Action], *, in_lane: bool = False) -> str:
    """Return a plan: "move to the left lane, then turn left"; where there is none, the car stops.

    Args:
        plan: of the ego.
        in_lane: see `deed`; of what is done first.
    """
    actions = plain(plan) or ("stop",)
    said = [deed(action, in_lane=in_lane and k == 0) for k, action in enumerate(actions)]
    return ", then ".join(words for words, _ in groupby(said))


@lru_cache(maxsize=1024)  # bounded, since plans of others come from outside
def does(actions: tuple[str, ...]) -> str:
    """Describe the plan of another vehicle: "changes to the right lane and turns right"."""
    verbs = tuple(replace(verb, tense="present") for verb in other_verbs(actions))
    return _said((Slot(verbs, "predicate"),))


def goal_words(goal: GoalPrediction) -> str:
    """Describe what a vehicle does by its goal: "turns left"."""
    if goal.place == PLACES.get(goal.kind):
        return does((goal.kind,))
    return _table()["goal"]["elsewhere"].format(goal.place)


def hold_up_words(how: HoldUp) -> str:
    """Describe how a vehicle is in our way: "cutting in ahead of me"."""
    return _table()["held-up"][how]


def cause_words(cause: Cause, *, of_ours: bool = True) -> str:
    """Describe what a vehicle was expected to do: "will very likely slow from 43 to 11 km/h".

    Args:
        cause: the vehicle.
        of_ours: it is in our way; else it is in another's, and so may we be.
    """
    verbs = _expected(cause) if of_ours else other_verbs(cause.actions)
    if not verbs:
        return _table()["held-up-another" if not of_ours else "expected"]["any"]
    likely = chance(min(max(cause.probability, POSSIBLE), 1.0), "modal")
    return f"{likely} {_said((Slot(verbs, 'base'),))}"


def _expected(cause: Cause) -> tuple[Clause, ...]:
    """Describe what a vehicle was expected to do, with how it slows."""
    verbs, slowing = other_verbs(cause.actions), _slowing(cause.mechanism)
    if slowing is None or not cause.actions:
        return verbs
    telling = [verb for verb in verbs[-1:] if set(cause.actions) - {"continue", "stop"}]
    return (Clause("it", "slow from", (slowing,)), *telling)


def _slowing(mechanism: Mechanism | None) -> Range | None:
    """Return from which speed to which a vehicle slows; None if it hardly does."""
    if mechanism is None or mechanism.how != "leader":
        return None
    if mechanism.speed_from is None or mechanism.speed_to is None:
        return None
    if mechanism.speed_from - mechanism.speed_to < SLOWING:
        return None
    return Range(Quantity(mechanism.speed_from, "m/s"), Quantity(mechanism.speed_to, "m/s"))


def way_words(cause: Cause, *, of_ours: bool = True) -> str | None:
    """Describe how a vehicle held us up, or another: "slowing ahead of me, from 42 to 13 km/h"."""
    mechanism = cause.mechanism
    if mechanism is None:
        return None
    if not of_ours:
        return _table()["held-up-another"][mechanism.how]
    if mechanism.how != "leader":
        return _table()["held-up"][mechanism.how]
    slowing, lowest = _slowing(mechanism), mechanism.speed_to
    if slowing is not None:
        return _table()["leader"]["slows"].format(_said((Slot(slowing, "plain"),)))
    if lowest is None:
        return _table()["held-up"]["leader"]
    if lowest < STANDING:
        return _table()["leader"]["stands"]
    return _table()["leader"]["drives"].format(_said((Slot(Quantity(lowest, "m/s"), "plain"),)))


def checked_words(cause: Cause) -> str | None:
    """Describe the result of planning again without a vehicle; None: it was not tried."""
    who = Who(Vehicle(cause.vehicle))
    if cause.decision_changes is not None:
        return _told(message("WITHOUT_CAUSE", who=who, changes=cause.decision_changes, past=True))
    if cause.necessary is None:
        return None
    if cause.necessary:
        return _told(message("WITHOUT_IT", who=who, past=True))
    return _told(message("NO_DIFFERENCE", who=who, past=True, many=False))


def component_words(component: str) -> str:
    """Return a component of the reward: "time to the goal"."""
    return _table()["component"][component]


def event_words(event: Event) -> str:
    """Return an event as a sentence: "I change to the left lane."."""
    other = _table()["event"]
    if event.kind == "action-ended" and event.action is not None:  # perhaps it was given up
        return capitalise(other[event.kind].format(deed(event.action, "gerund")))
    if event.kind in ("gave-way", "collided") and event.vehicle is None:
        return other[event.kind]
    told = narrate(event)
    if told is not None:
        return told.partition(" ")[2]  # without the time
    return other.get(event.kind, "{}.").format(deed(event.action or "continue"))


def dashboard_words(kind: str, name: str) -> str:
    """Return a phrase of `grammars/dashboard.toml`."""
    return _table()[kind][name]


def _told(said: Message) -> str:
    """Return a message as a sentence."""
    return capitalise(sentence(_said(fill(grammar(), said))))


def _said(tokens: tuple[Token, ...]) -> str:
    words, _ = inflect(tokens, SpeechContext())
    return join(words)


@cache
def _table() -> Mapping[str, Mapping[str, str]]:
    return tomllib.loads(files("grammars").joinpath("dashboard.toml").read_text(encoding="utf-8"))
