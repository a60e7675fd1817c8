"""Worded: questions whose words say more than the term that the grammar makes of them.

"What was the fastest car so far?" is of the whole ride, "now is green, why not go?" of the light.
"""

from typing import Any, Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Compare,
    Doing,
    HowLong,
    HowMany,
    HowMuch,
    Identify,
    Listing,
    Question,
    When,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Back,
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Junction,
    Measured,
    Next,
    Not,
    Pronoun,
    Record,
    Related,
    Vehicle,
    Wanted,
    WholeRide,
)

#: Words with which one of all is asked for, and not one of those in view.
_SO_FAR: Final = frozenset(("was", "far", "ever", "seen", "met", "yet", "ride", "trip", "been"))
_PARTS: Final = frozenset(("part", "parts", "bit", "bits", "area", "areas", "road", "street"))
_LASTED: Final = frozenset(("took", "take", "takes", "cost", "costs", "lasted"))
_QUEUES: Final = frozenset(("queue", "jam", "line", "tailback", "row"))
_GET_TO: Final = frozenset(("get", "gets"))


def worded(question: Question, words: str) -> tuple[Act, ...] | None:
    """Give the acts that the words of a question come to; None where its term says it all."""
    said = frozenset(words.split())
    found = _listed(question, words, said) or _of_lights_and_deeds(question, words, said)
    return found or _of_waits(question, said)


def _of_waits(question: Question, said: frozenset[str]) -> tuple[Act, ...] | None:
    """Read "what took longer, the light or the people?" as how long we waited for each."""
    match question:
        case Compare(options=options, by="size" | "speed" | "time") if _LASTED & said:
            whom = [one for one in options if isinstance(one, Described | Feature | Vehicle)]
            waits = (Event("wait", Ego(), one, tense="past") for one in whom)
            return tuple(Ask(HowLong(wait)) for wait in waits) if len(whom) > 1 else None
    return None


def _listed(question: Question, words: str, said: frozenset[str]) -> tuple[Act, ...] | None:
    """Read what asks for one of all, for options, or for what is in view or hidden."""
    match question:
        case Identify(
            Described(
                kind=kind,
                extreme="fastest" | "slowest" as pace,
                bearing=None,
                such=None | Related("can-see", Ego(), Wanted()),
            )
        ) if _SO_FAR & said:  # "what was the fastest car so far?"
            which: Any = "highest" if pace == "fastest" else "lowest"
            of = Measured("speed", Everyone(kind), time=WholeRide(), tense="past")
            return (Ask(HowMuch(of, which)),)
        case HowMuch(Measured("turn", time=Back("after"))):
            return (Ask(Doing(Ego(), Next(), "future")),)  # "after this, which direction?"
        case Which(such=Not(Related("can-see", Ego(), Wanted()))) if _PARTS & said:
            return (Ask(Listing("hidden")),)  # "which part of the road can't you see?"
        case Which(Wanted(), Compares(Measured("speed", Wanted()), "more", None)) if (
            words.startswith("what") and "would" in said
        ):
            return (Ask(Listing("options")),)  # "what would have been quicker?"
        case Which(such=Related("on", Wanted(), Record())):
            return (Ask(Listing("vehicles")),)  # "what's on your screen?"
    return None


def _of_lights_and_deeds(
    question: Question, words: str, said: frozenset[str]
) -> tuple[Act, ...] | None:
    """Read what is asked of a light, a crossing, or how often we did something."""
    match question:
        case HowMany(Junction() as of) if words.endswith("are crossing") and of == Junction():
            crossing = Event("cross", Wanted(), tense="present")
            return (Ask(HowMany(Described(doing=crossing, plural=True, definite=False))),)
        case Which(
            Feature(kind="light"),
            Happens(Event("give-way" | "keep-distance" | "do", who, Wanted(), tense=tense)),
        ) if "signal" in said:  # "what signal is it giving?"
            return (Ask(HowMuch(Measured("indicator", who, tense=tense))),)
        case Whether(Related("on", Ego(), Feature(kind="queue") as queue)) if "end" not in said:
            return (Ask(Whether(Exists(queue))),)  # "are we in a traffic jam?"
        case Which(Wanted(), Is("first", Wanted())) if _QUEUES & said:
            queue = Feature("queue")
            return (Ask(Which(Wanted(), Related("on", Wanted(), queue))),)  # "who is first in it?"
        case HowMuch(Measured("colour", Ego()) as of) if {"signal", "light"} & said:
            return (Ask(HowMuch(replace(of, thing=Feature("light")))),)  # "your signal"
        case Why(suspect=Described(colour="red" | "green" | "amber" as lit) as named) as why if (
            named == Described(colour=lit) and f"is {lit}" in words
        ):  # "now is green, why not go?"
            return Claim(Has("colour", lit, Pronoun("it"))), Ask(replace(why, suspect=None))
        case Whether(Is("right", Pronoun(), Event() as deed, tense="past")) if (
            "only" in said
        ):  # "was that the only stop?"
            return (Ask(HowMany(replace(deed, time=WholeRide()))),)
        case Whether(Is("allowed", event=Event(actor=Ego()) as event)) | When(
            Is("allowed", event=Event(actor=Ego()) as event)
        ) if _GET_TO & said:  # "do we get to go now?" is asked of what is possible
            able = Happens(replace(event, modal="can"))
            whether = isinstance(question, Whether)
            return (Ask(Whether(able) if whether else When(able)),)
    return None
