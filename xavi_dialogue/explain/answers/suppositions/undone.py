"""Undone: what we could do now, but do not, and by which decision it is judged."""

from dataclasses import replace

from msgspec import structs

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Question, Whether
from xavi_dialogue.domain.reasons import Asking
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Proposition,
    Related,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.foils import MANOEUVRES
from xavi_dialogue.explain.answers.reference.naming import is_us
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.answers.reference.reading import event_of, is_own, is_past, manner_of
from xavi_dialogue.explain.causes.plans.options import risky_onward
from xavi_dialogue.explain.causes.vehicles.actions import names_of
from xavi_dialogue.explain.causes.vehicles.when import ROUNDING
from xavi_dialogue.explain.history.ride import planned

GOING = frozenset[ActionName](("go", "move", "enter", "cross", "speed-up", "continue"))
#: Actions of ours because of a hindrance, in the order in which people notice them.
HINDERED: tuple[ActionName, ...] = ("stand", "stop", "brake", "slow-down", "wait", "give-way")
TURNING = frozenset[ActionName](("turn", "exit-left", "exit-right", "leave"))
HALTED = frozenset[ActionName](("stand", "wait", "stop"))
LATELY = 12.0  # [s] maximum age of a braking that may be meant
WALKING = 1.5  # [m/s] up to which we all but stand
JUST = 0.3  # [s] for which an action still counts as going on after its end


def is_undone(event: Event, asked: Asked) -> bool:
    """Check whether we could do something now that we are not doing."""
    if not is_us(event.actor) or event.tense not in ("present", "future"):
        return False
    asked = of_now(event, asked)
    if event.action in GOING:
        return is_halted(asked) or stops(asked)
    return bool(set(names_of(event)) & MANOEUVRES) and occasion(asked, event) is None


def of_now(event: Event, asked: Asked) -> Asked:
    """Return the setting with the present as its time, for what we might do now."""
    told = asked.past is not None and asked.past.said
    now = event.tense in ("present", "future") and not told
    return replace(asked, span=None) if now else asked


def is_present(event: Event, asked: Asked) -> bool:
    """Check whether what is supposed of us is of now: "if you drove on", "if we go now"."""
    past = asked.past
    return event.tense != "perfect" and (past is None or past.begin >= asked.now - ROUNDING)


def stops(asked: Asked) -> bool:
    """Check whether the decision in force is to stop."""
    return bool(asked.ride.traces) and "stop" in planned(asked.ride.latest)[:1]


def straight(event: Event, asked: Asked, form: Asking) -> Event:
    """Read going on as going straight on: where it says so, or only that has a risk."""
    risky = form in ("crash", "chance", "safe", "dangerous") and not stops(asked)
    onward = event.side == "straight" or (
        risky and event.side is None and "fast" not in event.manner
    )
    if event.action not in GOING or not onward or not asked.ride.traces:
        return event
    if event.side is None and risky_onward(asked.ride) is None:
        return event
    return structs.replace(event, action="exit-straight", side=None)


def is_sooner(then: Question | None) -> bool:
    """Check whether the question is if we would have gone, turned, or been there, sooner."""
    event = event_of(then.that) if isinstance(then, Whether) else None
    if event is not None and event.action in TURNING:
        return manner_of(event, "early") is not None
    if event is None or event.action not in (*GOING, "arrive"):
        return False
    return manner_of(event, "first", "early", "fast") is not None


def is_paced_turn(event: Event) -> bool:
    """Check whether a turn is taken faster or slower: a manner of it that no plan has."""
    return event.action in TURNING and manner_of(event, "fast", "slowly", "gently") is not None


def is_halted(asked: Asked) -> bool:
    """Check whether we stand or wait now."""
    return any(e.action in HALTED for e in held(asked))


def held(asked: Asked) -> list[Episode]:
    """List what hinders us now."""
    found = asked.world.episodes(actor=Ego(), actions=HINDERED, begin=asked.now - JUST)
    return [e for e in found if e.end is None or e.end >= asked.now - JUST]


def braking_of(event: Event, scene: Asked) -> Episode | None:
    """Find the braking or slowing that is asked about, if we did it recently, or just then."""
    plain = not event.manner and event.object is None and event.where is None
    if event.action not in ("brake", "slow-down") or not plain or not is_past(scene, event):
        return None
    since = scene.now - LATELY if scene.past is None else scene.past.begin
    until = scene.now if scene.past is None else scene.past.end
    found = scene.world.episodes(Ego(), (event.action,), since, until)
    return found[-1] if found else None


def as_going_on(event: Event, scene: Asked) -> Event:
    """Take a stop for our slowing down to walking pace that goes on after we stood."""
    if event.action != "stop" or (scene.past is not None and scene.past.said):
        return event
    stands = scene.world.episodes(Ego(), ("stand",))
    if not stands or stands[-1].end is None:
        return event
    slowing = scene.world.episodes(Ego(), ("brake", "slow-down"), stands[-1].end, scene.now)
    again = any(
        one.begin >= stands[-1].end and (one.end is None or one.end >= scene.now - JUST)
        and one.speed_to is not None and one.speed_to < WALKING
        for one in slowing
    )  # fmt: skip
    return structs.replace(event, action="brake") if again else event


def is_of_us(of: Proposition) -> bool:
    """Check whether a proposition is of how we get on, or of where we are."""
    match of:
        case Happens(event=Event(action=action, actor=Ego())):
            return action not in HINDERED
        case Is(thing=Ego()) | Related(thing=Ego()):
            return True
    return False


def paced(of: Proposition | None) -> Event | None:
    """Read "if we were faster or slower" as driving that way."""
    match of:
        case Compares(left=Measured(attribute="speed", thing=thing, tense=tense), comparator=how):
            if not is_own(thing):
                return None
            action: ActionName = "slow-down" if how == "less" else "go"
            return Event(action, manner=("slowly" if how == "less" else "fast",), tense=tense)
        case Is(state="fast" | "slow" as state, thing=thing, tense=tense) if is_own(thing):
            if state == "slow":
                return Event("slow-down", manner=("slowly",), tense=tense)
            return Event("go", manner=("fast",), tense=tense)
    return None
