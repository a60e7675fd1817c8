"""Tallies: "you changed lanes three times", "I counted four we had to wait for": a number said."""

from typing import Any, cast

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import HowMany
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Event,
    Exit,
    Happens,
    Measured,
    Not,
    Pronoun,
    Proposition,
    Quantity,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Moment, Noun, Sem
from xavi_dialogue.nlu.compose.clauses.tree import leaf_of, node_of, number_of, words_of
from xavi_dialogue.nlu.grammar.chart import Node, Part

#: What is done to each of several: "we waited for four cars".
_DONE_TO = frozenset({"wait", "give-way", "let-go", "overtake", "pass", "follow", "stop"})
_OFTEN = {"twice": 2, "thrice": 3}
_MANY = frozenset({"many", "several"})
_TURNS = frozenset(
    {"turn", "exit-left", "exit-right", "change-left", "change-right", "change-lane"}
)


def tallied(clause: Clause, of: Proposition) -> Proposition:
    """Read a deed with a number as how often it was done, or to how many."""
    if isinstance(of, Not):
        return of
    if not isinstance(of, Happens) or of.event.tense not in ("past", "perfect"):
        return of
    event = replace(of.event, manner=tuple(m for m in of.event.manner if m != "already"))
    times = clause.times or next((_OFTEN[w] for w in clause.focus if w in _OFTEN), None)
    if times is not None:
        return _compared(Measured("count", event.actor, event=event), times)
    done = of.event.object
    if of.event.action not in _DONE_TO or not isinstance(done, Described) or done.definite:
        return of
    if (done.number or 0) < 2:
        return of
    return among(replace(done, doing=replace(of.event, object=Wanted()))) or of


def among(counted: Sem | None, part: Part | None = None) -> Proposition | None:
    """Read "four cars we waited for", "three lane changes" as how many there were."""
    if isinstance(counted, Event):
        number = _number(part)
        if number is None:
            return None
        return _compared(Measured("count", counted.actor, event=counted), number)
    if not isinstance(counted, Described) or counted.number is None or counted.doing is None:
        return None
    event = counted.doing
    if event.modal == "must":
        event = replace(event, modal=None, tense="past")
    thing = replace(counted, doing=event, number=None, plural=True, definite=False)
    return _compared(Measured("count", thing, tense="past"), counted.number)


def exits_passed(clause: Clause, of: Proposition) -> Event | None:
    """Read "did we go past any exits" as how many; that of ours is asked about by itself."""
    match of:
        case Happens(event=Event(action="pass", actor=Ego(), object=Exit(None, None)) as event):
            nodes = [node for _, node in clause.objects] + [c.node for c in clause.complements]
            words = {word for node in nodes for word in words_of(node).split()}
            return event if words & {"any", "an", "some"} else None
    return None


def counts(clause: Clause) -> Proposition | None:
    """Read "I counted four", "that makes three lane changes", "that was three stops"."""
    verb = "" if clause.verb is None else clause.verb.key
    if verb not in ("count", "make", "") or not clause.objects or clause.negated:
        return None
    if not verb and not isinstance(clause.subject, Pronoun):
        return None
    last = clause.objects[-1][0]
    if isinstance(last, Noun) and last.key == "time" and isinstance(last.clause, Happens):
        event = last.clause.event  # "that is the second time we stopped"
        stopped = event.action == "block" and event.object == Wanted()
        free = None if isinstance(event.object, Wanted) else event.object
        action = "stop" if stopped else event.action
        event = replace(event, action=action, object=free, tense="past")
        return _compared(Measured("count", event.actor, event=event), last.number)
    return among(*clause.objects[-1])


def frequency(node: Node, clause: Clause) -> None:
    """Note how often it is said to be, "three times"; "the most time" is an amount."""
    said = node_of(node, "num")
    many = leaf_of(node, "DET")
    if many is not None and many.words[-1] == "most":
        clause.objects.append((Moment("s"), node))
    elif many is not None and many.words[-1] in _MANY:
        clause.focus.add("often")
    else:
        clause.times = None if said is None else int(number_of(said))


def how_often(clause: Clause, of: Proposition) -> HowMany | None:
    """Take "do we turn many times" for how many turns are to come, "did we" for how many were."""
    if "often" not in clause.focus or not isinstance(of, Happens):
        return None
    event = of.event
    if event.tense in ("past", "perfect"):
        return HowMany(event)
    ours = isinstance(event.actor, Ego) and event.action in _TURNS
    return HowMany(replace(event, tense="future", modal=None)) if ours else None


def _compared(measured: Measured, number: int) -> Compares:
    return Compares(measured, "same", Quantity(float(number)))


def _number(part: Part | None) -> int | None:
    """Find the number before a noun."""
    if not isinstance(part, Node):
        return None
    for inner in part.parts:
        if isinstance(inner, Node):
            if inner.name in ("counted", "num"):
                found = inner if inner.name == "num" else node_of(inner, "num")
                return None if found is None else int(number_of(cast(Any, found)))
            if (number := _number(inner)) is not None:
                return number
    return None
