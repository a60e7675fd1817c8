"""Turns: who goes before us at a junction and who after, and who must move so that we can.

The rules come from the record of the road. Those who go before us are stated by distance, the
closest first; at the head of a queue that stands, who must move first.
"""

from typing import Final

from msgspec.structs import replace

from planner.record.places import RoadFacts
from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.answers import Answer, Counted, Identified, Priority, Unblocking
from xavi_dialogue.domain.facts import Episode, Look
from xavi_dialogue.domain.meaning import HowMany, HowMuch, Which, Why
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Next,
    Not,
    Proposition,
    Related,
    Thing,
    Unsaid,
    Vehicles,
    Wanted,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers import queues
from xavi_dialogue.explain.answers.expectations.precedence import red_ahead
from xavi_dialogue.explain.answers.lights.lights_turn import held
from xavi_dialogue.explain.answers.measuring import counting
from xavi_dialogue.explain.answers.owing import DUTIES, LETTING, grounds, reason
from xavi_dialogue.explain.answers.propositions import measures
from xavi_dialogue.explain.answers.propositions.reasons import why
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window, is_past, window
from xavi_dialogue.explain.answers.reference.naming import is_us, number, of_kind, somebodies
from xavi_dialogue.explain.answers.ride.crossings import meets_ahead, passes_by
from xavi_dialogue.explain.answers.ride.cycling import likely_let
from xavi_dialogue.explain.answers.ride.delays import let_past
from xavi_dialogue.explain.answers.ride.priority import priority_at, rule_for
from xavi_dialogue.explain.answers.ride.walking import walks_first
from xavi_dialogue.explain.answers.sight import standing_row

GOING: Final = frozenset[ActionName](("go", "move", "enter", "cross", "turn", "continue", "pass"))
GIVEN: Final[tuple[ActionName, ...]] = ("give-way",)
WAITS: Final[tuple[ActionName, ...]] = ("give-way", "wait")
BOTH: Final = 2  # minimum of vehicles whose order is stated


def who(question: Which, asked: Asked) -> Answer:
    """Return for whom something holds; for who goes first, all whose way meets ours.

    Raises:
        Unanswered: it presupposes something that did not happen.
    """
    such = question.such
    if isinstance(such, Happens) and (earliest := _earliest(question, such.event, asked)):
        return earliest
    if such is not None and _is_now(asked, such):
        if _asks_turn(such) and (light := held(asked)) is not None:
            return light
        if _asks_mover(such) and (found := unblocking(asked)) is not None:
            return found
        among = question.among or _parties(such)
        road = asked.world.road(asked.now)
        if _asks_order(such) and not among and red_ahead(road):
            return Priority(asked.now, "give-way", light=True)
        if _asks_order(such) and (told := order(asked, among)) is not None:
            return told
        if _asks_order(such) and (named := _named(asked, among)):
            return priority_at(asked, named[0], Window(asked.now, asked.now))
        if _asks_next(such) and (told := _next(asked)) is not None:
            return told
        if _asks_whom(such) and (told := order(asked, ())) is not None:
            return replace(told, after=()) if told.rule == "give-way" else told
    elif isinstance(such, Happens) and _asks_order(such) and (met := _met(asked, such.event)):
        return met
    found = queues.who(question, asked)
    if not isinstance(found, Priority):
        return found
    if such is not None and found.rule == "none" and _asks_whom(such) and _is_now(asked, such):
        return unblocking(asked) or why(Why(Not(Happens(Event("go", tense="present")))), asked)
    return reason(asked, found)


def _met(asked: Asked, of: Event) -> Priority | None:
    """Return who went first where we let somebody go, else where somebody let us; None: nowhere.

    Of several times it is the one that is nearest to that asked about.
    """
    about = window(asked, of.time, of.tense)

    def apart(episode: Episode) -> tuple[float, float]:
        end = asked.now if episode.end is None else episode.end
        return max(episode.begin - about.end, about.begin - end, 0.0), -episode.begin

    ours = asked.world.episodes(Ego(), GIVEN)
    theirs = asked.world.episodes(None, GIVEN, object=Ego())
    for episode in (*sorted(ours, key=apart), *sorted(theirs, key=apart)):
        vehicle = number(episode.object) or number(episode.actor)
        near = Window(episode.begin, asked.now if episode.end is None else episode.end)
        if vehicle is not None and (told := priority_at(asked, vehicle, near)).rule != "none":
            return told
    return None


