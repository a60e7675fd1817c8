"""Taking: the deed that is meant where its object makes it another: an exit, a turn, a gap."""

from xavi_dialogue.domain.terms import Event, Exit, Feature, Junction, Thing
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Sem, SideOf, as_thing
from xavi_dialogue.nlu.compose.clauses.senses import Match

_INTO = frozenset({"head", "enter", "go"})
_APART = frozenset({"gap", "distance"})


def is_gap(sem: Sem | None) -> bool:
    """Say whether somebody may drive into it: a gap, a hole, an opening."""
    if isinstance(sem, Measure):
        return sem.of.attribute in _APART
    return isinstance(sem, Feature) and sem.kind == "space"


def meant(
    action: str, side: str | None, thing: Thing | None, match: Match
) -> tuple[str, str | None, Thing | None]:
    """Put the deed that is meant in the place of one that its object makes another."""
    if action == "take-turn":
        return taken(match.object, side)
    if action in _INTO and is_gap(match.object):
        return "go", side, None  # "take that opening"
    if action == "continue-next-exit" and isinstance(match.object, Event):
        return action, None, Exit()  # "miss the turn"
    if action == "take-exit":
        return "leave", side, thing
    if action == "stop" and isinstance(match.object, Event):
        return action, side, as_thing(match.phrases.get("for"))  # "come to a stop for him"
    if action == "let-go" and isinstance(thing, Feature):
        whom = match.phrases.get("for")
        action = "give-way" if whom is None else "let-go"
        thing = as_thing(whom or match.phrases.get("into"))
    return action, side, thing


def taken(sem: Sem | None, side: str | None) -> tuple[str, str | None, Thing | None]:
    """Read what is taken: "take the left turn", "take the second junction"."""
    if isinstance(sem, Event):
        return sem.action, sem.side, sem.object
    if isinstance(sem, SideOf):
        return f"exit-{sem.side}", None, None
    if isinstance(sem, Junction) and side in ("left", "right"):
        return f"exit-{side}", None, sem
    return "turn", side, as_thing(sem)
