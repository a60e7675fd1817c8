"""Lasting: how long something lasts or has lasted, and how long it is until something happens."""

from typing import Any, Final, cast

from xavi_dialogue.domain.meaning import HowLong, HowMany, HowMuch, Listing, Peak, Question, When
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Junction,
    Measured,
    Not,
    Passenger,
    Pronoun,
    Rank,
    Related,
    Relative,
    That,
    Thing,
    Time,
    Unknown,
    Unsaid,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause, timed_by, wanted_pronoun
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.clauses.times import at_place, is_come_to
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.propositions.specials import proposition_of
from xavi_dialogue.nlu.compose.verbs.lights import colour_of
from xavi_dialogue.nlu.compose.wh_questions.behind import blamed_for, following, seen, staying

#: What is driving as such, and no moment of the ride.
DRIVING = frozenset({"move", "go", "do", "continue", "happen", "speed-up", "slow-down"})
SAVING = ("save", "gain")  # what a manoeuvre does with time
#: What lasts beside events.
_STATES = (Related, Is, Has, Exists, Compares, Not)
_TURNS = frozenset({"turn", "exit-left", "exit-right"})
_SEEING = frozenset({"see", "look", "watch", "know", "track", "notice"})


def spent_by(clause: Clause, value: Special) -> Event | None:
    """Give the deed by which time is saved or lost: "by overtaking"."""
    by = value.match.phrases.get("by")
    if isinstance(by, Event):
        return cast(Event, with_fields(by, tense=clause.tense))
    return following(clause)


def saving(clause: Clause) -> Event:
    """Name what may have saved time: what we chose, not what held us up."""
    named = clause.subject
    if isinstance(named, Event) and isinstance(named.actor, Ego):
        return cast(Event, with_fields(named, tense=clause.tense))
    return Event("do", Ego(), tense=cast(Any, clause.tense))


def left_over(event: Event | None) -> bool:
    """Say whether it is "left" that stands as a verb: "how much time have we left"."""
    return event is not None and event.action == "leave" and event.object is None


def measured(attribute: str, clause: Clause, thing: Thing | None, **more: Any) -> HowMuch:
    """Ask for an attribute of a thing at the time of the clause."""
    extreme = more.pop("extreme", None)
    timed_by(clause)
    time = more.pop("time", clause.time)
    time = at_place(clause) if isinstance(time, Unsaid) else time
    if thing is None and attribute == "speed" and as_thing(clause.subject) is None:
        thing = _postponed(clause)
    thing = (blamed_for(clause) if attribute == "delay" else None) or thing
    actor: Thing = Ego() if thing is None or isinstance(thing, Passenger) else thing
    if attribute == "delay" and (isinstance(actor, Unknown) or _is_deed(actor)):
        actor = Ego()  # "all that stopping", "all this standing"
    if attribute == "delay" and isinstance(clause.subject, Event) and more.get("event") is None:
        more["event"], actor = with_fields(clause.subject, tense=clause.tense), Ego()
    if actor == more.get("to") == Ego():  # "how much room was there between us"
        actor = _postponed(clause) or Pronoun("it")
    actor = _placed(actor, clause)
    tense = "future" if attribute == "speed" and is_aimed(clause, actor) else clause.tense
    return HowMuch(
        Measured(cast(Any, attribute), actor, time=time, tense=cast(Any, tense), **more), extreme,
    )  # fmt: skip


_AIMING: Final = frozenset({"aim", "target", "plan", "slow", "slow down", "brake", "go for"})


def is_aimed(clause: Clause, actor: Thing | None) -> bool:
    """Say whether the speed is asked for to which we mean to come: "what speed do you aim for"."""
    ours = isinstance(actor, Ego) and clause.tense == "present" and clause.modal in (None, "want")
    aims = clause.verb is not None and clause.verb.key in _AIMING
    return ours and (aims or "semi-want" in clause.aux)


def _is_deed(thing: Thing) -> bool:
    """Tell whether a description says nothing of who stands or waits, so that we do."""
    doing = thing.doing if isinstance(thing, Described) else None
    if doing is None or doing.action not in ("stand", "wait", "stop"):
        return False
    return thing == Described(doing=doing)


