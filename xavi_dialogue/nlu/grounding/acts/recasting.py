"""Recasting: questions whose words leave open what is asked, by what goes on and was spoken of.

"How long is this going to take?" asks when we go on where we stand, else when we arrive. "Is that
allowed?" about a speed asks whether it is within the limit. "What happened?" asks of the latest
thing of note.
"""

from typing import Any, Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Compare,
    Doing,
    HowDecide,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Question,
    When,
    Whether,
    Whither,
    Why,
)
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Now,
    Pronoun,
    Proposition,
    Related,
    That,
    Thing,
    Unsaid,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.acts.follow_ups import TURNS, compared, followed
from xavi_dialogue.nlu.grounding.acts.others import of_others, still_here
from xavi_dialogue.nlu.grounding.acts.races import race
from xavi_dialogue.nlu.grounding.acts.trips import SIDES, about_arriving, is_plain_to_see, of_trip
from xavi_dialogue.nlu.grounding.completion.discussion import (
    affirmed,
    asserted,
    beside_road,
    discussed,
    event_of,
    hindrance,
    proposition_of,
)
from xavi_dialogue.nlu.grounding.completion.moving import as_it_was
from xavi_dialogue.nlu.grounding.context import Context, Grounder
from xavi_dialogue.nlu.grounding.events.timing import of_doing
from xavi_dialogue.nlu.grounding.things.lights import among

_LASTING: Final = frozenset(("duration", "waiting-time", "delay"))
_VAGUE: Final = ("it", "that", "this")
FRESH: Final = 4.0  # [s] since when what was begun strikes those who sit in the car
_SUDDEN: Final = frozenset(("brake", "slow-down", "stop", "change-left", "change-right"))
_HALTING: Final = frozenset(("stop", "stand", "wait", "give-way"))
_LIMIT: Final = HowMuch(Measured("limit"))
_KEPT: Final = frozenset(("do", "continue", "keep-distance", "follow"))
_SUCH: Final = Described(plural=True, definite=False)  # "how many are there"
_ANYTHING: Final = (Described(definite=False), Described(kind="car", definite=False))


def recast(spoken: Question, g: Grounder) -> Question:
    """Put the question that is meant in the place of one that its words leave open."""
    spoken = followed(spoken, g)
    if isinstance(spoken, HowSure) and spoken.of is not None and is_plain_to_see(spoken.of):
        spoken = Whether(spoken.of)  # "are you sure that nobody is behind us?"
    meant = (
        _of_limit(spoken, g)
        or race(spoken)
        or of_others(spoken, g)
        or _lasted(spoken, g)
        or still_here(spoken, g)
    )
    meant = meant or of_trip(spoken) or _of_deed(spoken, g) or _of_light(spoken)
    if meant is not None:
        return meant
    match spoken:
        case Doing():
            return of_doing(spoken, g)
        case HowMuch(of=Measured("value", Pronoun("it" | "that") as it, about=None, time=time)):
            return as_it_was(it, time, g)
        case Identify(thing=Pronoun(form="it")) if (known := _own_measure(g.context)) is not None:
            g.notes.leaned = True
            return known
        case Whether(that=Related(relation=relation, thing=Pronoun(form="it" | "that"), to=Ego())):
            return _by_side(relation, spoken, g)
        case HowMany(of=Described() as of) if (lights := among(of, g)) is not None:
            g.notes.leaned = True
            return HowMany(lights)
        case HowMany(of=Described() as of) if _of_lanes(of, g):
            g.notes.leaned = True
            return HowMuch(Measured("lane-count"))
        case HowDecide(of=Happens(event=Event(actor=Ego(), action=action, tense=tense))) if (
            action in _ARRIVING and tense in ("present", "future")
        ):
            return HowMuch(Measured("exit-number")) if action == "leave" else Whither()
        case Whether(
            that=Compares(left=Measured(attribute="distance", to=None) as far, right=None)
        ) if is_vague(far.thing):
            return HowMuch(Measured("distance-to-go"))
        case Whether(
            that=Is(state="right", thing=Pronoun(), event=Event(actor=Ego()) as event)
        ) if event.action in TURNS:
            return Whether(Happens(replace(event, tense="present")))
        case Whether(that=Happens(event=Event(action="arrive", actor=Ego(), manner=manner))) if {
            "early",
            "late",
        } & {*manner}:
            return Whether(Is("late", Ego(), tense="future"))
        case Whether(
            that=Happens(event=Event(action="stand", actor=Ego(), tense="future") as event)
        ) if "long" in event.manner:
            return HowLong(replace(event, manner=(), modal="must"))
        case Compare(options=options):
            return compared(spoken, options, g)
    return spoken