def how_much(question: HowMuch, asked: Asked) -> Answer:
    """Return a measure; of the rule that holds here, the road user that it binds, and its basis.

    Raises:
        Unanswered: the record does not hold it.
    """
    of = question.of
    if of.attribute == "right-of-way" and number(of.thing) is None and of.tense != "past":
        told = order(asked, ()) if _is_now(asked, Related("has-priority-over", Wanted())) else None
        if told is not None:
            return told
    found = measures.how_much(question, asked)
    return reason(asked, found) if isinstance(found, Priority) else found


def _earliest(question: Which, event: Event, asked: Asked) -> Identified | None:
    """Find the first to do something: the one that began first; None if nobody is known."""
    past = event.tense in ("past", "perfect") and event.modal is None
    if not past or "first" not in event.manner or event.action in GOING - {"move"}:
        return None
    manner = tuple(m for m in event.manner if m != "first")
    found = queues.who(replace(question, such=Happens(replace(event, manner=manner))), asked)
    deeds = found.facts if isinstance(found, Identified) else ()
    begun = [e for e in deeds if isinstance(e, Episode)]
    if not isinstance(found, Identified) or not begun:
        return None
    first = min(begun, key=lambda e: e.begin)
    looks = tuple(x for x in found.looks if x.vehicle == number(first.actor))
    return replace(found, looks=looks, facts=(first,)) if looks else None


def how_many(question: HowMany, asked: Asked) -> Answer:
    """Return how many there are; of those that we still must let go first, who they are.

    Raises:
        Unanswered: it is about something that the record does not contain.
    """
    doing = question.such.doing if isinstance(question.such, Described) else None
    if doing is not None and _let(doing):
        return _counted(question, doing, asked)
    if doing is None or not _asks_whom(Happens(doing)) or is_past(asked, Unsaid(), doing.tense):
        return counting.how_many(question, asked)
    road = asked.world.road(asked.now)
    if road is None:
        return counting.how_many(question, asked)
    before = _in_order(asked, road, "vehicle", ())
    if not before:
        return Priority(asked.now, "none", number=True)
    told = Priority(asked.now, "give-way", before[0].vehicle, others=_numbers(before[1:]))
    return replace(told, number=True, why=grounds(asked, road, before))


def _let(doing: Event) -> bool:
    """Check whether somebody is described as let go first by us."""
    past = doing.tense in ("past", "perfect") and doing.modal is None
    return past and doing.action in ("let-go", "give-way") and is_us(doing.actor)


def _counted(question: HowMany, doing: Event, asked: Asked) -> Counted:
    """Return how many road users we let go first: the same that a list of them names."""
    assert isinstance(question.such, Described)
    about = replace(doing, time=WholeRide()) if doing.time == Unsaid() else doing
    seen = let_past(about, asked)
    kind = question.such.kind
    numbers = {n for x in seen for n in of_kind(asked, (x.vehicle,), kind, x.time)}
    found = tuple(look for look in seen if look.vehicle in numbers)
    return Counted(Everyone(kind), len(found), found if len(found) == 1 else (), such=question.such)


def order(asked: Asked, among: tuple[Thing, ...]) -> Priority | None:
    """Return all who go before us now, and who must wait for us; None for fewer than two."""
    road = asked.world.road(asked.now)
    if road is None:
        return None
    only = _named(asked, among)
    before = _in_order(asked, road, "vehicle", only)
    after = _in_order(asked, road, "ego", only)
    met = _numbers((*before, *after))
    drive = (n for n in only if (x := asked.world.look(n, asked.now)) and x.kind not in ON_FOOT)
    apart = tuple(n for n in drive if n not in met)  # the ways of people follow no lanes
    if len(before) + len(after) < (1 if apart else BOTH):
        return None
    if not before and not only and rule_for(road, None, gave_way=False) == "give-way":
        return Priority(asked.now, "give-way", after=_numbers(after))  # others may come
    if not before:
        others = _numbers(after[1:])
        return Priority(asked.now, "priority", after[0].vehicle, others=others, apart=apart)
    first, *rest = _numbers(before)
    told = Priority(asked.now, "give-way", first, others=tuple(rest), after=_numbers(after))
    told = replace(told, apart=apart)
    return replace(told, why=grounds(asked, road, before))


def _named(asked: Asked, among: tuple[Thing, ...]) -> tuple[int, ...]:
    return tuple(n for t in among for v in somebodies(asked, t, asked.now) if (n := number(v)))


def _next(asked: Asked) -> Priority | None:
    """Return who goes before us now, or after us; None if nobody's way meets ours."""
    told = order(asked, ()) or priority_at(asked, None, Window(asked.now, asked.now))
    return None if told.rule == "none" or told.vehicle is None else reason(asked, told)


