"""Events: a verb of motion with what stands with it."""

from typing import Any, cast

from msgspec.structs import replace

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exit,
    Feature,
    Junction,
    Lane,
    Passenger,
    Pronoun,
    Related,
    Relative,
    Thing,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName, Manner
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.followers import relation_of
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.senses import LEFT_OTHER, Match
from xavi_dialogue.nlu.compose.clauses.times import place_time
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.verbs.taking import meant

_SIDED: dict[tuple[str, str], str] = {
    ("turn", "left"): "exit-left",
    ("turn", "right"): "exit-right",
    ("turn", "straight"): "exit-straight",
    ("change-lane", "left"): "change-left",
    ("change-lane", "right"): "change-right",
}
_PLACED = {"in": "on", "on": "on", "at": "near", "into": "on", "between": "between", "with": "with",
           "like": "same-as"}  # fmt: skip
_LIGHTS = frozenset({"indicator", "brake-lights"})
_ROOM = frozenset({"gap", "headway", "distance", "size"})
_GETTING = frozenset({"get", "jump", "hop", "climb", "leap", "step"})
_WALKING = frozenset({"walk", "step", "stroll"})


def actor_of(clause: Clause) -> Thing:
    """Tell who acts: the subject, or in a passive the one behind "by"."""
    if clause.passive:
        for phrase in clause.complements:
            if phrase.key == "by" and phrase.sem is not None:
                return as_thing(phrase.sem) or Described(definite=False)
        if isinstance(clause.gap, Wanted) and any(p.key == "by" for p in clause.complements):
            return clause.gap
        return Described(definite=False)
    actor = as_thing(clause.subject)
    if isinstance(clause.subject, Measure) and clause.subject.of.attribute in _LIGHTS:
        actor = clause.subject.of.thing
    if actor is None or isinstance(actor, Passenger):
        return Ego()
    return actor


def _shown(action: str, clause: Clause, match: Match) -> str:
    """Read "its brake lights came on" as braking, and "use that gap" as going."""
    if action != "signal":
        return action
    if isinstance(clause.subject, Measure) and clause.subject.of.attribute == "brake-lights":
        return "brake"
    used = match.object
    return "go" if isinstance(used, Measure) and used.of.attribute in _ROOM else action


def _named(action: str, thing: Thing | None, clause: Clause) -> str:
    """Give what an action is called where it nearly was one, or is of who speaks."""
    struck = isinstance(thing, Ego | Described | Pronoun | Vehicle)
    struck = struck or (action == "collide" and thing is None)
    if action in ("collide", "head") and struck and clause.focus & _ALMOST:
        action = "nearly-collide"
    out = thing is None and isinstance(clause.subject, Passenger) and clause.verb is not None
    if out and clause.verb.key in _GETTING and action in ("pull-out", "leave"):  # type: ignore[union-attr]
        action = "arrive"  # "when can I get out?"
    if action == "stop" and clause.focus & _ALMOST:
        action = "slow-down"
    return action


def event_of(clause: Clause, match: Match) -> Event:
    """Build the event that a sense says the clause is of."""
    action = match.sense.head
    if clause.passive:
        _agent_named(match)
    noun = isinstance(match.object, (Noun, Measure, Event))
    noun |= action == "brake" and match.object == Pronoun("they")  # "you slammed them on"
    thing = None if noun else as_thing(match.object)
    halted = action == "block" and clause.verb is not None and clause.verb.key == "stop"
    if halted and thing in (Described("car"), Described()) and actor_of(clause) == Ego():
        action, thing = "stop", None  # "stop the car"
    side = clause.side
    if action in ("change-left", "change-right", "change-lane", "exit-left") and not (
        match.sided or _is_named(action, clause)
    ):
        action, thing, side = _lane_move(action, thing, side)
    if isinstance(thing, Lane) and thing.which in ("any", "own") and action.startswith("change"):
        thing = None
    if isinstance(thing, Passenger) and action not in ("drop-off", "call"):
        thing = Ego()
    if match.sided and action.split("-")[-1] in ("left", "right", "straight"):
        side = None
    action = _SIDED.get((action, side or ""), action)
    if action in ("exit-left", "exit-right", "exit-straight", "change-left", "change-right"):
        side = None
    action, side, thing = meant(action, side, thing, match)
    thing = _kept_from(action, thing, match)
    action = _paced(action, clause, match.object)
    action = _shown(action, clause, match)
    action = _named(action, thing, clause)
    time = _let_then(clause, when(clause, match), action)
    place = where(clause, match)
    if action == "keep-lane" and place is not None and place.relation in _ASIDE:
        side, place = _ASIDE[place.relation], None  # "stay on the left"
    if action in _AT_EXITS and thing is None and place is not None:
        thing, place = _exit_meant(place)
    if action == "leave" and "at" in match.phrases and not isinstance(thing, Exit | Junction):
        thing = Exit(thing.rank if isinstance(thing, Described) else None)
    manner = _manner(action, clause)
    if action == "change-lane" and place is not None and isinstance(place.to, Lane):
        (action, thing, side), place = _lane_move(action, place.to, side), None
    if _before_us(action, clause):
        manner, thing = [*manner, "first"], thing or Ego()
    if match.sense.manner:
        manner.append(cast(Manner, match.sense.manner))
    actor = _walker(actor_of(clause), clause)
    if action == "cross":
        actor, thing = _whose_way(actor, thing)
    modal = _modal(clause, actor)
    if modal == "might" and isinstance(time, Relative) and not isinstance(time.anchor, Event):
        time = Unsaid()  # "could it be tucking in after the lorry?"
    if action == "change-plan" and actor == Described(definite=False) and clause.passive:
        actor, thing = Ego(), None  # "why was it dropped?"
    if action == "go" and thing is None and place is None and _thither(actor, clause):
        action = "head" if isinstance(actor, Ego) else "turn"
    return Event(
        cast(ActionName, action), actor, thing, cast(Any, side),
        _manners(action, manner), time, cast(Any, clause.tense),
        cast(Any, modal), None, place, clause.speeds,
    )  # fmt: skip


