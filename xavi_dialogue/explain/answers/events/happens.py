"""Happens: whether an event happened, goes on, or is to come."""

from msgspec.structs import replace as with_fields

from xavi_dialogue.domain.answers import Bound, Verdict
from xavi_dialogue.domain.facts import Episode, Fact, Measure
from xavi_dialogue.domain.terms import Ego, Event, Happens, Now, Unsaid, Vehicle, WholeRide
from xavi_dialogue.domain.vocabulary import BEYOND, ActionName
from xavi_dialogue.explain.answers.events.arriving import arrived
from xavi_dialogue.explain.answers.events.moving import moved, sets_off
from xavi_dialogue.explain.answers.events.picking import likeliest
from xavi_dialogue.explain.answers.events.together import nearest_of, together
from xavi_dialogue.explain.answers.expectations.foreseen import (
    HALTS,
    YIELDS,
    besides,
    chance,
    collision_chance,
    is_open,
    macros,
    unconsidered,
    went_elsewhere,
    wrong_belief,
)
from xavi_dialogue.explain.answers.expectations.plans import foreseen, is_halting
from xavi_dialogue.explain.answers.expectations.slowing import slowing
from xavi_dialogue.explain.answers.measuring.closeness import closeness
from xavi_dialogue.explain.answers.measuring.nearing import (
    closes,
    keeps,
    nears,
    past_leader,
    settled,
    trails,
)
from xavi_dialogue.explain.answers.reference import naming
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, expected, known, unknown
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window, is_ahead, window
from xavi_dialogue.explain.answers.reference.occasions import instead, occasion, occasions, overlaps
from xavi_dialogue.explain.answers.ride.leaving import apart, by_road, left_behind, still_there
from xavi_dialogue.explain.answers.ride.onward import other_exit
from xavi_dialogue.explain.answers.sight.sight import comes, sees
from xavi_dialogue.explain.history.thresholds import MOVING

#: Actions that "is he pulling out?" may mean as still to come.
INTENDED: tuple[ActionName, ...] = ("pull-out", "let-go", "give-way", "enter", "cross")
CHANGES: frozenset[ActionName] = frozenset(("change-left", "change-right", "change-lane"))
RECENT = 2.0  # [s] for which the last view of a vehicle still counts as the present
SPEEDS = HALTS | YIELDS | frozenset(("slow-down", "speed-up", "brake", "go", "move"))


def happens(of: Happens, asked: Asked) -> Finding:
    """Check whether an event happened, happens or will happen.

    Raises:
        Unanswered: the event is about a vehicle that was never seen.
    """
    event = of.event
    naming.somebodies(asked, event.actor, asked.now)
    ours = naming.is_us(event.actor)
    if event.action in BEYOND and event.action != "u-turn" and not ours:
        return unknown("not-sensed")
    if event.action == "see":
        return sees(asked, event)
    if event.action == "arrive" and ours:
        return arrived(asked, event)
    if event.action == "block" and ours and naming.number(event.object) is None:
        return _blocks(asked, event)
    if event.action in ("collide", "nearly-collide"):
        return _collides(asked, event)
    here = event.action == "come" and event.tense == "present"
    if here and (coming := comes(asked, event)) is not None:
        return coming
    for told_by in (together, _moves, sets_off, closes, trails, keeps, _left_room):
        if (moves := told_by(asked, event)) is not None:
            return moves
    if is_ahead(asked, event.time, event.tense) or _all_the_way(event) or _intended(asked, event):
        return _to_come(asked, past_leader(asked, event))
    return _has_been(asked, event)


def _moves(asked: Asked, event: Event) -> Finding | None:
    """Check whether somebody is going, as everybody in motion is; None for other events."""
    plain = event.action in ("go", "move") and event.object is None and event.side is None
    if not plain or event.modal is not None or event.where is not None or event.manner:
        return None
    if event.tense in ("past", "perfect"):
        return moved(asked, event)
    if event.tense != "present":
        return None
    who = naming.somebodies(asked, event.actor, asked.now)
    if len(who) != 1 or asked.past is not None or not isinstance(event.time, Unsaid | Now):
        return None
    speed = asked.world.measure("speed", who[0], asked.now)
    if speed.value is None:
        return None
    moving = speed.value >= MOVING
    begun = occasion(asked, with_fields(event, action="go")) if moving else None
    if begun is not None and begun.end is not None and begun.end < asked.now - RECENT:
        begun = None  # we may have stood since
    doing = _under_way(asked, event, Window(asked.now, asked.now))
    facts: tuple[Fact, ...] = (begun,) if begun is not None else (speed,) if moving else doing
    return Finding(moving, facts or (speed,))


def _all_the_way(event: Event) -> bool:
    """Check whether an event is still to come, as in "do we stay in this lane all the way?"."""
    kept = event.action in ("keep-lane", "continue") and naming.is_us(event.actor)
    return kept and event.tense == "present" and isinstance(event.time, WholeRide)


