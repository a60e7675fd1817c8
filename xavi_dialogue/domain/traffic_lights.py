"""Traffic lights: facts and answers about their colours, past and expected, and our passing."""

from typing import Literal, TypeAlias

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.terms import Feature, Thing

#: What a light shows, in everyday words.
LightColour: TypeAlias = Literal["red", "red-amber", "amber", "green", "flashing", "off"]
#: Colours by the letters of a record; see sim.scene.LightState.
COLOURS: dict[str, LightColour] = {
    "r": "red", "u": "red-amber", "y": "amber", "G": "green", "g": "green", "s": "red",
    "o": "flashing", "O": "off",
}  # fmt: skip
YIELDING = "g"  # green, but others may go first
TURNING = "s"  # red, but one may turn after a full stop


class Shown(Value, frozen=True):
    """A stretch of time in which a traffic light showed one colour."""

    light: Feature
    colour: LightColour
    begin: float  # [s]
    begun: bool  # the change to it was seen; else it showed it when it came into view
    end: float | None = None  # [s] None: it goes on
    ended: bool = True  # the change at its end was seen; else it went out of view
    gives_way: bool = False  # green, but others may go first
    turning: bool = False  # red, but one may turn after a full stop
    after: LightColour | None = None  # what it changed to


class Crossed(Value, frozen=True):
    """The moment at which our front passed the line of a traffic light."""

    time: float  # [s]
    speed: float  # [m/s]
    shown: Shown | None  # what it showed then; None: that was not seen
    since: float | None = None  # [s] for which it had shown that then
    late: bool = False  # when it changed to that, we were too close to stop comfortably


class Foreseen(Value, frozen=True):
    """The expectation of a decision when a traffic light changes."""

    shown: Shown  # what it showed then
    time: float  # [s] of the decision
    to: LightColour  # that it is expected to show next, or that the question names
    chance: float  # probability that it does so within the horizon
    horizon: float  # [s] after the decision, to which the prediction reaches
    middle: float | None = None  # [s] median of the time; None: beyond the horizon
    low: float | None = None  # [s] the earliest time that was expected ...
    high: float | None = None  # ... and the latest; None: beyond the horizon
    cycle: bool = False  # from its observed cycle; else from how long lights usually last
    came: float | None = None  # [s] when it actually changed


class LightOdds(Value, frozen=True):
    """The expectation whether a traffic light shows a colour by some moment, or at it."""

    colour: LightColour
    by: float  # [s]
    chance: float  # probability that it has turned to the colour by then, or still shows it
    stays: bool  # whether it shows that colour now


# --- answers --------------------------------------------------------------------------------------


class LightTold(Value, frozen=True):
    """What a traffic light shows or showed, since when, for how long, or where it is."""

    asked: Literal[
        "colour", "whether", "claim", "seen", "when", "how-long", "where", "how-known", "why",
        "count", "turn",
    ]  # fmt: skip
    shown: Shown | None = None  # None: no light was in view, or none such
    wanted: LightColour | None = None  # the colour that the question or claim names
    holds: bool | None = None  # whether it shows that; the reply to the question or claim
    past: bool = False  # the question is in the past tense
    time: float | None = None  # [s] the moment that is asked about
    distance: float | None = None  # [m] from our front to its line, if it is ahead
    passed: float | None = None  # [s] when we passed it, if we have
    count: int | None = None  # number of lights that we passed
    crossed: tuple[Crossed, ...] = ()
    others: tuple[Crossed, ...] = ()  # lights that showed another colour when we passed them
    whose: Thing | None = None  # who faces it, if that is somebody else
    own: Shown | None = None  # what ours showed then, if theirs is not known
    around: bool | None = None  # another light of the junction was green; None: none was seen


class LightForeseen(Value, frozen=True):
    """When a traffic light is or was expected to change: a belief, with its range."""

    foreseen: Foreseen | None  # None: it shows that already, or nothing is known about it
    shown: Shown | None = None
    past: bool = False  # the question is what was expected
    #: going: when we go on; met: whether it lets us through
    asked: Literal["when", "whether", "how-sure", "going", "met"] = "when"
    holds: bool | None = None  # the reply to the question whether it will change, or is met so
    stops: float | None = None  # probability that we have to stop for it, if "met" is asked
    odds: LightOdds | None = None  # what is asked of a moment or stretch of time to come


class LightPassed(Value, frozen=True):
    """How we passed a traffic light, for claims and questions that we ran it."""

    crossed: Crossed | None  # None: we have passed none, or not yet
    claimed: LightColour | None = None  # the colour that it showed according to the passenger
    holds: bool | None = None  # whether it did; None: that was not seen
    asked: Literal["whether", "claim", "why"] = "whether"
    ahead: Shown | None = None  # what the light ahead shows, if we have passed none


class SupposedOfLight(Value, frozen=True):
    """What we would have done if a traffic light had shown something else."""

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
    holds: bool | None = None  # the reply to the question whether we would have stopped
    first: tuple[int, ...] = ()  # road users that we would have let go first all the same
    faster: bool = False  # the question is whether we would have been faster, or sooner
    amount: bool = False  # ... or by how much


class TurnOnRed(Value, frozen=True):
    """The reason why we do not turn on red: what the light shows for the turn."""

    shown: Shown | None  # None: no light on our way is in view
    way: Literal["left", "right", "straight"] | None  # our way there; None: not known
    asked: Literal["left", "right", "straight"]


LightAnswer: TypeAlias = LightTold | LightForeseen | LightPassed | SupposedOfLight | TurnOnRed