def _postponed(clause: Clause) -> Thing | None:
    """Find the subject behind the verb: "how many metres is from us the yellow one"."""
    things = (as_thing(sem) for sem, _ in clause.objects)
    return next((t for t in things if isinstance(t, Described | Vehicle | Pronoun)), None)


def _placed(thing: Thing, clause: Clause) -> Thing:
    """Add where it is said to be: "how many metres is behind us the blue car"."""
    if not isinstance(thing, Described) or thing.bearing is not None or clause.verb is not None:
        return thing
    ours = (p.key for p in clause.complements if isinstance(as_thing(p.sem), Ego | Passenger))
    where = next((key for key in ours if key.startswith("bearing-")), None)
    if where is None:
        return thing
    return cast(Thing, with_fields(thing, bearing=where.removeprefix("bearing-")))


def pace(
    clause: Clause, event: Event | None, actor: Thing | None, words: tuple[str, ...]
) -> HowMuch:
    """Ask how fast somebody is or was; "how slow did we get" for the slowest."""
    time = _during_deed(clause) or meanwhile(clause, event)
    least = "slow" in words and clause.tense == "past" and clause.verb is not None
    found = measured("speed", clause, actor, time=time, extreme="lowest" if least else None)
    deeds = (event, *(phrase.sem for phrase in clause.complements))
    turns = any(isinstance(deed, Event) and deed.action in _TURNS for deed in deeds)
    if turns and "do-present" in clause.aux:  # "how fast do you take the turn?"
        return HowMuch(cast(Measured, with_fields(found.of, tense="future")), found.extreme)
    return found


def _during_deed(clause: Clause) -> Relative | None:
    """Take "for that left turn", "in the turn" for the time of what it was then."""
    if clause.tense != "past" or not isinstance(clause.time, Unsaid):
        return None
    deeds = (c.sem for c in clause.complements if c.key in ("in", "for", "on", "through", "at"))
    deed = next((sem for sem in deeds if isinstance(sem, Event)), None)
    return None if deed is None else Relative("during", with_fields(deed, tense="past"))


def meanwhile(clause: Clause, event: Event | None) -> Any:
    """Tell the time of "how fast did you take the bend": that of the deed."""
    if event is None or clause.tense not in ("past", "perfect"):
        return clause.time
    through = _junction(clause, event) if isinstance(clause.time, Unsaid) else None
    if through is not None:
        return Relative("during", through)
    if event.action in DRIVING and _round(clause) and isinstance(clause.time, Unsaid):
        return Relative("during", Event("turn", event.actor, tense=event.tense))
    if isinstance(event.object, Feature) and event.object.kind == "bend":
        time: Time = Unsaid() if event.object.rank is None else Rank(event.object.rank)
        event = Event("turn", event.actor, time=time, tense=event.tense)  # "take the bend"
    if event.action == "head" or event.action in DRIVING:
        return clause.time
    return clause.time if not isinstance(clause.time, Unsaid) else Relative("during", event)


def _junction(clause: Clause, event: Event) -> Junction | None:
    """Give the junction of which all the way through is meant: "how fast did we go round it?"."""
    if event.action in ("pass", "cross", "turn") and isinstance(event.object, Junction):
        return event.object
    if event.action not in DRIVING:
        return None
    places = (as_thing(c.sem) for c in clause.complements if c.sem is not None)
    return next((place for place in places if isinstance(place, Junction)), None)


def _round(clause: Clause) -> bool:
    """Check whether a bend is meant: "how fast did we go round there?"."""
    places = [c for c in clause.complements if c.key == "bearing-around"]
    bends = all(c.sem is None or isinstance(as_thing(c.sem), Feature | Unknown) for c in places)
    around = any(leaf.key == "around" for leaf in clause.particles)
    around = around or any(words_of(part).startswith("round") for _, part in clause.bearings)
    return bends and (bool(places) or around)