def _intended(asked: Asked, event: Event) -> bool:
    """Check whether a present event has not begun, and so is to come: "is he turning off?"."""
    if event.tense != "present" or not isinstance(event.time, Unsaid | Now):
        return False
    if naming.is_us(event.actor) and event.action == "stop":
        return asked.past is None and is_halting(asked)
    if naming.is_us(event.actor) and (event.action in CHANGES or event.action == "keep-lane"):
        return asked.past is None and occasion(asked, event) is None
    if naming.number(event.actor) is None or asked.past is not None:
        return False
    meant = bool(macros(event)) or event.action in INTENDED
    if not meant or occasion(asked, event) is not None:
        return False
    left_out = unconsidered(asked, event, asked.now) is not None
    return left_out or chance(asked, event, asked.now) is not None


def _has_been(asked: Asked, event: Event) -> Finding:
    """Check whether an event happened or goes on: with its episode, or what was done instead."""
    found = occasion(asked, event) or by_road(asked, event)
    about = window(asked, event.time, event.tense)
    if found is not None and found.action == "cross" and event.tense in ("present", "perfect"):
        over = found.end is not None and found.end < asked.now - RECENT
        holds = over == (event.tense == "perfect")
        return Finding(holds, (found,))  # while it crosses, it is not yet across
    if found is not None:
        spent = Window(found.begin, found.begin)
        halts = event.action in HALTS  # stopping does not contradict going straight on
        wrong = None if halts else wrong_belief(asked, event, spent, came=True)
        believed = () if wrong is None else (wrong,)
        return Finding(True, (found,), None, believed, wrong is not None)
    lost = _lost(asked, event, about) or left_behind(asked, event)
    if lost is not None:
        return lost
    wrong = wrong_belief(asked, event, about, came=False) if _was_to_tell(asked, event) else None
    if wrong is not None and (is_open(asked, wrong) or not went_elsewhere(asked, wrong)):
        wrong = None
    facts: tuple[Fact, ...] = _how_hard(asked, event) or still_there(asked, event)
    facts = facts or instead(asked, event, about)
    if event.tense == "present" or not facts:
        facts = (*_under_way(asked, event, about), *_speeds(asked, event, about)) or facts
    shown = () if wrong is None else (wrong,)
    return Finding(False, facts, None, shown, wrong is not None)


def _how_hard(asked: Asked, event: Event) -> tuple[Fact, ...]:
    """Return how hard somebody braked who did not brake hard."""
    if event.action not in ("brake", "slow-down") or "hard" not in event.manner:
        return ()
    manner = tuple(m for m in event.manner if m != "hard")
    found = occasion(asked, with_fields(event, manner=manner))
    if found is None or found.peak is None:
        return ()
    return (Measure("deceleration", found.actor, found.begin, value=found.peak,
                    until=found.end, extreme="highest"),)  # fmt: skip


def _to_come(asked: Asked, event: Event) -> Finding:
    """Check whether an event is to come: by our plan, or by what we believe of another vehicle."""
    now = asked.now
    present = with_fields(event, tense="present")
    under_way = occasion(asked, present)
    going: tuple[Fact, ...] = () if under_way is None else (under_way,)
    if naming.is_us(event.actor):
        if asked.ride.arrived or asked.ride.ended:
            return Finding(False, going)
        if (other := other_exit(asked, event)) is not None:
            return Finding(False, (other,))
        if (nearing := nears(asked, event)) is not None:
            return nearing
        if slows := slowing(asked, event):
            return Finding(None, answer=slows)
        found = foreseen(asked, event)
        kept = event.action in ("keep-lane", "follow")
        if kept or (found is None and event.action == "continue"):
            moves = [foreseen(asked, Event(a)) for a in ("change-left", "change-right")]
            remains = 1.0 - max((f.share for f in moves if f is not None), default=0.0)
            return expected(remains, *going)
        if found is None:  # what goes on need not begin
            on = Verdict(Happens(with_fields(present, time=Unsaid())), True, going)
            return Finding(bool(going), going, answer=on if going else None, probability=0.0)
        if going and event.action in CHANGES:
            return Finding(True, going)
        begins = Measure(
            "time", event.actor, now, value=found.moment, low=found.low, high=found.high
        )
        begun = bool(going) and found.moment <= now
        return expected(found.share, *going, *(() if begun else (begins,)))
    vehicle = naming.number(event.actor)
    if vehicle is None:
        return likeliest(asked, event)
    if going and event.action == "cross":
        return Finding(True, going)
    look = naming.look_of(asked, event.actor, now)
    if (by_sight := settled(asked, event, going)) is not None:
        return by_sight
    belief = asked.world.belief(vehicle, now)
    share = chance(asked, event, now)
    if share is None and belief is not None and (look is None or look.in_view):
        told_of = unconsidered(asked, event, now) or Bound(Vehicle(vehicle), belief)
        return Finding(None, (), "in-future", answer=told_of)
    if look is not None and not look.in_view and now - (look.seen or now) > RECENT:
        return Finding(None, (look,), "out-of-view", () if belief is None else (belief,))
    if belief is not None and not going:
        belief = with_fields(belief, expectations=besides(belief, event))
    return expected(share, *going, believed=() if belief is None else (belief,))