def _manners(action: str, said: list[Manner]) -> tuple[Manner, ...]:
    """Give the manners of an event; who is let go goes first anyway."""
    left = ("first",) if action == "let-go" else ()
    return tuple(dict.fromkeys(one for one in said if one not in left))


def _whose_way(actor: Thing, thing: Thing | None) -> tuple[Thing, Thing | None]:
    """Take "its path crosses ours" for those whose ways they are; "do our paths cross?" for him."""
    if isinstance(thing, Feature) and thing.of is not None:
        thing = thing.of
    if isinstance(actor, Feature) and actor.kind == "way":
        actor = actor.of or (Pronoun("he") if thing is None else Ego())
        thing = thing or Ego()
    return actor, thing


def _walker(actor: Thing, clause: Clause) -> Thing:
    """Take a man, a woman, anybody who is said to walk for somebody on foot."""
    walks = clause.verb is not None and clause.verb.key in _WALKING
    plain = isinstance(actor, Described) and actor.kind == "vehicle"
    return replace(actor, kind="pedestrian") if walks and plain else actor


def _let_then(clause: Clause, time: Any, action: str) -> Any:
    """Give the time of "let him go before that", which stands with what he does."""
    if action != "let-go" or not isinstance(time, Unsaid):
        return time
    deeds = (part for part in (clause.bare, clause.infinitive) if isinstance(part, Clause))
    times = (deed.time for deed in deeds if not isinstance(deed.time, Unsaid))
    return next(times, Unsaid())


def _modal(clause: Clause, actor: Thing) -> str | None:
    """Take "could he be turning?" for whether he might be."""
    ongoing = clause.verb is not None and clause.verb.category in ("VING", "GOING")
    guessed = ongoing and clause.modal == "could" and clause.tense == "present"
    return "might" if guessed and not isinstance(actor, Ego) else clause.modal


def _thither(actor: Thing, clause: Clause) -> bool:
    """Check whether it says where we are going: "that is where we are going", "down there"."""
    there = any(key == "there" for key, _ in clause.bearings)
    to_come = clause.tense in ("present", "future") and clause.modal is None
    off = bool(clause.particles) or any(
        key == "there" and len(getattr(node, "words", ())) > 1 for key, node in clause.bearings
    )
    there = there and (off or isinstance(actor, Ego))  # "is he going down there too?"
    return to_come and (there or ("where" in clause.focus and isinstance(actor, Ego)))


def _manner(action: str, clause: Clause) -> list[Manner]:
    """Collect how something is done."""
    slow: list[Manner] = ["slowly"] if action == "move" and clause.focus & _HARDLY else []
    manner = [*clause.manner, *slow]
    manner += [_MANNERS[key] for key, _ in clause.adjectives if key in _MANNERS]
    if clause.than is None and not action.startswith(("speed", "slow")):  # "had come faster"
        manner += [_PACES[key] for key, _ in clause.comparisons if key in _PACES]
    return manner


def _is_named(action: str, clause: Clause) -> bool:
    """Say whether an action is called by its name: "exit-left"."""
    return clause.verb is not None and clause.verb.key == action


def _kept_from(action: str, thing: Thing | None, match: Match) -> Thing | None:
    """Find from whom a distance is kept: "keep more distance from the bus"."""
    if action != "keep-distance" or thing not in (None, Feature("space")):
        return thing
    return next((t for sem in match.phrases.values() if (t := as_thing(sem))), None)