def _of_light(spoken: Question) -> Question | None:
    """Read how long a light lasts, or held us up, as when it changes, or how long we waited."""
    match spoken:
        case Whether(that=Compares(Measured("delay", Feature("light") as lit) as cost, "more")):
            return Whether(Happens(Event("wait", object=lit, time=cost.time, tense=cost.tense)))
        case HowMuch(of=Measured("duration", Feature("light") as lit, tense="present" | "future")):
            return When(Happens(Event("turn-colour", replace(lit, colour=None), tense="future")))
        case HowMuch(of=Measured("delay", Feature("light"), None) as cost):
            return HowLong(Event("wait", object=Feature("light"), time=cost.time, tense=cost.tense))
    return None


def _of_deed(spoken: Question, g: Grounder) -> Question | None:
    """Ask of the deed just now, where only "that" is said of it."""
    match spoken:
        case Why(of=That(), suspect=None) if (
            deed := _fresh(g.context) or beside_road(g.context)
        ) is not None:
            return Why(Happens(deed))
        case Whether(that=Is(state="necessary", thing=thing, event=None) as of) if (
            is_vague(thing) and (deed := _fresh(g.context)) is not None
        ):
            return replace(spoken, that=replace(of, thing=None, event=deed))
        case Whether(
            that=Compares(left=Measured("delay", event=None) as of, right=None) as that
        ) if (
            is_vague(of.thing) and (deed := discussed(g.context, Ego())) is not None
        ):  # "did that save time?"
            g.notes.leaned = True
            return Whether(replace(that, left=replace(of, thing=Ego(), event=deed)))
        case Whether(
            that=Both(contents=(Not(Happens(event)) | Happens(event), Happens(Event("do") as same)))
        ) if is_vague(same.object) and event.modal == "could":  # "... and done the same"
            return Whether(Happens(replace(event, then=None)))
    return None


def _lasted(spoken: Question, g: Grounder) -> Question | None:
    """Read how long or how far, where it is left open what lasts; None: something else."""
    match spoken:
        case HowMuch(of=Measured(attribute=attribute, thing=thing, event=None) as of) if (
            attribute in _LASTING and is_vague(thing)
        ):
            if attribute == "duration" and isinstance(of.time, WholeRide):
                return HowLong(Event("move", tense="perfect"))  # "how long has this taken?"
            return _lasting(spoken, of, g)
        case HowLong(of=That()):
            return _so_long(spoken, g)
        case HowMuch(of=Measured(attribute="distance", thing=Pronoun(form="it"), to=None)) if (
            about_arriving(g.context)
        ):
            g.notes.leaned = True
            return HowMuch(Measured("distance-to-go"))
        case HowLong(of=Event(action="do" | "happen", actor=actor) as event) if is_vague(actor):
            of = Measured("duration", actor, time=event.time, tense=event.tense)
            return _lasting(HowMuch(of), of, g)
        case HowLong(of=Event(action="block", actor=actor, object=Ego()) as event) if (
            is_vague(actor) and event.tense != "present"
        ):
            return _lasting(spoken, Measured("delay", actor, tense=event.tense), g)
    return None


_ARRIVING: Final = ("leave", "arrive", "exit-left", "exit-right", "turn")


def _by_side(relation: str, spoken: Question, g: Grounder) -> Question:
    """Take "is that the one on the right?" after a question for our way for which way it is."""
    match g.context.discourse.question:
        case HowMuch(of=Measured(attribute="turn" | "exit-number", thing=Ego())) if (
            relation in SIDES
        ):
            g.notes.leaned = True
            action: Any = SIDES[relation]
            return Whether(Happens(Event(action, tense="present")))
    return spoken


def _fresh(context: Context) -> Event | None:
    """Give what we just began to do, where nobody has spoken since then."""
    since = context.now - FRESH
    if context.discourse.asked_at is not None:
        since = max(since, context.discourse.asked_at)
    begun = [e for e in context.deeds(Ego(), since, context.now)
             if e.begin > since and e.action in _SUDDEN]  # fmt: skip
    return event_of(begun[-1], context.now) if begun else None


