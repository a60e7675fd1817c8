"""Manoeuvres: series of actions as verb phrases, as a passenger would say them."""

from collections.abc import Iterable

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.reasons import Performed
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlg.content.clauses.clauses import doing, episode_clause
from xavi_dialogue.nlg.surface.message import Message
from xavi_dialogue.nlg.surface.tables import word
from xavi_dialogue.nlg.surface.values import Clause, Moment, Tense, Who

CHANGES = frozenset(("change-left", "change-right", "overtake"))
EXITS = frozenset(("exit-left", "exit-right", "exit-straight"))
MOST_PASSED = 2  # maximum of roundabout exits that are counted
_NEXT = "continue-next-exit"
_RING = "passed-exits-"  # before the number of exits of a roundabout that are passed
_BACK = {"change-left": "change-right", "change-right": "change-left"}


def plain(actions: Iterable[str]) -> tuple[str, ...]:
    """Return the actions without repetition, and without going on at the end."""
    kept: list[str] = []
    for action in actions:
        if not kept or kept[-1] != action:
            kept.append(action)
    while len(kept) > 1 and kept[-1] == "continue":
        kept.pop()
    return tuple(kept)


def own_verbs(actions: Iterable[str], against: Iterable[str] = ()) -> tuple[Clause, ...]:
    """Return actions of ours as verb phrases to be inflected.

    Args:
        actions: the actions in order.
        against: alternative actions; next to a lane change, going on is staying in the lane.
    """
    row, other = plain(_ringed(tuple(actions))), tuple(against)
    return _row(row, other, ego=True)


def _ringed(actions: tuple[str, ...]) -> tuple[str, ...]:
    """Replace passing exits of a roundabout and leaving it then by their number."""
    first = next((k for k, action in enumerate(actions) if action == _NEXT), len(actions))
    last = next((k for k in range(first, len(actions)) if actions[k] != _NEXT), len(actions))
    if last == len(actions) or actions[last] not in EXITS:
        return actions
    passed = min(last - first, MOST_PASSED)
    return (*actions[:first], f"{_RING}{passed}", *actions[last + 1 :])


def other_verbs(actions: Iterable[str]) -> tuple[Clause, ...]:
    """Return actions of another vehicle as verb phrases to be inflected."""
    row = plain(_ringed(tuple(actions)))
    telling = tuple(action for action in row if action != "continue")
    return _row(telling or row, (), ego=False)


def _row(row: tuple[str, ...], other: tuple[str, ...], *, ego: bool) -> tuple[Clause, ...]:
    past_exit = ego and _NEXT in other[:1] and _NEXT not in row
    lanes = other[:1] != ("stop",) and any(action in CHANGES for action in other)
    phrases: list[str] = []
    for rank, action in enumerate(row):
        phrase = _phrase(action, ego=ego, lanes=lanes)
        if past_exit and action in EXITS and rank == 0:
            phrase = "leave the roundabout right away"
        elif ego and rank and _BACK.get(action) == row[rank - 1]:
            phrases[-1] += " and back again"
            continue
        elif ego and _BACK.get(action) in row[:rank]:
            phrase = "move back again"
        if not phrases or phrases[-1] != phrase:
            phrases.append(phrase)
    return tuple(Clause(Who() if ego else "it", phrase) for phrase in phrases)


def _phrase(action: str, *, ego: bool, lanes: bool) -> str:
    if action.startswith(_RING):
        return str(word("doings", "leaving", action.removeprefix(_RING)))
    if action == "continue" and lanes:
        return doing("keep-lane", ego=ego)
    return doing(action, ego=ego)  # type: ignore[arg-type]


def deed_clause(
    deed: Episode, now: float, *, past: bool | None = None, against: Iterable[str] = ()
) -> Clause:
    """Return what we did or do; against a lane change, going on is staying in the lane."""
    tense: Tense | None = None if past is None else "past" if past else "present"
    if past is False and deed.begin > now + 1.0:
        tense = "future"
    clause = episode_clause(deed, now, tense=tense)
    if deed.action == "continue" and any(action in CHANGES for action in against):
        verb = doing("keep-lane", ego=isinstance(deed.actor, Ego))
        return Clause(clause.subject, verb, (), clause.tense, clause.progressive)
    return clause


def planned_clause(actions: Iterable[str], *, past: bool, against: Iterable[str] = ()) -> Clause:
    """Return that we decided, or plan, to do something."""
    first, *others = own_verbs(actions, against) or (Clause(Who(), doing("continue", ego=True)),)
    rest: tuple[object, ...] = (f"to {first.verb}",)
    rest += tuple(part for one in others for part in (f"and then {one.verb}",))
    if past:
        return Clause(Who(), "decide", rest, "past")
    return Clause(Who(), "plan", rest, "present")


def denial(action: ActionName, *, past: bool) -> Clause:
    """Return that we did not, or are not doing, something."""
    ride = action in ("stand", "move")
    verb = doing(action, ego=True)
    tense: Tense = "past" if past else "present"
    return Clause(Who(ride=ride), verb, (), tense, progressive=not past, negated=True)


def performed(rule: str, done: Performed) -> Message:
    """Return by a rule that we did something, are doing it or plan to do it."""
    time = None if done.time is None else Moment(done.time)
    verbs, kept = own_verbs((done.action,)), done.action == "keep-lane"
    return Message(rule, {"performed": done.when, "fact": verbs, "when": time, "kept": kept})


def last_open(time: float | None) -> tuple[Message, ...]:
    """Return when [s] something was last possible; () if that need not be stated."""
    return () if time is None else (Message("LAST_OPEN", {"when": Moment(time)}),)


def performed_later(done: Performed | None) -> tuple[Message, ...]:
    """Return that the alternative was done later, or is planned; () if neither."""
    return () if done is None else (performed("PERFORMED_LATER", done),)
