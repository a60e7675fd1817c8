"""Traffic lights: what they showed, how they were expected to go on, how we passed them."""

from typing import Literal, TypeAlias

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.terms import Feature, Thing

#: What a light shows, as people say it.
LightColour: TypeAlias = Literal["red", "red-amber", "amber", "green", "flashing", "off"]
#: By the letters of a record; see sim.scene.LightState.
COLOURS: dict[str, LightColour] = {
    "r": "red", "u": "red-amber", "y": "amber", "G": "green", "g": "green", "s": "red",
    "o": "flashing", "O": "off",
}  # fmt: skip
YIELDING = "g"  # green, but others may go first
TURNING = "s"  # red, but one may turn after a full stop


class Shown(Value, frozen=True):
    """What a traffic light showed over a time."""

    light: Feature
    colour: LightColour
    begin: float  # [s]
    begun: bool  # it was seen to change to it; else it showed it when it came into view
    end: float | None = None  # [s] None: it goes on
    ended: bool = True  # it was seen to change then; else it went out of view
    gives_way: bool = False  # green, but others may go first
    turning: bool = False  # red, but one may turn after a full stop
    after: LightColour | None = None  # what it changed to


class Crossed(Value, frozen=True):
    """That our front passed the line of a traffic light."""

    time: float  # [s]
    speed: float  # [m/s]
    shown: Shown | None  # what it showed then; None: that was not seen
    since: float | None = None  # [s] for which it had shown that then
    late: bool = False  # when it came to show that, we were too close to stop comfortably


class Foreseen(Value, frozen=True):
    """When a traffic light was expected to change, at a decision."""

    shown: Shown  # what it showed then
    time: float  # [s] of the decision
    to: LightColour  # that it is expected to show next, or was asked about
    chance: float  # that it does so within the horizon
    horizon: float  # [s] after the decision up to which it is foreseen
    middle: float | None = None  # [s] by when it is as likely as not; None: beyond the horizon
    low: float | None = None  # [s] the earliest time that was reckoned with ...
    high: float | None = None  # ... and the latest; None: beyond the horizon
    cycle: bool = False  # from how it went on before; else from how long lights usually last
    came: float | None = None  # [s] when it did so in fact


# --- answers --------------------------------------------------------------------------------------


class LightTold(Value, frozen=True):
    """What a traffic light shows or showed, since when, for how long, or where it is."""

    asked: Literal[
        "colour", "whether", "claim", "seen", "when", "how-long", "where", "how-known", "why",
        "count", "turn",
    ]  # fmt: skip
    shown: Shown | None = None  # None: no light was in view, or none such
    wanted: LightColour | None = None  # that it is asked whether, or since when, it shows
    holds: bool | None = None  # the reply where it is asked or said that it does
    past: bool = False  # it is asked about as past
    time: float | None = None  # [s] the moment that is asked about
    distance: float | None = None  # [m] from our front to its line, where it is ahead
    passed: float | None = None  # [s] when we passed it, where we have
    count: int | None = None  # of lights that we passed
    crossed: tuple[Crossed, ...] = ()
    others: tuple[Crossed, ...] = ()  # passed while they showed something else than was asked of
    whose: Thing | None = None  # who faces it, where that is somebody else
    own: Shown | None = None  # what ours showed then, where theirs is not known


class LightForeseen(Value, frozen=True):
    """When a traffic light is or was expected to change: a belief, with its range."""

    foreseen: Foreseen | None  # None: it shows that already, or nothing is known of it
    shown: Shown | None = None
    past: bool = False  # it is asked what was expected
    asked: Literal["when", "whether", "how-sure"] = "when"
    holds: bool | None = None  # the reply where it is asked whether


class LightPassed(Value, frozen=True):
    """How we passed a traffic light: checked where it is said that we ran it."""

    crossed: Crossed | None  # None: we have passed none, or not yet
    claimed: LightColour | None = None  # that it is said to have shown then
    holds: bool | None = None  # whether it is so; None: that was not seen
    asked: Literal["whether", "claim", "why"] = "whether"
    ahead: Shown | None = None  # what the light before us shows, where we have passed none


class SupposedOfLight(Value, frozen=True):
    """What would have been had a traffic light shown something else."""

    shown: Shown  # what it showed
    supposed: LightColour
    decided: float  # [s] of the decision
    plan: tuple[MacroAction, ...]  # as things were
    then: tuple[MacroAction, ...]  # as it would have been
    same: bool  # nothing else would have been done
    waits: bool  # we would have had to stop for it
    passing: float | None = None  # [s] when we would have passed its line
    passed: float | None = None  # [s] when we did; None: not yet
    past: bool = True
    standing: bool = False  # we stood at it when it was decided
    holds: bool | None = None  # the reply where it is asked whether we would have stopped


class TurnOnRed(Value, frozen=True):
    """Why we do not turn on red: what the light shows to those who turn."""

    shown: Shown | None  # None: no light on our way is in view
    way: Literal["left", "right", "straight"] | None  # that we take there; None: not known
    asked: Literal["left", "right", "straight"]


LightAnswer: TypeAlias = LightTold | LightForeseen | LightPassed | SupposedOfLight | TurnOnRed