def _until_there(clause: Clause, event: Event) -> Question:
    """Ask how long we have got left; "how long have we been here" asks how long we stand."""
    if event.action == "arrive" and event.tense == "perfect" and clause.verb is None:
        return HowLong(with_fields(event, action="stand", object=None, where=None))
    return HowMuch(Measured("time-to-go"))


def long_lasting(clause: Clause, event: Event | None, value: Any, actor: Thing | None) -> Question:
    """Ask how long something lasts, or how long it is until it happens."""
    spent = clause.verb is not None and clause.verb.key == "spend"
    if spent and event is not None and event.action == "stand" and isinstance(event.time, Unsaid):
        return HowLong(with_fields(event, time=WholeRide()))  # "how much time is spent standing"
    place = _passed_through(clause, event or _deed_in(value), actor)
    if place is not None:
        return HowLong(Related("on", Ego(), place, tense=cast(Any, clause.tense)))
    if isinstance(clause.time, Relative) and _is_awaited(clause.time):
        return until(clause.time.anchor)
    if isinstance(clause.time, Relative) and clause.time.relation == "since":
        past = clause.time.anchor
        if event is None and clause.verb is None and isinstance(past, Event):
            return When(Happens(past))  # "how long since we stopped"
    behind = [c.sem for c in clause.complements if c.key == "bearing-behind"]
    if clause.verb is None and actor is None and behind and as_thing(behind[0]) is not None:
        return HowLong(Event("follow", Ego(), as_thing(behind[0]), tense="future"))
    for phrase in clause.complements:
        there = clause.verb is None and is_come_to(as_thing(phrase.sem))
        if phrase.sem and (phrase.key == "until" or (there and phrase.key in ("to", "into"))):
            return until(as_thing(phrase.sem))
    if isinstance(value, Special) and value.name in SAVING:
        return measured("delay", clause, actor, event=spent_by(clause, value) or saving(clause))
    if isinstance(value, Special) and value.name in ("cost", "delay"):
        return measured("delay", clause, value.light or actor, event=spent_by(clause, value))
    if isinstance(value, Special) and value.name in ("take-time", "last", "take-care"):
        return _taking(clause, value, actor)
    if isinstance(value, Special) and value.name in _SEEING:
        return HowLong(seen(value))
    if event is not None:
        remaining = clause.verb is not None and clause.verb.key in ("get", "have")
        if event.tense == "present" and isinstance(event.actor, Ego) and event.action in _TURNS:
            return When(Happens(with_fields(event, tense="future")))  # "in how many seconds"
        if event.action == "arrive" or (remaining and event.action in ("change-left", "go")):
            return _until_there(clause, event)
        return HowLong(event)
    subject = clause.subject
    if isinstance(subject, Event) and subject.action == "exit-left" and clause.verb is None:
        return HowMuch(Measured("time-to-go"))  # "how long is left"
    if isinstance(subject, Event):
        return HowLong(subject)
    if isinstance(value, Special) and value.name == "stay-colour":
        return HowLong(proposition_of(value))
    value = staying(clause, value) or value
    lasts = isinstance(actor, Ego) or clause.tense != "present"
    if isinstance(value, _STATES) and (lasts or getattr(value, "attribute", None) == "colour"):
        return HowLong(value)
    if isinstance(subject, Noun) and subject.quality == "waiting":
        return Peak("waiting", clause.time)  # "how long was the longest stop?"
    if isinstance(subject, Noun) and subject.key == "ride":
        return HowMuch(Measured("time" if clause.tense == "past" else "time-to-go"))
    if isinstance(actor, Pronoun) or (isinstance(actor, Ego) and clause.bearings):
        return measured("duration", clause, actor)
    timed = isinstance(subject, Noun) and subject.key == "time"  # "how much time do we have"
    if (actor is None or timed) and clause.that is not None:
        return HowLong(That())  # "how much time do you say"
    ours = clause.verb is not None and clause.verb.key == "have" and isinstance(actor, Ego)
    if timed or ours:
        return HowMuch(Measured("time-to-go"))
    return measured("size", clause, actor) if actor is not None else HowMuch(Measured("time-to-go"))


_THROUGH = DRIVING | {"cross", "pass", "circle"}
_SPENDING = frozenset({"take", "spend", "need", "last", "get"})


