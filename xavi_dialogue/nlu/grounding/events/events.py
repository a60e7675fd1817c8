"""Events: who did what, and when: matched with the episodes of the record."""

from dataclasses import replace as replaced
from typing import Final

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    At,
    AtDecision,
    Between,
    Described,
    Ego,
    Event,
    Everyone,
    Feature,
    Junction,
    Nobody,
    Pronoun,
    Related,
    Relative,
    Thing,
    Time,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.facts.episodes.lead_in import held_since
from xavi_dialogue.nlu.grounding.completion.discussion import discussed, events
from xavi_dialogue.nlu.grounding.context import Fits, Grounder, Mode, Window
from xavi_dialogue.nlu.grounding.events.afoot import afoot
from xavi_dialogue.nlu.grounding.events.fitting import (
    JUST,
    LASTING,
    LATELY,
    ONGOING,
    acting,
    done,
    gentle_too,
    hard_ones,
    held_in,
    is_open,
    searched,
    undergoing,
)
from xavi_dialogue.nlu.grounding.events.generic import ahead_of, specified
from xavi_dialogue.nlu.grounding.events.hiding import out_of
from xavi_dialogue.nlu.grounding.events.present import (
    HALTS,
    going_on,
    halts_again,
    is_next,
    is_over,
    is_present,
)
from xavi_dialogue.nlu.grounding.kin import like
from xavi_dialogue.nlu.grounding.salience import vehicles_of
from xavi_dialogue.nlu.grounding.things.pronouns import apart, walks

#: What is meant by going left or right where we did not turn off.
SIDEWAYS: Final[dict[ActionName, ActionName]] = {
    "exit-left": "change-left", "exit-right": "change-right",
}  # fmt: skip
_HELD: Final = frozenset(("wait", "stand", "stop", "give-way", "brake", "slow-down", "let-go"))
_TURNS: Final = frozenset(("turn", "exit-left", "exit-right", "exit-straight"))
UNMET: Final = 0.5  # cost of taking for granted what never happened
NEARLY: Final = 0.2  # ... where something like it did
ELSEWHEN: Final = 0.3  # ... where it happened, but at another time
UNSEEN: Final = 0.05  # cost of asking after what did not happen
DENIED: Final = 0.2  # cost of taking for granted that something did not happen that did
BEFORE: Final = 4.0  # [s] for which who has left a roundabout was still on it before
FRESH: Final = 10.0  # [s] that "why didn't you" reaches back


def event(spoken: Event, mode: Mode, g: Grounder, outer: Window | None = None) -> Event:
    """Ground an event: its actor, its object and its time."""
    spoken = ahead_of(completed(_by_anybody(spoken), g, mode), g)
    spoken = afoot(out_of(_at_junction(spoken), g), g)
    spoken = _by_us(spoken, g)
    if spoken.action == "signal" and isinstance(spoken.object, Pronoun):
        spoken = replace(spoken, object=None)  # "when did you put it on?": the indicator
    if (spoken.tense == "future" or spoken.modal == "must") and _meanwhile(spoken.time):
        spoken = replace(spoken, time=Unsaid())
    window = _window(spoken, mode, g, outer)
    real = mode != "supposed" and not window.ahead and spoken.modal in (None, "must", "want")
    # "Is it braking?" is of whom was spoken of, and "is the one ahead braking?" of the next one.
    open_ = mode == "asked" and spoken.tense == "present" and _pointed_at(spoken.actor)
    open_ |= spoken.action == "go" and not spoken.manner and isinstance(spoken.actor, Pronoun)
    order = "first" in spoken.manner and spoken.tense == "present"  # whether they do is open
    lately = is_open(spoken.actor, mode, window)
    fits = done(acting(spoken, g, window, lately), g, lately)
    actor = _somebody(spoken.actor, g, window, real and not open_ and not order, fits)
    if spoken.where is not None and spoken.where.thing == spoken.actor:
        spoken = replace(spoken, where=replace(spoken.where, thing=actor))
    spoken = afoot(replace(spoken, actor=actor), g)
    target = spoken.object
    if target is not None:
        other = apart(target, actor, g)
        spoken_of = target
        lately = is_open(target, mode, window)
        fits = done(undergoing(spoken, g, window, lately), g, lately)
        target = _somebody(target, other, window, real and not order, fits)
        if isinstance(target, Nobody) and _pictured(spoken_of):
            target = other.thing(spoken_of, window)  # "you pulled out in front of a lorry"
    elif spoken.action == "leave":
        target = _left(actor, g, window)
    found = specified(replace(spoken, object=target, where=_where(spoken, g, window)), window, g)
    if spoken.then is not None:
        found = replace(found, then=event(spoken.then, "supposed", g, window))
    if not real or (order and isinstance(actor, Wanted)):  # who goes first now, not who has
        if outer is None and (window.said or (window.ahead and mode != "supposed")):
            g.notes.spans(window.span)
        return replace(found, time=window.term)
    return _placed(found, mode, g, window, outer is not None and not outer.said)


