"""Others: questions about other road users whose words leave open what is asked."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Claim,
    Doing,
    HowLong,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Question,
    When,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    SOMEBODY_ELSE,
    Ago,
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Is,
    Measured,
    Not,
    Now,
    Pronoun,
    Proposition,
    Rank,
    Related,
    Thing,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import Bearing, Relation
from xavi_dialogue.nlu.grounding.completion.discussion import events, explained
from xavi_dialogue.nlu.grounding.context import Context, Grounder

_VAGUE: Final = ("it", "that", "this")
#: Where somebody is of whom a relation to us holds.
BEARINGS: Final[dict[Relation, Bearing]] = {
    "ahead-of": "ahead", "behind": "behind", "left-of": "left", "right-of": "right",
    "beside": "beside", "oncoming-to": "oncoming", "near": "around",
}  # fmt: skip
_MOVING_IT: Final = ("speed-up", "slow-down", "change-plan", "do", "move")  # "what raised it?"
#: What one does who does not come nearer.
_PARTING: Final = ("go", "come", "move", "leave", "disappear", "slow-down", "speed-up")
EARLIER: Final = 3.0  # [s] ago, with which it is compared how far somebody is
_CHANGING: Final = ("change-plan", "change-lane", "change-left", "change-right")

_PAST_OTHERS: Final = ("overtake", "change-left", "change-right", "change-lane")


def _last_seen(who: Thing, g: Grounder) -> Question:
    """Ask when somebody went out of view, or whether he is seen, who still is."""
    found = g.thing(who, g.window(Unsaid(), "past"))
    if isinstance(found, Vehicle) and found.number in g.context.in_view(g.context.now):
        return Whether(Related("can-see", Ego(), found, Now(), "present"))
    return When(Happens(Event("disappear", found)))


def _tailgating(spoken: Question) -> Question | None:
    """Ask whether somebody is too close, for "is he tailgating us?"."""
    match spoken:
        case Whether(that=Happens(event=Event("follow", who, whom, tense="present") as event)) if (
            "close" in event.manner and whom is not None
        ):
            known = who if getattr(who, "definite", True) else Described(bearing="behind")
            other = known if isinstance(whom, Ego) else whom
            return replace(spoken, that=Is("close", other, too=True, tense="present"))
    return None


def of_others(spoken: Question, g: Grounder) -> Question | None:
    """Put the question that is meant in the place of one about others; None: it is another one."""
    meant = _reworded(spoken, g) or _tailgating(spoken) or _as_fast(spoken, g)
    if meant is not None:
        return meant
    match spoken:
        case When(Related("can-see", Ego(), who, Rank(rank=-1))):
            return _last_seen(who, g)
        case HowSure(of=Related(relation="can-see", thing=thing) as seen) if thing != Ego():
            return Whether(seen)  # no chance is held of what others see
        case HowSure(of=Happens(event=Event("do", actor, None))) if not isinstance(actor, Ego):
            spoken_of = any(isinstance(e.actor, Vehicle) for e in events(g.context.discourse))
            return None if spoken_of else HowSure(Related("near", actor, Ego()), spoken.time)
        case Whether(that=Happens(event=Event("go", actor, Feature(kind="way")) as event)):
            ours = isinstance(actor, Ego)
            return Whither() if ours else Whether(Related("with", actor, Ego(), event.time))
        case (
            Whether(that=Happens(event=Event(action=action, actor=Pronoun(form=form), object=None)))
            | Why(of=Happens(event=Event(action=action, actor=Pronoun(form=form), object=None)))
        ) if action in _CHANGING and form in _VAGUE and _about_belief(g.context):
            g.notes.leaned = True
            return HowSure(changed=True)  # "has that changed since?"
        case Whether(
            that=Related(
                relation=relation, thing=Described(definite=False, bearing=None) as thing, to=Ego()
            ) as of
        ) if relation in BEARINGS:  # "anyone still behind us?"
            thing = replace(thing, bearing=BEARINGS[relation])
            return replace(spoken, that=Exists(thing, of.time, of.tense))
        case Which(such=Happens(event=Event(action=action, actor=Wanted(), object=Pronoun()))) if (
            action in _MOVING_IT and _about_belief(g.context)
        ):
            g.notes.leaned = True
            asked = g.context.discourse.question
            return HowSure(asked.of if isinstance(asked, HowSure) else None, changed=True)
        case Whether(
            that=Is(
                state="allowed", event=Event(action=action, actor=Ego(), tense="present") as event
            )
        ) if action in _PAST_OTHERS:
            return Why(Not(Happens(event)))  # "are we allowed to overtake?": what keeps us
        case Identify(thing=Described("vehicle", doing=Event("do", actor, Wanted()))):
            return Doing(actor, tense="past")  # "what was the last thing it did?"
        case Whether(that=Happens(event=Event("keep-distance", Ego(), whom) as event)) if (
            isinstance(whom, Described | Pronoun | Vehicle)
        ):
            if event.tense == "future":  # "will you leave him plenty of room?"
                nearest = Measured("distance", Ego(), whom, time=WholeRide(), tense="future")
                return HowMuch(nearest, "lowest")
            if event.tense == "present":  # "are you keeping well back from him?"
                return Whether(Not(Is("close", whom), lexical=True))
    return _how_long_there(spoken)


def _as_fast(spoken: Question, g: Grounder) -> Question | None:
    """Read "why can't we do that?", after a question for the speed of another, of our speed."""
    match spoken:
        case Why(
            of=Not(content=Happens(event=Event("do", Ego(), Pronoun() | None, tense=tense)))
        ) if _paced_other(_spoken_of(g)):
            g.notes.leaned = True
            return Why(Is("slow", Ego(), tense=tense))
    return None


def _spoken_of(g: Grounder) -> Question | None:
    """Give the question under discussion, or whether what was stated last is so."""
    discourse = g.context.discourse
    told = [act.that for act in discourse.last_acts if isinstance(act, Claim)]
    return Whether(told[-1]) if told else discourse.question


def _paced_other(question: Question | None) -> bool:
    """Tell whether it was asked how fast another drives, or whether he drives fast or past."""
    match question:
        case HowMuch(of=Measured(attribute="speed", thing=Vehicle(), to=None)):
            return True
        case Whether(that=Compares(left=Measured(attribute="speed", thing=Vehicle()))):
            return True
        case Whether(that=Is(state="fast", thing=Vehicle())) | Why(of=Is("slow", Ego())):
            return True
        case Whether(that=Happens(event=Event(action=action, actor=Vehicle()))):
            return action in ("pass", "overtake", "speed-up")
    return False


def _how_long_there(spoken: Question) -> HowLong | None:
    """Ask how long somebody stands by somebody else of how long he is there."""
    match spoken:
        case HowLong(of=Event("stand", Ego(), where=Related(), tense="past") as event):
            return HowLong(replace(event, where=None))  # "how long did we stand behind him?"
        case HowLong(of=Event("stand", actor, where=Related() as where) as event) if not isinstance(
            where.to, Feature
        ):
            beside = replace(where, thing=actor, time=event.time, tense=event.tense)
            return HowLong(beside)  # "how long has he been sitting beside us?"
    return None


def _is_done_to(deed: Event) -> bool:
    """Say whether we did or had to do something to others; whom we met is another question."""
    past = deed.tense in ("past", "perfect") and deed.modal in (None, "must")
    return past and deed.action != "approach"


def _reworded(spoken: Question, g: Grounder) -> Question | None:
    """Read who is aboard or hidden, to whom we yield, and whether somebody comes nearer."""
    match spoken:
        case Whether(that=Is(state="hidden", thing=Described(definite=False) as thing) as of) if (
            thing in (Described(definite=False), SOMEBODY_ELSE)
        ):
            return Which(Wanted(), replace(of, thing=Wanted()))  # "was anyone hidden from you?"
        case Which(
            thing=Described(plural=True) as thing,
            such=Happens(event=Event(actor=Ego(), object=Wanted(), time=Unsaid()) as deed),
        ) if _is_done_to(deed):
            such = Happens(replace(deed, time=WholeRide(), modal=None))  # "which did we pass?"
            named = Described(thing.kind, plural=True)
            plain = thing in (named, replace(named, definite=False))
            return replace(spoken, thing=Everyone(thing.kind) if plain else thing, such=such)
        case Whether(
            that=Exists(
                thing=Described(
                    "pedestrian", such=Related(relation="on" | "near" | "with", to=aboard)
                )
            )
        ) if isinstance(aboard, Described | Pronoun | Vehicle):
            return HowMuch(Measured("occupant", aboard))  # "are there kids in it?"
        case Whether(
            that=Related(relation="on", thing=Described("vehicle", definite=False), to=aboard)
        ) if isinstance(aboard, Described | Pronoun | Vehicle):
            return HowMuch(Measured("occupant", aboard))  # "is anybody in it?"
        case Listing(of="events", event=Event("give-way" | "let-go", Ego(), None) as event) if (
            event.modal in ("must", "should")
        ):  # "list the vehicles you are obliged to yield to"
            owed = replace(event, object=Wanted(), tense="present", modal="must")
            return Which(Wanted(), Happens(owed))
        case Whether(that=Both(contents=contents, join="or")) if (
            moved := _nearer_or_farther(contents, g)
        ) is not None:
            return replace(spoken, that=moved)
    return None


def _nearer_or_farther(contents: tuple[Proposition, ...], g: Grounder) -> Both | None:
    """Read "is it coming nearer or going away" as a question for how far it is and was."""
    nearing = [p for p in contents if isinstance(p, Happens) and p.event.action == "approach"]
    if len(nearing) != 1 or len(contents) != 2 or nearing[0].event.tense != "present":
        return None
    event = nearing[0].event
    other = contents[1] if contents[0] is nearing[0] else contents[0]
    match other:
        case Happens(event=Event(action=action, tense="present")) if action in _PARTING:
            pass
        case Is(state="far"):
            pass
        case _:
            return None
    whom = event.object if isinstance(event.actor, Ego) else event.actor
    if not isinstance(whom, Described | Pronoun | Vehicle):
        return None
    whom = g.thing(whom, g.window(Unsaid(), "present"))  # the same one now and before
    now = Measured("distance", whom, Ego())
    before = replace(now, time=Ago(EARLIER), tense="past")
    return Both((Compares(now, "less", before), Compares(now, "more", before)), "or")


def _about_belief(context: Context) -> bool:
    """Tell whether it was asked just now what is expected of somebody."""
    asked = context.discourse.question
    beliefs = isinstance(asked, Listing) and asked.of == "beliefs"
    return beliefs or isinstance(asked, HowSure)


def no_cause_sought(blamed: Thing, context: Context) -> bool:
    """Tell whether "was it the bus?" is rather of who it is, and "the blue one" of its colour."""
    coloured = isinstance(blamed, Described) and blamed == Described(colour=blamed.colour)
    return asked_who(context) or (coloured and explained(context) is None)


def asked_who(context: Context) -> bool:
    """Tell whether it was asked just now who or where somebody is, so that no cause is sought."""
    asked = context.discourse.question
    placed = isinstance(asked, Which | Whether) and first(asked, (Related, Exists)) is not None
    return placed or isinstance(asked, Identify | Where | Whither | Doing)


def still_here(spoken: Question, g: Grounder) -> Question | None:
    """Read "why are we still here?" as why we stand, where we do; None for other questions."""
    match spoken:
        case Why(of=Happens(event=Event("keep-lane", Ego(), None, tense="present") as event)):
            now = g.context.now
            deeds = g.context.deeds(Ego(), now, now)
            if any(e.action in ("stop", "stand") and e.end is None for e in deeds):
                return replace(spoken, of=Happens(replace(event, action="stand")))
    return None
