"""Conditions: whether a thing or an event is safe, free, over, fast, close, possible, ..."""

from collections.abc import Callable, Mapping

from msgspec.structs import replace as with_fields

from xavi_dialogue.domain.answers import Answer, Measures, NotApplicable
from xavi_dialogue.domain.facts import Fact, Gap
from xavi_dialogue.domain.meaning import Fault, HowSure, Question, Why
from xavi_dialogue.domain.meaning import Whether as WhetherQuestion
from xavi_dialogue.domain.reasons import Asking
from xavi_dialogue.domain.terms import (
    Destination,
    Ego,
    Event,
    Happens,
    Is,
    Lane,
    Now,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import State
from xavi_dialogue.explain.answers import causal
from xavi_dialogue.explain.answers.events.stages import actor, late, over, still, stuck
from xavi_dialogue.explain.answers.expectations.foreseen import macros
from xavi_dialogue.explain.answers.measuring.closeness import (
    How,
    closeness,
    nearest_such,
    with_somebody,
)
from xavi_dialogue.explain.answers.measuring.limits import fast, within_limit
from xavi_dialogue.explain.answers.propositions.blame import blamed
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.reference.moments import (
    RECENT,
    Window,
    instant,
    is_ahead,
    is_past,
    window,
)
from xavi_dialogue.explain.answers.reference.naming import first_look, is_us, look_of, looks, number
from xavi_dialogue.explain.answers.reference.occasions import (
    did_not_happen,
    occasion,
    occasions,
    taken_place,
)
from xavi_dialogue.explain.answers.ride.comfort import comfort_of, stretch, with_slowing
from xavi_dialogue.explain.answers.ride.mistakes import broken_down, wrong
from xavi_dialogue.explain.answers.ride.places import to_go
from xavi_dialogue.explain.answers.ride.priority import lawful, owed, right_of_way, where_rule_holds
from xavi_dialogue.explain.answers.sight.room import free
from xavi_dialogue.explain.answers.sight.sight import busy, minded
from xavi_dialogue.explain.answers.suppositions.own_suppositions import of_us
from xavi_dialogue.explain.answers.suppositions.undone import (
    GOING,
    HINDERED,
    held,
    is_undone,
    of_now,
)
from xavi_dialogue.explain.causes.plans.options import options_at, risky_onward
from xavi_dialogue.explain.history.thresholds import STANDING

NEAR_GAP = 2.0  # [s] headway below which a vehicle is close
NEAR = 5.0  # [m] distance below which a vehicle beside or crossing is close
HUGGING = 1.0  # [m] distance below which one that we stand behind is too close
BIG = 7.0  # [m] minimum length of a big vehicle
#: Actions that never stop: a question how they feel is about the ride.
GOING_ON = ("follow", "keep-lane", "continue", "move", "stand", "wait")
LATELY = 6.0  # [s] for which an action can still be what "that" refers to
RIGHT_OF_WAY = (
    "enter",
    "turn",
    "exit-left",
    "exit-right",
    "exit-straight",
    "cross",
    "go",
    "merge",
    "pull-out",
    "move",
)


def condition(of: Is, asked: Asked) -> Finding:
    """Weigh that a thing or an event is in a state.

    Raises:
        Unanswered: it is about something unknown, or an event that did not happen.
    """
    return STATES[of.state](of, asked)


def handed(question: Question, asked: Asked) -> Answer | None:
    """Return the answer of the causal explainers, if the question is one of theirs."""
    explainer = causal.explainer(question, asked)
    return None if explainer is None else explainer(question, asked)


def _about(of: Is, asked: Asked) -> Window:
    """Return the stretch of the ride that a state is about: that of its event, if it has one."""
    if of.event is not None:
        found = occasion(asked, of.event)
        if found is not None:
            return stretch(asked, found)
    return window(asked, of.time, of.tense)


def _safe(of: Is, asked: Asked) -> Finding:
    if of.state == "roomy" and isinstance(of.thing, Lane):
        return free(of, asked)
    if of.event is not None and of.tense == "present" and is_us(of.event.actor):
        asked = of_now(of.event, asked)
    how: How = "room" if of.state == "roomy" else "safe" if of.state == "safe" else "dangerous"
    past = is_past(asked, of.time, of.tense) and not is_ahead(asked, of.time, of.tense)
    if of.event is not None and past:
        if not isinstance(of.event.object, Wanted | Vehicles) and not occasions(asked, of.event):
            raise did_not_happen(asked, of.event)
    elif of.event is not None and is_undone(of.event, asked):
        form: Asking = "safe" if of.state == "safe" else "dangerous"
        return Finding(None, answer=of_us(of.event, asked, form))
    elif of.event is not None and _may_go_straight(of.event, asked):
        form = "safe" if of.state == "safe" else "dangerous"
        straight = Event("exit-straight", tense="present", time=Now())
        return Finding(None, answer=of_us(straight, asked, form))
    other = number(of.thing)
    if other is None and of.event is not None:
        other = number(of.event.actor) or number(of.event.object)
    about = _about(of, asked) if past else Window(asked.now, asked.now)
    other = nearest_such(asked, of.thing, about) if other is None else other
    if past and other is None and of.event is None and not about.said:
        about = with_somebody(asked, about)
    return Finding(None, answer=closeness(asked, other, about, how, past=past))


def _may_go_straight(event: Event, asked: Asked) -> bool:
    """Check whether driving on may mean going straight on, which has a risk and is not planned."""
    going = is_us(event.actor) and event.action in GOING and event.tense == "present"
    return going and risky_onward(asked.ride) is not None


def _comfortable(of: Is, asked: Asked) -> Finding:
    if of.event is not None and of.event.action in GOING_ON:
        of = with_fields(of, event=None)
    about, begin = _about(of, asked), asked.world.begin
    if of.event is not None:
        about = with_slowing(asked, taken_place(asked, of.event), about)
    told = of.event is not None or (about.said and about.end < asked.now - RECENT)
    if not told and about.instant and is_past(asked, of.time, of.tense):
        about = Window(max(begin, asked.now - RECENT), asked.now)
    elif not told and about.instant and asked.past is None:
        about = Window(begin, asked.now)
    found = with_fields(comfort_of(asked, about), deed=of.event is not None)
    return Finding(found.hard == (of.state == "uncomfortable"), answer=found)


def _allowed(of: Is, asked: Asked) -> Finding:
    """Return what the rules of the road say: the limit for speed, else the right of way."""
    event = of.event
    if event is None and of.thing is None:
        about = _about(of, asked) if is_past(asked, of.time, of.tense) else None
        return Finding(None, answer=lawful(asked, about))
    if event is not None and event.action in RIGHT_OF_WAY and not _of_speed(event):
        past = is_past(asked, of.time, of.tense)
        now = Window(asked.now, asked.now)
        about = where_rule_holds(asked, _about(of, asked)) if past else now
        found = right_of_way(asked, event.object, event.actor, about)
        if of.tense == "past" and is_us(event.actor) and found.rule != "priority":
            return Finding(None, answer=found)  # who had to yield, and who went: no verdict
        if found.rule != "none" or "first" in event.manner:
            return owed(found, ours_yield=not is_us(event.actor))
    limited = within_limit(asked, actor(of), instant(asked, of.time, of.tense), allowed=True)
    fast = limited.holds is False and event is not None and not is_us(event.actor)
    if event is not None and not _of_speed(event) and not fast:
        about = _about(of, asked) if is_past(asked, of.time, of.tense) else None
        return Finding(None, answer=lawful(asked, about, number(event.actor)))
    return limited


def _of_speed(event: Event) -> bool:
    """Check whether an event is an action that is named by its speed."""
    return "fast" in event.manner or "slowly" in event.manner


def _judged(of: Is, asked: Asked) -> Finding:
    """Hand the question whether it was necessary, worth it or better to the causal explainers."""
    for question in (
        WhetherQuestion(of),
        *(() if of.event is None else (Why(Happens(of.event)),)),
    ):
        answer = handed(question, asked)
        if answer is not None:
            return Finding(None, answer=answer)
    return unknown("not-recorded")


def _amiss(of: Is, asked: Asked) -> Finding:
    """Return what hinders us now, or that nothing does, if the question is whether all is well."""
    if of.thing is not None or of.event is not None:
        return wrong(of, asked)
    plainest = min((e.action for e in held(asked)), key=HINDERED.index, default=None)
    why = None if plainest is None else Why(Happens(Event(plainest, tense="present")))
    answer = None if why is None else handed(why, asked)
    if answer is None:
        return _safe(with_fields(of, state="dangerous"), asked)
    return Finding(None, answer=answer)


def _usual(of: Is, asked: Asked) -> Finding:
    """Weigh that what we did is normal: that nothing went wrong in it."""
    ours = of.event is not None and is_us(of.event.actor)
    return wrong(of, asked) if ours else unknown("not-recorded")


def _possible(of: Is, asked: Asked) -> Finding:
    """Weigh that an action is possible: that the decision had it among its options."""
    if of.event is None:
        return unknown("not-recorded")
    names = macros(of.event)
    at = instant(asked, of.time, of.tense)
    trace = asked.ride.at(at)
    if trace is None or not names:
        return unknown("not-recorded")
    options = [o for o in options_at(asked.ride, at) if o.action in names]
    if options:
        return Finding(True, tuple(options))
    for entry in trace.not_applicable:
        if not entry.node and entry.action in names:
            raise Unanswered(NotApplicable((entry.action,), entry.reason, trace.sim_time))
    return Finding(False if trace.under_way is not None else None, gap="not-recorded")


def _seen(of: Is, asked: Asked) -> Finding:
    """Weigh that somebody is in view, hidden or lost."""
    vehicle = number(actor(of))
    about = window(asked, of.time, of.tense)
    if isinstance(of.thing, Vehicles):
        wanted = of.state in ("visible", "present")
        every = looks(asked, of.thing.numbers, about.end)
        others = tuple(look for look in every if look.in_view != wanted)
        return Finding(not others, others or every)
    if vehicle is None:
        return unknown("not-sensed" if not is_us(actor(of)) else "not-applicable")
    look = asked.world.look(vehicle, about.end)
    if look is None:
        first = first_look(asked, vehicle, about.end)
        return Finding(of.state in ("hidden", "lost"), () if first is None else (first,))
    hidden = asked.world.measure("visibility", Vehicle(vehicle), about.end)
    told = () if hidden.word == "lost" else known(hidden)  # the look says when it was seen last
    facts: tuple[Fact, ...] = (look, *told)
    return Finding(look.in_view == (of.state in ("visible", "present")), facts)


def _is_told(asked: Asked) -> bool:
    """Check whether the passenger named the time."""
    return asked.past is not None and asked.past.said


def _close(of: Is, asked: Asked) -> Finding:
    if isinstance(of.thing, Destination):
        return Finding(None, answer=Measures(to_go(asked, asked.now)))
    vehicle = number(actor(of))
    past = is_past(asked, of.time, of.tense)
    about = _about(of, asked) if past else Window(asked.now, asked.now)
    if past:
        if vehicle is not None and asked.now - about.end <= LATELY and not _is_told(asked):
            about = Window(about.begin, asked.now)  # the closest approach may just be over
        if vehicle is None and of.event is None and not about.said:
            about = with_somebody(asked, about)
        return Finding(None, answer=closeness(asked, vehicle, about, "close"))
    if vehicle is None:
        return Finding(None, answer=closeness(asked, None, about, "close", past=False))
    other = Vehicle(vehicle)
    gap, headway, distance = (
        asked.world.measure(a, Ego(), asked.now, other) for a in ("gap", "headway", "distance")
    )
    if distance.value is None and of.state == "far" and not asked.ride.arrived:
        return Finding(None, answer=Measures(to_go(asked, asked.now)))  # "is it a long way?"
    if distance.value is None:
        return unknown(distance.gap or "out-of-view")
    speed = asked.world.measure("speed", Ego(), asked.now).value
    if of.too and of.state == "close" and speed is not None and speed < STANDING:
        return Finding(distance.value < HUGGING, known(distance))  # as in any queue
    if headway.value is not None:
        if of.too and NEAR_GAP / 2.0 <= headway.value < NEAR_GAP:
            return Finding(None, answer=Measures(known(gap, headway)))  # a matter of opinion
        near = headway.value < (NEAR_GAP if not of.too else NEAR_GAP / 2.0)
        return Finding(near == (of.state == "close"), known(gap, headway))
    return Finding((distance.value < NEAR) == (of.state == "close"), known(distance))


def _sure(of: Is, asked: Asked) -> Finding:
    done = Event("do", Ego(), tense="past") if of.tense in ("past", "perfect") else None
    event = of.event or done  # "were you ever unsure?": of what we did
    about = None if event is None else Happens(event)
    return Finding(None, answer=handed(HowSure(about, of.time), asked))


def _at_fault(of: Is, asked: Asked) -> Finding:
    about = None if of.event is None else Happens(of.event)
    return Finding(None, answer=blamed(Fault(about, of.thing), asked))


def _first(of: Is, asked: Asked) -> Finding:
    about = where_rule_holds(asked, _about(of, asked))
    other = None if is_us(actor(of)) else actor(of)
    found = right_of_way(asked, other, Ego(), about)
    if found.first is None:
        return Finding(None, answer=found)
    ours = isinstance(found.first, Ego)
    first = ours == is_us(actor(of))
    return Finding(first == (of.state == "first"), answer=found)


def _big(of: Is, asked: Asked) -> Finding:
    size = asked.world.measure("size", actor(of), asked.now)
    if size.value is None:
        return unknown(size.gap or "not-recorded")
    look = look_of(asked, actor(of), asked.now)
    return Finding(size.value >= BIG, (size, *(() if look is None else (look,))))


def _constant(holds: bool | None, gap: Gap | None = None) -> Callable[[Is, Asked], Finding]:
    return lambda of, asked: Finding(holds, gap=gap)


STATES: Mapping[State, Callable[[Is, Asked], Finding]] = {
    "safe": _safe, "dangerous": _safe, "roomy": _safe,
    "comfortable": _comfortable, "uncomfortable": _comfortable,
    "allowed": _allowed, "necessary": _judged, "worth-it": _judged, "better": _judged,
    "possible": _possible, "free": free,
    "visible": _seen, "hidden": _seen, "present": _seen, "lost": _seen,
    "astray": _constant(None, "others-thoughts"),
    "stationary": still, "moving": still,
    "fast": fast, "slow": fast, "close": _close, "far": _close,
    "sure": _sure, "over": over, "late": late, "stuck": stuck,
    "wrong": _amiss, "right": _amiss, "at-fault": _at_fault,
    "first": _first, "last": _first, "big": _big, "busy": busy,
    "normal": _usual,
    "dirty": _constant(None, "not-sensed"),
    "faulty": broken_down,
    "awake": minded, "upset": minded,
    "autonomous": _constant(True),
}  # fmt: skip