def unblocking(asked: Asked) -> Answer | None:
    """Return who must move first so that we can go; None if nobody stands in our way."""
    head = standing_row.head(asked, asked.now)
    if head is None:
        return order(asked, ())
    waiting = asked.world.episodes(actor=head, actions=WAITS)
    whom = (number(e.object) for e in waiting if e.end is None)
    speed = asked.world.measure("speed", head, asked.now).value
    going = speed is not None and speed > standing_row.SETTING_OFF
    waits = () if going else tuple(dict.fromkeys(n for n in whom if n is not None))
    return Unblocking(asked.now, head.number, going, waits)


def _in_order(
    asked: Asked, road: RoadFacts, who_goes: str, only: tuple[int, ...]
) -> tuple[Look, ...]:
    """Find those in view who go before or after us by the rules, the closest first."""
    now, seen = Window(asked.now, asked.now), asked.world.in_view(asked.now)
    ruled: dict[int, str] = {v: "vehicle" for v in seen if likely_let(asked, v)}
    for fact in road.priority:
        if not (meets_ahead(asked, fact.vehicle) and passes_by(asked, fact.vehicle)):
            ruled[fact.vehicle] = fact.who
    ruled |= {v: "vehicle" for v in seen if walks_first(asked, v, now, None)}
    found = [
        look
        for vehicle, who in ruled.items()
        if who == who_goes and (not only or vehicle in only)
        if (look := asked.world.look(vehicle, asked.now)) is not None and look.in_view
    ]
    return tuple(sorted(found, key=lambda look: (look.distance, look.vehicle)))


def _numbers(seen: tuple[Look, ...]) -> tuple[int, ...]:
    return tuple(look.vehicle for look in seen)


def _is_now(asked: Asked, such: Proposition) -> bool:
    """Check whether a proposition is about the present, or the future."""
    of = such.event if isinstance(such, Happens) else such
    if not isinstance(of, Event | Related | Is) or of.tense not in ("present", "future"):
        return False
    try:
        return not is_past(asked, of.time, "present")
    except Unanswered:
        return False


def _asks_turn(such: Proposition) -> bool:
    """Check whether the question is whose turn it is to go."""
    match such:
        case Happens(event=Event(actor=Wanted(), object=Vehicles(), modal=None) as event):
            return event.action in GOING and "first" in event.manner  # "us or the people?"
    return _asks_mover(such) or _asks_order(such) or _asks_next(such)


def _asks_mover(such: Proposition) -> bool:
    """Check whether the question is who must move so that we can go."""
    match such:
        case Happens(event=Event(actor=Wanted(), object=None) as event):
            return event.action in GOING and event.modal in DUTIES and not event.where
        case Happens(event=Event(action="block", actor=Wanted(), object=Everyone())):
            return True
    return False


def _asks_order(such: Proposition) -> bool:
    """Check whether the question is who goes first, with nobody named."""
    match such:
        case Related(relation="has-priority-over", thing=Wanted(), to=to):
            return number(to) is None
        case Happens(event=Event(actor=Wanted(), modal=None) as event) if event.action in GOING:
            named = event.object is not None and not isinstance(event.object, Ego | Vehicles)
            return "first" in event.manner and not named
        case Happens(event=Event(actor=Wanted(), object=None | Ego() | Wanted()) as event):
            return event.action in LETTING and event.modal in DUTIES
        case Is(state="first", thing=Wanted()):
            return True
        case Is(state="allowed", event=Event(actor=Wanted(), object=None, action=action)):
            return action in GOING
    return False


def _parties(such: Proposition) -> tuple[Thing, ...]:
    """List those of whom the question is who goes first, us or them."""
    match such:
        case Related(relation="has-priority-over", to=Vehicles() as those):
            return (those,)
        case Happens(event=Event(object=Vehicles() as those)):
            return (those,)
    return ()


def _asks_next(such: Proposition) -> bool:
    """Check whether the question is who goes next."""
    match such:
        case Happens(event=Event(actor=Wanted(), object=None, time=Next(), modal=None) as event):
            return event.action in GOING - {"cross", "turn", "pass"}
    return False


def _asks_whom(such: Proposition) -> bool:
    """Check whether the question is whom we must let go first."""
    match such:
        case Happens(event=Event(actor=Ego(), object=Wanted()) as event):
            return event.action in LETTING and event.modal in DUTIES
        case Happens(event=Event(actor=Wanted(), object=Ego()) as event):
            first = event.action in GOING and "first" in event.manner
            return first and event.modal in DUTIES
    return False