def _passed_through(clause: Clause, event: Event | None, actor: Thing | None) -> Junction | None:
    """Find the junction of "how long did that roundabout take us", "... to get round it"."""
    if clause.tense not in ("past", "perfect") or clause.verb is None:
        return None
    if isinstance(actor, Junction):
        return actor if clause.verb.key in _SPENDING else None
    if clause.verb.key not in _SPENDING or (event is not None and event.action not in _THROUGH):
        return None
    time = clause.time if event is None else event.time
    named = (time.anchor if isinstance(time, Relative) else None, getattr(event, "object", None))
    return next((place for place in named if isinstance(place, Junction)), None)


def _deed_in(value: Any) -> Event | None:
    """Find the deed of "it took us ... to get through the roundabout"."""
    content = value.content if isinstance(value, Special) else None
    return content.event if isinstance(content, Happens) else None


def _is_awaited(time: Relative) -> bool:
    """Say whether it is asked how long it is until something: "how long before we move"."""
    coming = getattr(time.anchor, "tense", "present") in ("present", "future")
    return time.relation == "until" or (time.relation == "before" and coming)


def _taking(clause: Clause, value: Special, actor: Thing | None) -> Question:
    """Ask how long something takes."""
    content = value.content
    if any(isinstance(sem, Destination) for sem in value.match.phrases.values()):
        return HowMuch(Measured("time-to-go"))
    if isinstance(content, Happens):
        if content.event.action == "arrive":
            return HowMuch(Measured("time-to-go"))
        doer = as_thing(value.match.second) or as_thing(clause.subject)
        ours = isinstance(content.event.actor, Ego) and not wanted_pronoun(doer)
        deed = with_fields(content.event, actor=doer) if ours and doer else content.event
        return HowLong(with_fields(deed, tense="future") if clause.tense == "future" else deed)
    if isinstance(clause.subject, Event):
        return HowLong(clause.subject)
    if isinstance(clause.subject, Noun) and clause.subject.key == "ride":
        return HowMuch(Measured("time-to-go" if clause.tense == "future" else "time"))
    return measured("duration", clause, actor)


def since(clause: Clause, value: Any) -> Question | None:
    """Ask since when something is so; None where nothing is that could last."""
    if isinstance(value, Happens):
        return HowLong(value.event)
    if isinstance(value, Special):
        value = proposition_of(value)
    return HowLong(value) if value is not None and not isinstance(clause.subject, Measure) else None


def until(anchor: Any) -> Question:
    """Ask how long it is until something happens."""
    coming = isinstance(anchor, Event) and isinstance(anchor.actor, Described | Vehicle)
    if isinstance(anchor, Event) and coming and anchor.action in ("arrive", "come", "enter"):
        return When(Happens(Event("pass", Ego(), anchor.actor, tense="future")))
    arriving = isinstance(anchor, Event) and anchor.action == "arrive"
    if isinstance(anchor.object if arriving else anchor, Destination | None):
        return HowMuch(Measured("time-to-go"))
    if arriving:
        return When(Happens(with_fields(anchor, tense="future")))
    if isinstance(anchor, Event):
        ahead = anchor.tense in ("present", "perfect")
        return When(Happens(with_fields(anchor, tense="future") if ahead else anchor))
    if (colour := colour_of(anchor)) is not None:  # "how long until green?"
        light = Feature("light")
        shown = Feature("light", colour=colour)
        return When(Happens(Event("turn-colour", light, shown, tense="future")))
    if isinstance(anchor, Vehicle | Described):  # until we meet
        return When(Happens(Event("pass", Ego(), anchor, tense="future")))
    if anchor is not None and not isinstance(anchor, Ego | Pronoun):
        return When(Happens(Event("arrive", Ego(), anchor, tense="future")))
    return HowMuch(Measured("time-to-go"))


def how_often(value: object, event: Event | None) -> Question | None:
    """Ask how often something was done, or how often we were wrong; None: of nothing known."""
    if isinstance(value, Is) and value.state == "wrong":
        return Listing("wrong-predictions", time=value.time)
    return None if event is None else HowMany(event)
