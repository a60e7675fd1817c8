"""Worded: questions whose words say more than the term that the grammar makes of them.

"What was the fastest car so far?" is of the whole ride, "now is green, why not go?" of the light.
"""

from typing import Any, Final, cast

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
    Whither,
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
    Lane,
    Measured,
    Next,
    Not,
    Pronoun,
    Record,
    Related,
    Relative,
    Vehicle,
    Wanted,
    WholeRide,
    Within,
)

#: Words with which one of all is asked for, and not one of those in view.
_SO_FAR: Final = frozenset(("was", "far", "ever", "seen", "met", "yet", "ride", "trip", "been"))
_EVER: Final = _SO_FAR - {"was", "been"}
#: Words for some of those spoken of: "which one was the slowest?".
_THOSE: Final = frozenset(("one", "ones", "them", "those", "these"))
_PARTS: Final = frozenset(("part", "parts", "bit", "bits", "area", "areas", "road", "street"))
_LASTED: Final = frozenset(("took", "take", "takes", "cost", "costs", "lasted"))
_QUEUES: Final = frozenset(("queue", "jam", "line", "tailback", "row"))
_SIDED: Final = {"left turns": "exit-left", "right turns": "exit-right"}
_FITTING: Final = frozenset(("correct", "proper", "best"))
_UNFIT: Final = frozenset(("wrong", "incorrect"))
WHEN_WE_GO: Final = Ask(When(Happens(Event("go", Ego(), tense="future", modal="can"))))
#: Words of setting off after a stop.
_SETTING_OFF: Final = (
    "off the line", "off the mark", "set off", "setting off", "get going", "getting going",
    "move off", "moving off", "pull away", "pulling away", "get away", "getting away", "to go",
    "to start", "the start", "start moving", "get moving", "take off",
)  # fmt: skip
_LAST: Final = frozenset(("last", "final"))
_TURNS: Final = frozenset(("turn", "turning"))
_FURTHER: Final = frozenset(("any", "more", "other", "further"))
_GET_TO: Final = frozenset(("get", "gets"))


def worded(question: Question, words: str) -> tuple[Act, ...] | None:
    """Give the acts that the words of a question come to; None where its term says it all."""
    said = frozenset(words.split())
    found = _of_turns(question, words, said) or _listed(question, words, said)
    found = found or set_off_late(question, words) or _of_green(question, said)
    return found or _of_lights_and_deeds(question, words, said) or _of_waits(question, said)


def _of_green(question: Question, said: frozenset[str]) -> tuple[Act, ...] | None:
    """Read "will you go when it turns green?" as when we can go, and the like."""
    match question:
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
            return (WHEN_WE_GO,)
        case Doing(None, Relative("before", Event("go", Ego(), modal="can"))) if {
            "must",
            "has",
            "needs",
            "need",
        } & said:
            return (WHEN_WE_GO,)  # "what has to happen before we can go?"
        case HowMuch(Measured(attribute, Ego(), time=Relative("during", Event("signal")))) if {
            "use",
            "used",
        } & said:
            if attribute != "deceleration":
                return (Ask(HowMuch(Measured(attribute, Ego(), tense="past"))),)
            braked = Event("brake", Ego(), tense="past")
            return (Ask(HowMuch(Measured(attribute, Ego(), event=braked, tense="past"))),)
        case HowLong(Event("stand" | "stop" as action, Ego(), tense="present")) if {
            "before",
            "until",
            "till",
        } & said:  # "how long before we're standing?"
            return (Ask(When(Happens(Event(action, Ego(), tense="future")))),)
    return None


def set_off_late(question: Question, words: str) -> tuple[Act, ...] | None:
    """Read "why so slow off the line?", "what took you so long to go?" as why we did not go."""
    match question:
        case Why(
            Compares(
                Measured("duration", Ego(), time=Relative("during" | "after", Event("turn-colour")))
            )
        ):
            went = Event("go", Ego(), time=Within(None), tense="past")
            return (Ask(Why(Not(Happens(went)))),)
        case Why(
            Compares(Measured("duration", Ego()), "more", None)
            | Is("slow", Ego())
            | Happens(Event("go", Ego(), manner=("slowly",)))
        ) if any(f" {off}" in f" {words}" for off in _SETTING_OFF):
            went = Event("go", Ego(), time=Within(None), tense="past")
            return (Ask(Why(Not(Happens(went)))),)
    return None


def lane_fits(acts: tuple[Act, ...], words: str) -> tuple[Act, ...] | None:
    """Read "are we in the right lane for the exit?" as whether our lane is the one to be in."""
    said = words.split()
    which = next((said[i - 1] for i in range(1, len(said)) if said[i] == "lane"), "")
    for_what = f"{which} lane for " in words or f"{which} lane to " in words
    match acts:
        case (Ask(Whether(Related("on", thing, Lane(), tense="present")) as asked), *others):
            fitting = which in _FITTING or (which == "right" and for_what)
            if thing != Ego() or not (fitting or which in _UNFIT):
                return None
            if not all(isinstance(o, Ask) and isinstance(o.question, Whither) for o in others):
                return None
            fits = Is("right", Lane())
            return (Ask(replace(asked, that=Not(fits) if which in _UNFIT else fits)),)
    return None


def turns_to_come(words: str) -> Ask:
    """Give the question how many turns are to come, to the side that the words tell."""
    side = next((way for told, way in _SIDED.items() if told in words), "turn")
    return Ask(HowMany(Event(cast(Any, side), Ego(), tense="future")))


def _of_turns(question: Question, words: str, said: frozenset[str]) -> tuple[Act, ...] | None:
    """Read "is this the last turn?", "any more left turns?" as how many are to come."""
    match question:
        case Whether(Happens(Event("go", Ego(), manner=("first",), modal="should"))) if (
            _LAST & said and _TURNS & said
        ):
            return (turns_to_come(words),)
        case Whether(
            Exists(Junction(form="junction"), tense="present" | "future")
            | Happens(Event("turn" | "leave", tense="past" | "perfect" | "present"))
        ) if "turns" in said and _FURTHER & said:
            return (turns_to_come(words),)
        case HowMany(Described(doing=Event("turn" | "exit-left" | "exit-right", Wanted()))) if (
            "turns" in said and {"more", "left"} & said
        ):
            return (turns_to_come(words),)  # "how many more turns before we arrive?"
    return None


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
        ) if _SO_FAR & said and (
            said & _EVER or not said & _THOSE
        ):  # "what was the fastest car so far?"
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
        case Which(Described(kind=kind) as one, Compares(Measured("delay", Wanted())) as such) if (
            one == Described(kind)
        ):
            return (Ask(Which(Wanted(kind), such)),)  # "which road user limits our speed?"
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