def _of_lanes(of: Described, g: Grounder) -> bool:
    """Tell whether lanes are counted: it was a lane that was asked for just now."""
    asked = g.context.discourse.question
    return (
        replace(of, among=None) == _SUCH
        and isinstance(asked, HowMuch)
        and asked.of.attribute in ("lane", "lane-count")
    )


def is_vague(thing: Thing | None) -> bool:
    """Tell whether a thing is a word that may stand for what goes on."""
    return isinstance(thing, Pronoun) and thing.form in _VAGUE


def _lasting(spoken: Question, of: Measured, g: Grounder) -> Question:
    g.notes.leaned = True
    if of.attribute != "delay" and of.tense in ("present", "future"):
        if halting(g.context):
            return When(Happens(Event("go", tense="future")))
        return HowMuch(Measured("time-to-go"))
    asked = proposition_of(g.context.discourse.question)
    denied = isinstance(asked, Not) and Ego() in {e.actor for e in parts(asked, Event)}
    ours = Ego() if of.attribute == "delay" else None
    denied = denied or isinstance(spoken, HowLong)  # "how long did that hold us up?"
    known = (hindrance(g.context) if denied else None) or discussed(g.context, ours)
    if known is None:
        return spoken
    return HowMuch(replace(of, thing=known.actor, event=known))


def _of_limit(spoken: Question, g: Grounder) -> Question | None:
    """Take "are you keeping to it?" after a question on the limit for one on our speed."""
    match spoken:
        case Whether(Happens(Event(action, Ego(), Pronoun("it" | "that")))) if (
            action in _KEPT and _own_measure(g.context) == _LIMIT
        ):
            g.notes.leaned = True
            kept: Any = "same" if action == "do" else "at-most"
            return Whether(Compares(Measured("speed"), kept, Measured("limit")))
    return None


def _own_measure(context: Context) -> HowMuch | None:
    """Give what "and what is it now?" asks after a measure of ours."""
    match context.discourse.question:
        case HowMuch(of=Measured(thing=Ego(), to=None, event=None) as of, extreme=None):
            return HowMuch(replace(of, time=Unsaid(), tense="present"))
    return None


def _so_long(spoken: HowLong, g: Grounder) -> Question:
    """Take "how long for?" for how long it is so that was asked about or told."""
    discourse = g.context.discourse
    silent = discourse.question is None and not discourse.propositions
    known = None if silent else proposition_of(discourse.question) or asserted(g.context)
    if known is None:
        return HowMuch(Measured("time-to-go"))
    g.notes.leaned = True
    return replace(spoken, of=affirmed(known))


def halting(context: Context) -> bool:
    """Tell whether our car stands, or is about to."""
    since = max(context.begin, context.now - 0.5)
    lately = context.deeds(Ego(), since, context.now)
    return any(e.action in _HALTING and e.end is None for e in lately)


def within_limit(spoken: Is, g: Grounder) -> Proposition | None:
    """Give what "allowed" asks of a speed: that it is within the limit; None: of something else."""
    if spoken.state != "allowed":
        return None
    event = spoken.event
    if event is not None:
        fast = "fast" in event.manner
        return _limited(event.actor, spoken) if fast else None
    question = g.context.discourse.question
    if not is_vague(spoken.thing) and spoken.thing is not None:
        return None
    match question:
        case HowMuch(of=Measured(attribute="speed", thing=thing)):
            g.notes.leaned = True
            return _limited(thing, spoken)
    return None


def _limited(thing: Thing, spoken: Is) -> Proposition:
    speed = Measured("speed", thing, time=spoken.time, tense=spoken.tense)
    return Compares(speed, "at-most", replace(speed, attribute="limit"))


def something_wrong(spoken: Is, g: Grounder) -> Is | None:
    """Give what "was something wrong?" asks: whether it was dangerous; None: something else.

    Of now it asks what hinders us, if anything.
    """
    if spoken.state != "wrong" or spoken.thing not in _ANYTHING:
        return None
    g.notes.leaned = True
    if spoken.tense == "present":
        return replace(spoken, thing=None, time=Now())
    of_ride = isinstance(spoken.time, WholeRide)
    event = None if of_ride else discussed(g.context)
    return replace(spoken, state="dangerous", thing=None, event=event)


def of_nobody(spoken: Happens) -> Proposition:
    """Take "nobody does so" for the denial that anybody does."""
    event = spoken.event
    if not isinstance(event.actor, Nobody) or event.actor.described is not None:
        return spoken
    return Not(Happens(replace(event, actor=Described(definite=False))))