def _pointed_at(thing: Thing) -> bool:
    """Tell whether somebody is known by a pronoun, or by being next before or behind us."""
    if isinstance(thing, Described):
        plain = Described(kind=thing.kind, definite=thing.definite, bearing=thing.bearing)
        return thing == plain and thing.definite and thing.bearing in ("ahead", "behind")
    return isinstance(thing, Pronoun)


def _by_us(spoken: Event, g: Grounder) -> Event:
    """Take "it" in "what's it slowing down for" for our car, if we do so and no other is named."""
    held = spoken.action in _HELD or (spoken.action == "move" and "slowly" in spoken.manner)
    now, ours = g.context.now, replace(spoken, actor=Ego())
    if spoken.actor == Pronoun("that") and held and g.context.holds(ours, now - LATELY, now):
        return ours  # "that was hard braking"
    if spoken.actor != Pronoun("it") or not held or spoken.tense != "present":
        return spoken
    others = [pair for pair in vehicles_of(g.context.discourse.mentions) if not walks(pair[0], g)]
    if any(salience > 1.0 for _, salience in others) or not g.context.holds(ours, now, now):
        return spoken
    others.sort(key=lambda pair: -pair[1])
    told = (replace(spoken, actor=Vehicle(number)) for number, _ in others[:1])
    return spoken if any(g.context.holds(one, now - JUST, now) for one in told) else ours


def _by_anybody(spoken: Event) -> Event:
    """Take what one has to do for what we have to: "does one always have to wait for them?"."""
    if spoken.actor != Described() or spoken.modal not in ("must", "should"):
        return spoken
    whom = spoken.object
    many = whom == Pronoun("they") or (isinstance(whom, Described) and whom.plural)
    here = isinstance(spoken.time, Relative) and isinstance(spoken.time.anchor, Junction)
    return replace(
        spoken, actor=Ego(), object=Everyone() if many else whom,
        time=Unsaid() if here else spoken.time,
    )  # fmt: skip


def _meanwhile(time: Time) -> bool:
    """Tell whether something to come is said to be while something else is: "while we go"."""
    if not isinstance(time, Relative) or not isinstance(time.anchor, Event):
        return False
    return time.relation == "during" and time.anchor.tense in ("present", "future")


def completed(spoken: Event, g: Grounder, mode: Mode = "asked") -> Event:
    """Put the event under discussion in the place of "do": what was really done where granted."""
    vague = spoken.object is None or isinstance(spoken.object, Pronoun)
    if spoken.action != "do" or not vague:
        return spoken
    actor = spoken.actor
    if isinstance(actor, Pronoun):
        actor = g.thing(actor, g.window(spoken.time, spoken.tense))
    real = mode == "presupposed" or (mode == "asked" and spoken.object is None)
    real = real and spoken.modal is None and spoken.tense != "future"
    said = isinstance(spoken.time, At | AtDecision)
    if said and all(one.actor != actor for one in events(g.context.discourse, real=real)):
        return spoken  # "how sure were you of what you did at 40 s?"
    known = discussed(g.context, actor, real=real) or discussed(g.context, real=real)
    if known is None:
        return spoken
    g.notes.leaned = True
    over = known.tense == "future" and spoken.tense in ("past", "perfect") and spoken.modal is None
    time = known.time if isinstance(spoken.time, Unsaid) and not over else spoken.time
    return replace(
        known, actor=actor, time=time, tense=spoken.tense, modal=spoken.modal,
        manner=spoken.manner or known.manner,
    )  # fmt: skip


