"""What browsers read: actions, goals, hold-ups, causes and events in the car's own words."""

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache, lru_cache
from importlib.resources import files
from itertools import groupby

from planner.events import Event
from planner.goals import PLACES
from planner.trace import Action, GoalPrediction, HoldUp
from sim.scene import EGO
from xavi_dialogue.app.narration import narrate
from xavi_dialogue.explain.explanation import Cause
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.contrast import cause_point
from xavi_dialogue.language.doings import LANE_CHANGES, plain
from xavi_dialogue.language.generator import Slot, Token, expand
from xavi_dialogue.language.morphology import Doing, inflect, listed
from xavi_dialogue.language.orthography import capitalise, join
from xavi_dialogue.language.points import Budget
from xavi_dialogue.language.rules import Word, load_grammar

_FULL = Budget(effects=0, causes=1)
_OTHER = EGO + 1  # any vehicle but our own: all others do things in the same words


@cache
def deed(action: str, form: str = "base", *, in_lane: bool = False) -> str:
    """What the ego does, in a verb form: "move to the left lane".

    Args:
        action: of the ego.
        form: base, past, participle or gerund.
        in_lane: a change of lane is the other choice: who goes on stays in the lane.
    """
    return _said((Slot(Doing(EGO, (action,), in_lane=in_lane), form),))


def has_lane_change(actions: Iterable[str]) -> bool:
    """Whether a change of lane is one of the choices."""
    return any(action in LANE_CHANGES for action in actions)


def refusals(
    refused: Iterable[tuple[Action, str]], tried: Iterable[Action]
) -> tuple[tuple[Action, str], ...]:
    """What could not be done, and why, but for what is called like something that was tried.

    "Straight on" is one name for two macro actions, of which one or the other applies.
    """
    names = {deed(action) for action in tried}
    return tuple((action, why) for action, why in refused if deed(action) not in names)


def plan_words(plan: Iterable[Action], *, in_lane: bool = False) -> str:
    """A plan: "move to the left lane, then turn left"; where there is none, the car stops.

    Args:
        plan: of the ego.
        in_lane: see `deed`; of what is done first.
    """
    actions = plain(plan) or ("stop",)
    said = [deed(action, in_lane=in_lane and k == 0) for k, action in enumerate(actions)]
    return ", then ".join(words for words, _ in groupby(said))


@lru_cache(maxsize=1024)  # what others may do comes from elsewhere
def does(actions: tuple[str, ...]) -> str:
    """What another vehicle does: "changes to the right lane and turns right"."""
    said = [_third(_said((Slot(Doing(_OTHER, (action,)), "base"),))) for action in plain(actions)]
    return listed([words for words, _ in groupby(said)])


def goal_words(goal: GoalPrediction) -> str:
    """What a vehicle does that has a goal: "turns left"."""
    if goal.place == PLACES.get(goal.kind):
        return does((goal.kind,))
    return _table()["goal"]["elsewhere"].format(goal.place)


def hold_up_words(how: HoldUp) -> str:
    """How a vehicle is in our way: "cutting in ahead of me"."""
    return _table()["held-up"][how]


def cause_words(cause: Cause, *, of_ours: bool = True) -> str:
    """What a vehicle was expected to do: "will very likely slow down and turn right".

    Args:
        cause: the vehicle.
        of_ours: it is in our way; else it is in another's, and so may we be.
    """
    point, grammar = cause_point(cause, "future", _FULL), load_grammar("answer_passenger")
    if not of_ours:
        point = replace(point, how=None)
    chance = expand(grammar, "LIKELY", min(cause.probability, 1.0))
    if not of_ours and point.doing is None:
        return _table()["held-up-another"]["any"]
    return _said((Word("will"), *chance, *expand(grammar, "DEED", point)))


def way_words(cause: Cause, *, of_ours: bool = True) -> str | None:
    """How a vehicle held us up, or another: "slowing ahead of me, from 42 to 13 km/h"."""
    point = cause_point(cause, "past", _FULL)
    if point.how is None:
        return None
    if not of_ours:
        return _table()["held-up-another"][point.how]
    if point.how in ("collision", "right-of-way"):
        return _table()["held-up"][point.how]
    return _said(expand(load_grammar("answer_passenger"), "HINDRANCE", point))


def checked_words(cause: Cause) -> str | None:
    """What planning again without a vehicle showed, as a sentence; None: it was not tried."""
    point, grammar = cause_point(cause, "past", _FULL), load_grammar("answer_passenger")
    said = _said((*expand(grammar, "NECESSARY", point), *expand(grammar, "DOUBT", point)))
    return capitalise(said) or None


def event_words(event: Event) -> str:
    """An event as a sentence: "I change to the left lane."."""
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
    """A phrase of `grammars/dashboard.toml`."""
    return _table()[kind][name]


def _said(tokens: tuple[Token, ...]) -> str:
    words, _ = inflect(tokens, SpeechContext())
    return join(words)


def _third(phrase: str) -> str:
    """A phrase that begins with a verb's base form, in the third person."""
    verb, _, rest = phrase.partition(" ")
    return f"{verb}{'es' if verb.endswith('o') else 's'} {rest}".strip()


@cache
def _table() -> Mapping[str, Mapping[str, str]]:
    return tomllib.loads(files("grammars").joinpath("dashboard.toml").read_text(encoding="utf-8"))
