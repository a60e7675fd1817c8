"""Wishes: how the passenger would like us to drive, said otherwise than by an order."""

from typing import Any, Final, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import Act, Request
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Happens,
    Is,
    Junction,
    Measured,
    Not,
    Passenger,
    Proposition,
)
from xavi_dialogue.domain.vocabulary import BEYOND, ActionName
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.flags import ALIGHTING
from xavi_dialogue.nlu.compose.clauses.sem import Measure

CONTRARY: Final[dict[str, ActionName]] = {"fast": "slow-down", "slowly": "speed-up"}
_PACED: Final = frozenset({"go", "move", "continue", "speed-up", "slow-down", "stop"})
#: What a bare comparison asks for: "gentler, please".
_WANTED: Final[dict[str, ActionName]] = {
    "comfortable": "slow-down", "slow": "slow-down", "safe": "slow-down", "fast": "speed-up",
    "far": "keep-distance",
}  # fmt: skip


def alights(clause: Clause) -> bool:
    """Check whether it is the passenger who gets out, or off: "I want to get out here"."""
    off = any(leaf.key in ("out", "off") for leaf in clause.particles)
    verb = None if clause.verb is None else clause.verb.key
    return off and verb in ALIGHTING and isinstance(clause.subject, Passenger)


def bidden(event: Event, clause: Clause) -> Event:
    """Give the deed that is asked for, whatever the verb form; "another lap" goes round again."""
    again = "again" in event.manner and any(p.key == "around" for p in clause.particles)
    if alights(clause):
        event = Event("drop-off", object=Passenger())
    lap = event.action == "do" and isinstance(event.object, Junction)
    if lap or (again and event.action in ("go", "move")):
        event = structs.replace(event, action="circle", object=None, manner=())
    actor = Ego() if isinstance(event.actor, Passenger) else event.actor
    return structs.replace(event, actor=actor, tense="present", modal=None)


def request(event: Event, clause: Clause, *, negated: bool = False) -> Request:
    """Give the request for a deed, or not to do it: "not so fast" is to slow down."""
    deed = bidden(event, clause)
    compared = [_WANTED[key] for key, _ in clause.comparisons if key in _WANTED]
    if compared and not negated and deed.action in _PACED:  # "go a bit more gently"
        return Request(Event(compared[0], tense="present"))
    if not negated:
        return Request(deed)
    paced = [m for m in deed.manner if m in CONTRARY]
    if paced and deed.action in _PACED:
        return Request(Event(CONTRARY[paced[0]], tense="present"))
    if deed.action == "approach":
        return Request(Event("keep-distance", Ego(), deed.object, tense="present"))
    return Request(deed, negated=True)


def requests(event: Event, clause: Clause, *, negated: bool = False) -> tuple[Act, ...]:
    """Give the requests for a deed and for what is to follow: "honk and drive on" is two."""
    then = event.then
    if negated or then is None or event.action not in BEYOND:
        return (request(event, clause, negated=negated),)
    return request(structs.replace(event, then=None), clause), Request(bidden(then, clause))


def pace_of(clause: Clause, event: Event) -> Request | None:
    """Give the request in how something is to be taken: "take the next one slower"."""
    compared = [_WANTED[key] for key, _ in clause.comparisons if key in _WANTED]
    taken = event.object is not None and event.action == "do"
    return Request(Event(compared[0], tense="present")) if compared and taken else None


def paced(of: Proposition | None) -> Request | None:
    """Give the request in a wish about our speed: "go at sixty", "not faster than sixty"."""
    match of:
        case Not(content=content):
            inner = paced(content)
            if inner is None:
                return None
            swapped: ActionName = "slow-down" if inner.event.action == "speed-up" else "speed-up"
            return Request(Event(swapped, tense="present"))
        case Is(state="fast" | "slow" as pace, thing=Ego() | None):
            return Request(Event("speed-up" if pace == "fast" else "slow-down", tense="present"))
        case Compares(left=Measured(attribute="speed" | "limit", thing=Ego()), comparator=more):
            if more == "same":
                return None
            slower = more in ("less", "at-most")
            return Request(Event("slow-down" if slower else "speed-up", tense="present"))
    return None


def wished(of: Proposition, clause: Clause, *, wishing: bool) -> Act | None:
    """Read "I want to wait", "I would rather you waited" as a request.

    Args:
        of: what is stated.
        clause: the clause.
        wishing: words before it tell that it is a wish.
    """
    content, negated = (of.content, True) if isinstance(of, Not) else (of, False)
    if not isinstance(content, Happens) or not isinstance(content.event.actor, Ego | Passenger):
        return paced(of) if wishing else None
    event = content.event
    own = event.modal == "want" and (event.tense == "present" or alights(clause))
    own = own and isinstance(clause.subject, Passenger)
    if not (wishing or own) or (event.action == "do" and not negated):
        return None
    return request(event, clause, negated=negated)


def bare_wish(clause: Clause, *, polite: bool) -> Act | None:
    """Read "a bit gentler, please", "not so fast", "more distance, please"."""
    if clause.negated and len(clause.manner) == 1 and clause.manner[0] in CONTRARY:
        return Request(Event(CONTRARY[clause.manner[0]], tense="present"))
    if not polite:
        return None
    compared = [_WANTED[key] for key, _ in clause.comparisons if key in _WANTED]
    sem = clause.objects[0][0] if len(clause.objects) == 1 else None
    if isinstance(sem, Measure) and sem.of.attribute in ("gap", "distance"):
        return Request(Event("keep-distance", Ego(), sem.of.to, tense="present"))
    if compared and not clause.objects:
        return Request(Event(cast(Any, compared[0]), tense="present"))
    return None