def _window(spoken: Event, mode: Mode, g: Grounder, outer: Window | None) -> Window:
    if outer is not None and outer.said and isinstance(spoken.time, Unsaid):
        return outer
    tense = "past" if spoken.tense == "perfect" and mode != "asked" else spoken.tense
    found = g.window(spoken.time, tense)
    match spoken.time:
        case Relative(relation="during", anchor=Junction()) if spoken.action in _HELD:
            return _before_entering(found, g)
    return found


def _at_junction(spoken: Event) -> Event:
    """Take the junction at which something was done, by its rank, for when that was."""
    place, past = spoken.object, spoken.tense in ("past", "perfect")
    if not isinstance(place, Junction) or place.rank is None or not past:
        return spoken
    if spoken.action not in _HELD | _TURNS or not isinstance(spoken.time, Unsaid):
        return spoken
    return replace(spoken, object=None, time=Relative("during", place))


def _before_entering(found: Window, g: Grounder) -> Window:
    """Add to the time of a junction how we came to it: who waits there has not entered it yet."""
    since = held_since(g.context.deeds(Ego(), g.context.begin, found.begin), found.begin)
    if since == found.begin:
        return found
    search = (since, found.search[1])
    return replaced(found, begin=since, search=search, term=Between(since, found.end))


def _pictured(thing: Thing) -> bool:
    """Tell whether somebody is described well enough to be known by his looks alone."""
    one = isinstance(thing, Described) and not thing.plural and not thing.definite
    return one and isinstance(thing, Described) and thing.kind not in ("vehicle", "car")


def _somebody(thing: Thing, g: Grounder, window: Window, real: bool, fits: Fits) -> Thing:
    if not real and isinstance(thing, Described) and not thing.definite:
        return Nobody(described=thing)
    if isinstance(thing, Described | Pronoun):
        return g.thing(thing, window, fits if real else None)
    return g.thing(thing, window)


def _left(actor: Thing, g: Grounder, window: Window) -> Junction | None:
    """Give the roundabout that somebody is on, or was just before: it is what "leave" leaves."""
    number = actor.number if isinstance(actor, Vehicle) else EGO if isinstance(actor, Ego) else None
    moment = min(window.begin if window.said else window.end, g.context.now)
    for time in (moment, moment - BEFORE, g.context.now, g.context.now - BEFORE):
        road = None if number is None or time < g.context.begin else g.context.world.road(time)
        place = None if road is None else road.places.get(number)  # type: ignore[arg-type]
        if place is not None and place.roundabout:
            return Junction("roundabout")
    return None


def _where(spoken: Event, g: Grounder, window: Window) -> Related | None:
    where = spoken.where
    if where is None or (spoken.action in HALTS and where.to == Feature("line")):
        return None  # where we stood is no more than that: at the line
    thing = where.thing if isinstance(where.thing, Wanted) else g.thing(where.thing, window)
    return replace(where, thing=thing, to=g.thing(where.to, window), time=window.term)