def _left_room(asked: Asked, event: Event) -> Finding | None:
    """Return how close we came to somebody whom we did not follow; None for other questions."""
    vehicle = naming.number(event.object)
    ours = event.action == "keep-distance" and naming.is_us(event.actor)
    if not ours or vehicle is None or event.tense not in ("past", "perfect"):
        return None
    if occasion(asked, event) is not None:
        return None
    about = window(asked, event.time, event.tense)
    return Finding(None, answer=closeness(asked, vehicle, about, "room"))


def _collides(asked: Asked, event: Event) -> Finding:
    """Check whether there was a collision, nearly was one, or may be."""
    one, other = naming.number(event.actor), naming.number(event.object)
    if one is not None and other is not None:
        return apart(asked, event)
    about = window(asked, event.time, event.tense)
    ahead = is_ahead(asked, event.time, event.tense) or event.tense == "present"
    vehicle = one or other or nearest_of(asked, event, about.widened())
    whom = event.actor if naming.is_us(event.object) else event.object
    crash = occasion(asked, Event("collide", Ego(), whom, time=event.time))
    if crash is not None and event.action == "collide":
        return Finding(True, (crash,))
    near = Window(asked.now, asked.now) if ahead else about
    answer = closeness(asked, vehicle, near, "hit", past=not ahead)
    risk = collision_chance(asked, asked.now, vehicle) if ahead else None
    holds = None if event.action == "nearly-collide" else False
    if ahead and risk is not None:
        holds = risk >= 0.5
    facts = known(answer.closest) if answer.closest is not None else ()
    found = Finding(holds, facts, probability=risk)
    plain = event.action == "collide" and not ahead
    return found if plain else Finding(holds, facts, probability=risk, answer=answer)


def _blocks(asked: Asked, event: Event) -> Finding:
    """Check whether we stood inside a junction."""
    about = window(asked, event.time, event.tense)
    stood = [
        e
        for e in asked.world.episodes(actor=Ego(), actions=("stop", "stand"))
        if e.standing and (event.tense != "present" or e.end is None)
    ]
    if not any(trace.road is not None for trace in asked.ride.traces):
        return unknown("not-recorded", *stood[-1:])
    for episode in stood:
        road = asked.world.road(asked.now if episode.end is None else episode.end)
        place = None if road is None else road.places.get(0)
        if place is not None and place.in_junction and overlaps(asked, episode, about.widened()):
            return Finding(True, (episode,))
    return Finding(False)


def _lost(asked: Asked, event: Event, about: Window) -> Finding | None:
    """Return that an event is not known, as its actor was out of view or the record has a gap."""
    for begin, end in asked.ride.gaps:
        if begin <= about.end and end >= about.begin:
            return unknown("gap-in-record")
    vehicle = naming.number(event.actor)
    if vehicle is None:
        return None
    look = asked.world.look(vehicle, about.end)
    if look is None:
        first = naming.first_look(asked, vehicle, about.end)
        return unknown("out-of-view", *(() if first is None else (first,)))
    here = look.in_view or (look.seen is not None and look.seen >= about.begin - SHORT)
    if here or not about.instant:
        return None
    past = instead(asked, event, about)
    return unknown("out-of-view", look, *past[:1])


def _was_to_tell(asked: Asked, event: Event) -> bool:
    """Check whether a vehicle has done anything that shows where it went."""
    vehicle = naming.number(event.actor)
    if vehicle is None:
        return False
    ways: tuple[ActionName, ...] = (
        "exit-left",
        "exit-right",
        "exit-straight",
        "change-left",
        "change-right",
        "stop",
    )
    return bool(asked.world.episodes(actor=Vehicle(vehicle), actions=ways))


def _under_way(asked: Asked, event: Event, about: Window) -> tuple[Episode, ...]:
    """Return what the actor of an event is doing at that time."""
    who = naming.somebodies(asked, event.actor, about.end)
    near = about.widened(0.5)
    speed = asked.world.measure("speed", who[0], about.end).value if who else None
    return tuple(
        with_fields(e, action="stand") if speed == 0.0 and e.action == "stop" else e
        for actor in who[:1]
        for e in asked.world.episodes(actor=actor, begin=near.begin, end=near.end)
        if e.action not in (event.action, "signal") and (e.end is None or e.end >= about.end - 0.5)
    )[-2:]


def _speeds(asked: Asked, event: Event, about: Window) -> tuple[Measure, ...]:
    """Return the speed of the actor, if the event is about how fast it drives."""
    who = naming.somebodies(asked, event.actor, about.end)
    if event.action not in SPEEDS or not who:
        return ()
    return known(asked.world.measure("speed", who[0], about.end))


def happened(asked: Asked, event: Event) -> bool:
    """Check whether there was such an event at any time so far."""
    return bool(occasions(asked, event))
