"""Weighing: a proposition of any kind against the record."""

from collections.abc import Iterable

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Measures, Priority, Verdict
from xavi_dialogue.domain.facts import Episode, Fact, Look, Measure, Relating
from xavi_dialogue.domain.meaning import Whither, Why
from xavi_dialogue.domain.terms import (
    Believed,
    Both,
    Caused,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Measured,
    Nobody,
    Not,
    Now,
    Proposition,
    Related,
    That,
    Thing,
    Time,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import Relation
from xavi_dialogue.explain.answers.events.acting import activity
from xavi_dialogue.explain.answers.events.beliefs import foreknown, time_of
from xavi_dialogue.explain.answers.events.happens import happens
from xavi_dialogue.explain.answers.expectations.foreseen import macros
from xavi_dialogue.explain.answers.expectations.plans import plan_ahead
from xavi_dialogue.explain.answers.measuring.durations import stands
from xavi_dialogue.explain.answers.owing import is_rule
from xavi_dialogue.explain.answers.propositions.alternatives import (
    acts_now,
    feared,
    is_our_course,
    lets_us,
    spares,
    stops,
)
from xavi_dialogue.explain.answers.propositions.comparisons import compares, has
from xavi_dialogue.explain.answers.propositions.conditions import condition, handed
from xavi_dialogue.explain.answers.propositions.duties import (
    MAY,
    duty,
    is_owed,
    of_order,
    who_first,
)
from xavi_dialogue.explain.answers.propositions.halting import stop_or_go
from xavi_dialogue.explain.answers.propositions.measures import values
from xavi_dialogue.explain.answers.propositions.relations import related
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, unknown
from xavi_dialogue.explain.answers.reference.moments import instant, is_past
from xavi_dialogue.explain.answers.reference.naming import first_look, is_us, number
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.answers.ride.conduct import conduct
from xavi_dialogue.explain.answers.ride.existing import exists
from xavi_dialogue.explain.answers.ride.places import locate, whither
from xavi_dialogue.explain.answers.sight.room import in_our_way_ahead
from xavi_dialogue.explain.answers.suppositions.pulling_up import pulls_up
from xavi_dialogue.explain.history.ride import planned

#: Relations that say where a thing is from another one.
BEARINGS: frozenset[Relation] = frozenset(
    ("ahead-of", "behind", "left-of", "right-of", "beside", "oncoming-to")
)


def weigh(of: Proposition, asked: Asked) -> Finding:
    """Weigh a proposition against the record.

    Raises:
        Unanswered: it is about something unknown, or what did not happen; or it needs rollouts.
    """
    match of:
        case Happens(event=event) if _may_go(event, asked):
            going = replace(event, modal=None)
            return condition(Is("allowed", None, going, time=event.time), asked)
        case Happens(event=event):
            owed = pulls_up(asked, event) or duty(asked, event) or conduct(asked, event)
            return owed or happens(of, asked)
        case Related(thing=Nobody(described=None)):
            return _nobody(of, asked)
        case Related():
            return related(of, asked)
        case Is():
            return condition(of, asked)
        case Has():
            return has(of, asked)
        case Compares():
            return compares(of, asked)
        case Exists():
            return exists(of, asked)
        case Caused():
            return _caused(of, asked)
        case Believed():
            return _believed(of, asked)
        case Not():
            return _contrary(weigh(of.content, asked))
        case Both():
            return _joined(of, asked)
        case That():
            return unknown("not-recorded")


def _may_go(event: Event, asked: Asked) -> bool:
    """Check whether it is asked if we, who stand, may go now: what is allowed, not what we do."""
    now = event.tense == "present" and asked.past is None and isinstance(event.time, Unsaid | Now)
    plain = event.action in ("go", "move") and event.object is None and not event.manner
    return plain and now and is_us(event.actor) and event.modal in MAY and stands(asked)


def _nobody(of: Related, asked: Asked) -> Finding:
    """Weigh that nobody stands in a relation; else return who does."""
    at = instant(asked, of.time, of.tense)
    each = [related(replace(of, thing=Vehicle(v)), asked) for v in asked.world.in_view(at)]
    seen = [fact for one in each if one.holds for fact in one.facts if isinstance(fact, Look)]
    if of.relation == "ahead-of" and isinstance(of.to, Ego):
        seen = in_our_way_ahead(asked, seen, at)  # and not in another lane
    if not seen:
        return Finding(True)
    nearest = min(seen, key=lambda look: look.distance)
    there = Not(replace(of, thing=Vehicle(nearest.vehicle)))
    return Finding(False, answer=Verdict(there, False, (nearest,), claim=True))


def _contrary(found: Finding) -> Finding:
    return found.negated() if found.holds is not None or found.answer is None else found


def _joined(of: Both, asked: Asked) -> Finding:
    """Weigh several propositions together: all must hold, or one of them."""
    if len(set(of.contents)) == 1:
        return weigh(of.contents[0], asked)
    if (hit := feared(of, asked)) is not None:
        spared = next((part for part in of.contents if spares(part)), None)
        return weigh(spared if of.join == "or" and spared is not None else hit, asked)
    if of.join == "or" and (halting := stop_or_go(of, asked)) is not None:
        return halting
    if of.join == "or" and (first := of_order(of)) is not None:
        rule = who_first(asked, first)
        if rule is not None and rule.rule == "none" and (let := lets_us(of)) is not None:
            theirs = weigh(let, asked)
            return Finding(None, answer=theirs.answer or theirs.verdict(let))
        if rule is not None and (rule.rule != "none" or rule.vehicle is not None):
            return Finding(None, answer=replace(rule, holds=None))
    if of.join == "or" and (held := stops(of)) is not None:
        return _open_to_all(weigh(held, asked))
    owed = next((part for part in of.contents if is_owed(part)), None)
    if owed is None and of.join == "or":
        owed = next((part for part in of.contents if is_rule(part)), None)
    if owed is not None:  # the rule decides, also for what else is asked
        return _open_to_all(weigh(owed, asked)) if of.join == "or" else weigh(owed, asked)
    if of.join == "or" and (chosen := either(of, asked)) is not None:
        return chosen
    found = [weigh(part, asked) for part in of.contents]
    holds = [one.holds for one in found]
    if of.join == "or" and not any(holds) and is_our_course(of, asked):
        return Finding(None, answer=plan_ahead(asked))
    failing = [(p, one) for p, one in zip(of.contents, found, strict=True) if one.holds is False]
    if of.join == "and" and len(failing) == 1:  # the part that fails is what makes it false
        part, one = failing[0]
        return Finding(False, one.facts, answer=one.answer or one.verdict(part))
    decided = of.join != "and"
    whole = decided if decided in holds else (None if None in holds else not decided)
    told = [one for one in found if of.join == "and" or one.holds or whole is not True]
    deeds = whole is False and all(isinstance(part, Happens) for part in of.contents)
    facts = () if deeds else _told_once(fact for one in told for fact in one.facts)
    gap = next((one.gap for one in found if one.gap is not None), None) if whole is None else None
    believed = tuple(belief for one in told for belief in one.believed)
    return Finding(whole, facts, gap, believed, any(one.mistaken for one in told))


def _told_once(facts: Iterable[Fact]) -> tuple[Fact, ...]:
    """Leave out facts that the clauses deny already, and second places of a vehicle."""
    found: dict[object, Fact] = {}
    for fact in facts:
        if isinstance(fact, Relating) and not fact.holds:
            continue
        of_place = isinstance(fact, Measure) and fact.attribute in ("distance", "gap")
        key = isinstance(fact, Look) or of_place
        found.setdefault("place" if key else fact, fact)
    return tuple(found.values())


def _open_to_all(found: Finding) -> Finding:
    """Return a finding without yes or no, for a question which of several holds."""
    if not isinstance(found.answer, Priority):
        return found
    return Finding(None, answer=replace(found.answer, holds=None))


def either(of: Both, asked: Asked) -> Finding | None:
    """Return which of several holds: a place or a value as such, else the one that does.

    None if none of them does, or it cannot be known.
    """
    first = of.contents[0] if of.contents else None
    match first:
        case Related(thing=Vehicle()) if all(_placed(p, first.thing) for p in of.contents):
            if not is_past(asked, first.time, first.tense):
                return Finding(None, answer=locate(asked, first.thing, asked.now))
        case Has() if all(_alike(part, first) for part in of.contents):
            measured = Measured(first.attribute, first.thing, time=first.time, tense=first.tense)
            return Finding(None, answer=Measures(values(asked, measured)))
    found = [(part, weigh(part, asked)) for part in of.contents]
    if isinstance(first, Compares) and all(one.holds is False for _, one in found):
        same = replace(first, comparator="same")  # "is it shrinking or growing?"
        told = Finding(True, found[0][1].facts)
        return Finding(True, told.facts, answer=replace(told.verdict(same), either=True))
    likely = [(p, one) for p, one in found if one.holds]
    on = [(p, one) for p, one in likely if _is_under_way(p, one)]
    likely = on if len(on) == 1 else likely
    if not on and (actor := acts_now(of)) is not None and asked.past is None:
        return Finding(None, answer=activity(asked, actor, asked.now))
    deeds = [part for part, _ in likely if isinstance(part, Happens)]
    rules = [one for _, one in likely if isinstance(one.answer, Priority)]
    if len(likely) > 1 and rules:
        return _open_to_all(rules[0])  # "do we let him go, or does he turn off?"
    if len(likely) > 1 and len(likely) == len(found) == len(deeds):
        both = replace(of, join="and")
        return Finding(True, answer=replace(Finding(True).verdict(both), either=True))
    if len(likely) != 1:
        return _way_of(of, asked)
    part, one = likely[0]
    answer = one.answer or replace(one.verdict(part), either=True)
    return Finding(True, one.facts, answer=answer)


def _is_under_way(part: Proposition, found: Finding) -> bool:
    """Check whether an action that is asked about in the present goes on."""
    present = isinstance(part, Happens) and part.event.tense == "present"
    return present and any(isinstance(f, Episode) and f.end is None for f in found.facts)


def _way_of(of: Both, asked: Asked) -> Finding | None:
    """Return where another vehicle is going, for a question which of several ways it takes."""
    events = [part.event for part in of.contents if isinstance(part, Happens)]
    ahead = all(event.tense in ("present", "future") for event in events)
    actors = {event.actor for event in events}
    actor = next(iter(actors), None)
    if len(events) < len(of.contents) or len(actors) != 1 or not ahead or asked.past is not None:
        return None
    if not isinstance(actor, Vehicle):
        return None
    return Finding(None, answer=whither(Whither(actor), asked))


def _placed(of: Proposition, thing: Thing) -> bool:
    """Check whether a proposition says where a thing is from us."""
    return isinstance(of, Related) and of.relation in BEARINGS and of.thing == thing


def _alike(of: Proposition, first: Has) -> bool:
    return isinstance(of, Has) and (of.attribute, of.thing) == (first.attribute, first.thing)


def _caused(of: Caused, asked: Asked) -> Finding:
    """Hand a question whether something is the cause to the causal explainers."""
    effect = of.effect if of.effect is not None else That()
    suspect = _suspect(of)
    answer = handed(Why(effect, suspect=suspect), asked)
    if answer is not None:
        return Finding(None, answer=answer)
    return unknown("not-recorded")


def _suspect(of: Caused) -> Thing | None:
    """Return the supposed cause; for a fact, the one that it is about."""
    match of.cause:
        case Happens(event=event):
            return event.actor
        case Related(thing=thing):
            return thing
        case Is(thing=thing) | Exists(thing=thing):
            return thing
        case Has(thing=thing):
            return thing
        case Compares(left=left):
            return left.thing
        case Caused() | Believed() | Not() | Both() | That():
            return None
    return of.cause


def _believed(of: Believed, asked: Asked) -> Finding:
    """Weigh that we believed something, by its probability for us at that time."""
    content, negated = of.content, False
    while isinstance(content, Not):
        content, negated = content.content, not negated
    found = _held(of, content, asked)
    return found.negated() if negated else found


def _held(of: Believed, content: Proposition, asked: Asked) -> Finding:
    time = of.time if not isinstance(of.time, Unsaid) else time_of(content)
    match content:
        case Happens(event=event) if number(event.actor) is not None and event.action != "see":
            return foreknown(asked, event, time)
        case Happens(event=event) if is_us(event.actor) and macros(event):
            return _planned(asked, event, time)
        case Exists(thing=thing) | Is(thing=thing, state="present" | "visible"):
            if number(thing) is not None:
                return _saw(asked, number(thing) or 0, time)
    return weigh(content, asked)


def _planned(asked: Asked, event: Event, time: Time) -> Finding:
    """Weigh that we planned to do something at that time."""
    at = instant(asked, time, "past")
    trace = asked.ride.at(at)
    if trace is None:
        return unknown("before-record")
    meant = any(step in macros(event) for step in planned(trace))
    done = occasion(asked, event)
    return Finding(meant, () if done is None else (done,))


def _saw(asked: Asked, vehicle: int, time: Time) -> Finding:
    """Weigh that we knew of a vehicle, and since when."""
    at = instant(asked, time, "past")
    first = first_look(asked, vehicle, asked.world.begin)
    if first is None:
        return Finding(False)
    return Finding(first.time <= at, (first,))
