"""Told: questions of yes or no, by all that their clauses say."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Act, Ask, Claim, HowMany, Question, Whether, Why
from xavi_dialogue.domain.terms import (
    Both,
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Lane,
    Nobody,
    Not,
    Now,
    Pronoun,
    Proposition,
    Related,
    Relative,
    Unknown,
    WholeRide,
)
from xavi_dialogue.nlu.compose.alternatives.blames import causes_named
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import as_thing
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.compose.refining.asked import WHEN_WE_GO
from xavi_dialogue.nlu.compose.refining.sounds import sound_asked
from xavi_dialogue.nlu.compose.refining.turns import turns_left

_HELD: Final = frozenset(("wait", "stop", "stand", "brake", "slow-down", "give-way"))
_AHEAD: Final = Described(bearing="ahead", definite=False)
ALONE_AHEAD: Final = Related("ahead-of", Nobody())
_WORST: Final = ("danger", "highest", "risk", "trouble")  # what is over where it is safe
_INSIDE: Final = ("in", "into")
_FOR: Final = ("for", "to", "into")


def refined_whether(clause: Clause, question: Question) -> Question:
    """Return what a question of yes or no asks for by the slots of its clause."""
    match question:
        case Whether(Not(Exists(thing))) if thing == _AHEAD:
            return replace(question, that=ALONE_AHEAD)  # "is there nobody in front of us?"
        case Whether(Is("over", Unknown(words)) | Related("behind", Unknown(words), Ego())) if (
            words in _WORST
        ):  # "is the worst over?"
            return replace(question, that=Is("safe", time=Now()))
        case Whether(Related("on", Ego(), Feature(kind="queue") as queue)) if any(
            c.key in _INSIDE for c in clause.complements
        ):
            return Whether(Exists(queue))  # "are we in a traffic jam?"
        case Whether(
            Happens(
                Event(
                    "go",
                    Ego(),
                    time=Relative("during" | "after", Event("turn-colour")),
                    tense="future" | "present",
                )
            )
        ):
            return WHEN_WE_GO  # "will we be able to go when it goes green?"
        case Whether(Both((Happens(Event() as first), Happens(Event() as other)), "or")):
            return _either(first, other, clause) or question
        case Whether(Is("allowed", event=Event("go", Ego()) as event)):
            return Whether(Happens(replace(event, modal="can")))  # "do we get to go now?"
        case Whether(
            Related("on", Ego(), Lane(which), tense="present")
            | Not(Related("on", Ego(), Lane(which), tense="present"))
        ) as asked:
            fits = _fitting(clause, which)
            if fits is not None and isinstance(asked.that, Not):
                fits = fits.content if isinstance(fits, Not) else Not(fits)
            return question if fits is None else replace(asked, that=fits)
    return only_one(clause) or sound_asked(clause, question) or question


def _either(first: Event, other: Event, clause: Clause) -> Why | None:
    """Read "are you waiting for him or for the light?" as which of two is the reason."""
    held = first.action in _HELD and first.actor == Ego() and first.action == other.action
    causes = causes_named(clause) if held else None
    if causes is not None and first.object is None:  # "for the turn or for the bus?"
        return Why(Happens(first), suspect=causes[0], rival=causes[1])
    rival = other.object if other.actor == Ego() else None  # "or did he?" asks of him
    if not held or first.object is None or rival is None:
        return None
    deed = replace(first, object=None)
    return Why(Happens(deed), suspect=first.object, rival=rival)


def refined_claim(claim: Claim) -> Claim:
    """Return what a statement claims: "there is nobody in front of us" is of our way."""
    return replace(claim, that=ALONE_AHEAD) if claim.that == Not(Exists(_AHEAD)) else claim


def only_one(clause: Clause) -> HowMany | None:
    """Read "was that the only stop?", "any more turns?" as how many there are."""
    if (turns := turns_left(clause)) is not None:
        return turns
    shown = isinstance(clause.subject, Pronoun) and clause.verb is None
    if "only" not in clause.focus or not shown:
        return None
    for sem, _ in clause.objects:
        if isinstance(sem, Event) and isinstance(sem.actor, Ego):
            return HowMany(replace(sem, time=WholeRide()))
    return None


def _fitting(clause: Clause, which: str) -> Proposition | None:
    """Read "are we in the right lane for the exit?" as whether our lane is the one to be in."""
    lanes = [(c.key, c.sem, c.node) for c in clause.complements]
    lanes += [("", sem, node) for sem, node in clause.objects]
    node = next((node for _, sem, node in lanes if isinstance(as_thing(sem), Lane)), None)
    if node is None:
        return None
    said = {leaf.key for leaf in leaves_of(node)}
    aim = clause.infinitive or clause.question
    for_what = aim or any(key in _FOR and sem != Ego() for key, sem, at in lanes if at is not node)
    fits = Is("right", Lane())
    if said & {"wrong", "wrong-lane"}:
        return Not(fits)
    return (
        fits
        if said & {"right", "best", "fitting-lane"} or (which == "right" and for_what)
        else None
    )


def lit_now(clause: Clause) -> tuple[Act, ...] | None:
    """Read "now is green, why not go?" as a claim about the light, and a question beside it."""
    match clause.subject:
        case Described(colour="red" | "green" | "amber" as lit) as named if (
            named == Described(colour=lit) and clause.verb is None and clause.has("be")
        ):
            asked = (q for q in _embedded(clause) if isinstance(q, Why))
            why = next(asked, None)
            told = Claim(Has("colour", lit, Pronoun("it")))
            return None if why is None else (told, Ask(why))
    return None


def _embedded(clause: Clause) -> list[Question]:
    """Return the questions that stand in a clause."""
    return [] if clause.question is None else list(clause.question[1])
