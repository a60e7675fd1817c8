"""Recalling: questions that set what came against what was expected, or ask on what it rests.

"Did he go where you thought?" is one question, and so is "who had priority, and on what basis?".
"Which one was the slowest?" is of our deeds where these were counted.
"""

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Compare,
    HowKnow,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Question,
    Where,
    Whether,
    Which,
    Whither,
)
from xavi_dialogue.domain.terms import (
    Believed,
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Measured,
    Not,
    Pronoun,
    Proposition,
    Related,
)
from xavi_dialogue.nlu.compose.clauses.peaks import outstanding

_PRIORITY = frozenset({"has-priority-over", "must-yield-to"})


def recalled(before: Act, later: Act) -> Act | None:
    """Read two acts as one question about what was expected; None where they are none."""
    question = later.question if isinstance(later, Ask) else None
    asked = before.question if isinstance(before, Ask) else None
    found = _as_expected(asked, question) or _grounds(asked, question) or _guessed(asked, question)
    if found is None and isinstance(before, Claim):
        found = _as_expected(Whether(before.that, tag=True), question)
        found = found or _changed(before.that, question)
    if found is None and isinstance(later, Claim):
        found = _reasons_of(asked, later.that)
    return None if found is None else Ask(found)


def _reasons_of(asked: Question | None, told: Proposition) -> Question | None:
    """Ask for the reasons of what we are said to have done: "list the reasons you stopped"."""
    match asked, told:
        case (
            Listing(of="reasons", about=None, event=None),
            Happens(event=Event(actor=Ego(), tense="past" | "perfect") as deed),
        ):
            return structs.replace(asked, event=deed)
    return None


def of_deeds(before: Act, act: Act) -> Act:
    """Ask which of our deeds it was: "how many turns did we make, and which was the slowest?"."""
    match before, act:
        case Ask(question=HowMany(of=Event() as deed)), Ask(question=question):
            peak = outstanding(deed, _standing_out(question))
            return act if peak is None else Ask(peak)
    return act


def _standing_out(question: Question) -> str | None:
    """Give by what one of those spoken of is asked for; None where others are asked for."""
    match question:
        case Identify(thing=Described(extreme=extreme, definite=definite) as one):
            return extreme if one == Described(extreme=extreme, definite=definite) else None
        case HowMuch(of=Measured("speed", Everyone(kind="vehicle")), extreme=extreme):
            return {"lowest": "slowest", "highest": "fastest"}.get(extreme or "")
        case Compare(options=(Pronoun("them-all"),), by="speed", least=least):
            return "slowest" if least else "fastest"
    return None


def _as_expected(asked: Question | None, later: Question | None) -> Question | None:
    """Read "did he do what you expected?", "is he going where we are going?"."""
    match asked, later:
        case Whether(
            that=Happens(event=Event(action="do" | "go", object=None, side=None) as event)
        ), (Listing(of="beliefs", about=None) | Where(of=Ego()) | Whither(actor=Ego())) if (
            not isinstance(event.actor, Ego)
        ):
            if event.tense in ("past", "perfect") and not isinstance(later, Whither):
                return Whether(Is("right", event.actor, tense="past"))
            if isinstance(later, Whither):
                return Whether(Related("with", event.actor, tense=event.tense))
    return None


def _grounds(asked: Question | None, later: Question | None) -> Question | None:
    """Read "who had priority, and on what basis?": the second asks what the first rests on."""
    match asked, later:
        case (
            (
                Which(such=Related(relation=relation) as of)
                | Whether(that=Related(relation=relation) as of)
            ),
            HowKnow(of=None),
        ) if relation in _PRIORITY:
            return HowKnow(of)
        case Which(
            such=Happens(event=Event(action="go", manner=("first",), object=other))
        ), HowKnow(of=None):
            return HowKnow(Related("has-priority-over", Ego(), other or Everyone()))
    return None


def _guessed(asked: Question | None, later: Question | None) -> Question | None:
    """Read "which one are we letting go, is it the red one?" as one question."""
    match asked, later:
        case Which(such=such), Whether(that=Related(relation="same-as", thing=Pronoun())) if (
            such is not None
        ):
            return asked
        case Whether(that=Believed(tense="past") | Not(content=Believed(tense="past"))), HowKnow():
            return asked  # "did you know, or were you guessing?"
    return None


def _changed(told: Proposition, later: Question | None) -> Question | None:
    """Read "so it went left. When did your belief change?" as asked of what is stated."""
    match told, later:
        case Happens(event=event), HowSure(of=None, changed=True) if not isinstance(
            event.actor, Ego
        ):
            return structs.replace(later, of=told)
    return None