def _before_us(action: str, clause: Clause) -> bool:
    """Say whether somebody is said to go before us: first, and not in front."""
    onward = clause.verb is not None and clause.verb.category == "GOING"
    before = any(words_of(node) == "before us" for _, node in clause.bearings)
    return action == "go" and before and not onward


_ASIDE: dict[str, str] = {"left-of": "left", "right-of": "right"}
_AT_EXITS = frozenset({"leave", "exit-left", "exit-right", "turn"})


def _exit_meant(place: Related) -> tuple[Thing | None, Related | None]:
    """Read "at the next one" beside turning off as an exit, not as a vehicle."""
    to = place.to
    ranked = isinstance(to, Described) and to.rank is not None and to == Described(rank=to.rank)
    if ranked and isinstance(to, Described) and place.relation in ("near", "on"):
        return Exit(to.rank), None
    return None, place


_ALMOST = frozenset({"nearly", "almost"})
_HARDLY = frozenset({"barely", "hardly", "scarcely"})
_PACES: dict[str, Manner] = {
    "fast": "fast", "slow": "slowly", "soon": "early", "early": "early", "late": "late",
}  # fmt: skip
_MANNERS: dict[str, Manner] = {
    "fast": "fast", "slow": "slowly", "close": "close", "sudden": "suddenly", "hard": "hard",
    "late": "late", "early": "early", "safe": "safely", "far": "far", "dangerous": "fast",
}  # fmt: skip


def _paced(action: str, clause: Clause, kept: Sem | None) -> str:
    """Read "go slower", "go from 50 to 15" as slowing down, and "kept his speed" as going on."""
    if clause.speeds is not None and action not in ("brake", "stop"):
        first, last = clause.speeds
        return "slow-down" if first.value > last.value else "speed-up"
    if action == "keep-distance" and isinstance(kept, Measure) and kept.of.attribute == "speed":
        return "continue"
    if action not in ("go", "move", "continue", "approach") or not clause.comparisons:
        return action
    if clause.than is not None:
        return action
    return {"fast": "speed-up", "slow": "slow-down"}.get(clause.comparisons[0][0], action)


def _agent_named(match: Match) -> None:
    """Take the agent of a passive out of what is left over."""
    for phrase in [p for p in match.left if p.key == "by"]:
        match.left.remove(phrase)
        match.cost -= LEFT_OTHER


def _lane_move(
    action: str, thing: Thing | None, side: str | None
) -> tuple[str, Thing | None, str | None]:
    """Take the side of a lane change from the lane."""
    if isinstance(thing, Lane):
        which = {"leftmost": "left", "rightmost": "right"}.get(thing.which, thing.which)
        if which in ("left", "right") and thing.of is None:
            return f"change-{which}", None, None
        return "change-lane", thing if thing.of or thing.which == "own" else None, side
    if isinstance(thing, Junction) and action == "exit-left":
        return "turn", thing, side
    if action == "exit-left":
        return "turn", thing, side
    return "change-lane", thing, side


def when(clause: Clause, match: Match | None) -> Any:
    """Find the time: said as such, or by a place that is passed."""
    said = not isinstance(clause.time, Unsaid | WholeRide)
    phrases = match.left if match is not None else list(clause.complements)
    for phrase in list(phrases):
        key = phrase.key.removeprefix("bearing-") if phrase.key == "bearing-ahead" else phrase.key
        key = "before" if key == "ahead" else key
        found = place_time(key, phrase.sem)
        if said and not isinstance(phrase.sem, Junction):
            continue
        if found is None and phrase.key in ("before", "after", "since", "until", "during"):
            thing = phrase.sem
            if isinstance(thing, Pronoun):
                continue
            anchor = thing if isinstance(thing, Event) else as_thing(thing)
            if isinstance(thing, Noun) and thing.key == "ride":
                continue
            found = Relative(cast(Any, phrase.key), anchor) if anchor is not None else None
        if found is not None:
            if match is not None:
                match.left.remove(phrase)
                match.cost -= 0.3
            return clause.time if said else found
    return clause.time


def where(clause: Clause, match: Match) -> Related | None:
    """Say beside what it is done."""
    for phrase in list(match.left):
        thing = as_thing(phrase.sem)
        if thing is None or isinstance(thing, Wanted):
            continue
        if phrase.key.startswith("bearing-"):
            relation = relation_of(phrase.key.removeprefix("bearing-"))
        elif phrase.key in _PLACED:
            relation = _PLACED[phrase.key]
        else:
            continue
        match.left.remove(phrase)
        match.cost -= 0.25
        return Related(cast(Any, relation), actor_of(clause), thing)
    for bearing, _ in clause.bearings:
        if bearing not in ("there", "here", "around") and f"bearing-{bearing}" not in match.phrases:
            return Related(cast(Any, relation_of(bearing)), actor_of(clause), Ego())
    return None