def _placed(found: Event, mode: Mode, g: Grounder, window: Window, inner: bool) -> Event:
    """Find the episode that an event is, and note whether what is taken for granted holds."""
    held, window = held_in(found, window, g)
    if mode == "denied":
        return _denied(found, g, window)
    held = gentle_too(held, found, window, g) if mode == "presupposed" else held
    aside = mode == "asked" and found.tense == "present"  # "now we are going further left?"
    if not held and (mode == "presupposed" or aside) and found.action in SIDEWAYS:
        moved = replace(found, action=SIDEWAYS[found.action])  # "left again, what is that for"
        if isinstance(found.actor, Ego) and (held := g.context.holds(moved, *searched(g, window))):
            found = moved
    present = mode == "asked" and found.tense == "present" and is_present(window)
    now = present and not window.said
    if held and now and found.action in ONGOING | LASTING:  # "are we speeding up?"
        held = tuple(e for e in held if e.end is None or e.end >= g.context.now - JUST)
    if mode == "asked" and window.prefer == "nearest" and found.action in ("move", "stand"):
        held = tuple(e for e in held if _off(e, window.begin, g.context.now) <= JUST)
    if held and is_present(window) and not window.said and halts_again(found, held[-1], g):
        return replace(found, time=window.term)
    if held:
        return _at(found, _pick(hard_ones(held, found, window), window, g), g, window, inner)
    granted = mode == "presupposed"
    if not window.said and window.term != Unsaid() and is_present(window):
        late = g.context.holds(found, *searched(g, window))
        late = going_on(found, g) if late and is_over(late[-1], g) else late
        if late and granted:
            return _at(found, late[-1], g, window, inner)
    if not inner:
        g.notes.spans(window.span) if window.said or is_present(window) else None
    if not granted:
        g.notes.cost += UNSEEN
        return replace(found, time=window.term)
    g.notes.presupposed = False
    if window.said and g.context.holds(found, g.context.begin, g.context.now):
        g.notes.cost += ELSEWHEN
        return replace(found, time=window.term)
    near = like(g.context, found, *searched(g, window))
    if not near:
        g.notes.cost += 0.0 if is_next(found, g) else UNMET
        return replace(found, time=window.term)
    g.notes.cost += NEARLY
    return _at(found, _pick(near, window, g), g, window, inner)


def _at(found: Event, episode: Episode, g: Grounder, window: Window, inner: bool) -> Event:
    end = g.context.now if episode.end is None else episode.end
    found = replace(found, speeds=None)
    if not inner:
        g.notes.spans(Span(begin=episode.begin, end=end, said=window.said))
    if window.whole and window.rank is None:
        return replace(found, time=window.term)
    under_way = episode.end is None or episode.end >= g.context.now - 0.5
    if is_present(window) and under_way:
        return replace(found, time=window.term)
    return replace(found, time=Between(episode.begin, end))


def _pick(found: tuple[Episode, ...], window: Window, g: Grounder) -> Episode:
    """Choose the episode that is meant: by rank, by time, in focus, else the last one."""
    if window.rank is not None:
        index = window.rank - 1 if window.rank > 0 else len(found) + window.rank
        return found[min(max(index, 0), len(found) - 1)]
    if window.prefer == "nearest":
        return min(found, key=lambda e: (_off(e, window.begin, g.context.now), -e.begin))
    if window.prefer == "first":
        inside = [e for e in found if e.begin >= window.search[0]]
        return (inside or list(found))[0]
    focus = g.context.discourse.episode
    if window.said or focus is None:
        return found[-1]
    asked = g.context.discourse.asked_at
    if asked is not None and found[-1].begin > asked:
        return found[-1]
    near = [e for e in found if e.begin <= focus[1] and (e.end or g.context.now) >= focus[0]]
    return (near or list(found))[-1]


def _off(episode: Episode, time: float, now: float) -> float:
    end = now if episode.end is None else episode.end
    return max(episode.begin - time, time - end, 0.0)


def _denied(found: Event, g: Grounder, window: Window) -> Event:
    """Note where something did happen that is said not to have."""
    focus = g.context.discourse.episode
    if window.said:
        search = window.search
    else:
        search = focus if focus is not None else (g.context.now - FRESH, g.context.now)
        if focus is not None and not is_present(window):
            g.notes.spans(Span(begin=focus[0], end=focus[1]))
    if g.context.holds(found, *search):
        g.notes.cost += DENIED
        g.notes.presupposed = False
    if window.said:
        g.notes.spans(window.span)
    return replace(found, time=window.term)
