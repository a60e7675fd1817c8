"""Findings: answers about what was, is and is expected."""

from typing import Literal

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.evidence import Contrast, Evidence, Weighing
from xavi_dialogue.domain.facts import (
    Belief,
    Episode,
    Expectation,
    Fact,
    Gap,
    Look,
    Measure,
    OptionValue,
    Somebody,
)
from xavi_dialogue.domain.reasons import MotionCause
from xavi_dialogue.domain.terms import Event, Proposition, Thing


class Measures(Value, frozen=True):
    """Values that were asked for; each may say why it has none."""

    measures: tuple[Measure, ...]


class Verdict(Value, frozen=True):
    """Whether something holds or held: the answer to a yes or no question, or to a claim."""

    that: Proposition  # grounded
    holds: bool | None  # None: cannot be known
    facts: tuple[Fact, ...] = ()  # what is or was so instead, or what bears it out
    gap: Gap | None = None  # why it cannot be known
    claim: bool = False  # it answers a claim
    challenge: bool = False  # ... that disputes what the car said
    believed: tuple[Belief, ...] = ()  # prediction beside fact: what was expected then
    mistaken: bool = False  # the car was wrong, and owns up to it
    probability: float | None = None  # of what is still to come
    either: bool = False  # it is the one that holds of several asked about: no "yes" before it


class Identified(Value, frozen=True):
    """Who or what it is."""

    looks: tuple[Look, ...]
    such: Proposition | None = None  # the condition that was asked for
    facts: tuple[Fact, ...] = ()  # what each is doing
    none: bool = False  # there is nobody of whom it holds


class Counted(Value, frozen=True):
    """How many there are or were."""

    of: Thing | Event
    count: int
    facts: tuple[Fact, ...] = ()
    at_least: bool = False  # the record has gaps
    since: float | None = None  # [s] over which interval
    until: float | None = None
    such: Thing | None = None  # what was said of them
    said: bool | None = None  # whether it is the number that was said


class Happenings(Value, frozen=True):
    """What happened: an account of episodes in order of time."""

    form: Literal["list", "summary", "when", "how-long", "doing", "first", "last"]
    episodes: tuple[Episode, ...]
    actor: Thing | None = None  # None: everybody
    since: float | None = None  # [s]
    until: float | None = None  # [s]
    measures: tuple[Measure, ...] = ()  # beside them: duration of the ride, distance, speed
    looks: tuple[Look, ...] = ()  # of the vehicles concerned, at the time of the first episode
    asked: Event | None = None


class Lasted(Value, frozen=True):
    """How long a state lasted or has lasted."""

    that: Proposition  # grounded
    begin: float  # [s]
    end: float | None = None  # [s] None while it goes on
    now: float = 0.0  # [s]
    at_least: bool = False  # it held from when the record begins
    held: float | None = None  # [s] since when we slowed down or waited before it


class Staying(Value, frozen=True):
    """How long our car means to stay behind another vehicle."""

    behind: Thing
    until: MacroAction | None = None  # what the car does then; None: nothing that it plans
    at: float | None = None  # [s] when it begins that
    off: float | None = None  # chance that the other one turns off
    left: Measure | None = None  # how long the ride takes still, or how long the car stands


class Activity(Value, frozen=True):
    """What somebody is doing now or at a moment, and is expected to do."""

    actor: Somebody
    time: float  # [s]
    doing: tuple[Episode, ...]  # under way at that time
    speed: float | None
    trend: Literal["slowing", "steady", "speeding-up", "standing"] | None
    look: Look | None = None
    belief: Belief | None = None
    cause: MotionCause | None = None  # why it stands or slows, where that can be seen


class PlanAhead(Value, frozen=True):
    """What the ego is going to do."""

    steps: tuple[tuple[MacroAction, float], ...]  # with when [s] it is expected to begin
    measures: tuple[Measure, ...] = ()  # next junction, exit, time to go
    arrived: bool = False
    begun: MacroAction | None = None  # a turn or lane change that is under way


class Located(Value, frozen=True):
    """Where somebody or something is or was."""

    thing: Thing
    looks: tuple[Look, ...]
    measures: tuple[Measure, ...] = ()
    gap: Gap | None = None


class Bound(Value, frozen=True):
    """Where somebody is going."""

    actor: Somebody
    belief: Belief | None = None  # of another vehicle
    went: Episode | None = None  # where it has gone in fact
    look: Look | None = None  # where it is by now, or was seen last
    measures: tuple[Measure, ...] = ()  # of ours: destination, turns
    unconsidered: Event | None = None  # what was asked about, and the belief leaves out of account
    signal: Episode | None = None  # what it indicates meanwhile


class Beliefs(Value, frozen=True):
    """What was believed of a vehicle, how it moved, and what came of it."""

    vehicle: int
    of: Event | None  # the conduct that was asked about; None: all
    history: tuple[Belief, ...]  # oldest first, where it moved
    probability: float | None = None  # of `of` at the time asked about
    time: float | None = None  # [s] that time
    why: Episode | None = None  # what the vehicle did while it moved most
    turning: tuple[float, float] | None = None  # [s] between which it moved most
    came: Episode | None = None  # what it did in fact
    since: float | None = None  # [s] from when on it was held to be more likely than not
    changed: bool = False  # it is asked how it moved
    besides: tuple[Expectation, ...] = ()  # what else was likely at that time
    knew: bool = False  # it is asked whether we knew it; `since` is from when on without a break
    before: float | None = None  # the probability that it had before that


class Options(Value, frozen=True):
    """What could have been done, and how each was valued."""

    options: tuple[OptionValue, ...]  # best first, the chosen one marked
    decided: float  # [s]
    evidence: Evidence
    besides: bool = False  # only what else
    risk: bool = False  # only with whom the first one would have collided
    hits: int = 0  # drives imagined of it that ended in a collision
    drives: int = 0  # of so many
    earlier: bool = False  # of a decision before the latest one
    rival: Weighing | None = None  # only the next best, and how what was chosen weighs against it


class Compared(Value, frozen=True):
    """Two things or options compared by a measure."""

    by: str
    first: Thing | Proposition
    second: Thing | Proposition
    better: Literal["first", "second", "same", "unknown"]
    measures: tuple[Measure, ...] = ()
    contrast: Contrast | None = None


class Priority(Value, frozen=True):
    """Who has or had right of way, and who went first."""

    time: float  # [s]
    #: For us; "we-change", "it-changes": who changes lanes has to leave the other one room.
    rule: Literal["priority", "give-way", "equal", "depends", "none", "we-change", "it-changes"]
    vehicle: int | None = None
    first: Somebody | None = None  # who went first in fact
    waited: Episode | None = None
    blame: bool = False  # asked as a question of fault or law
    conflict: bool | None = None  # somebody had to brake or swerve
    limit: Measure | None = None  # our speed against the limit, where law was asked
    deeds: tuple[Episode, ...] = ()  # what those concerned did then: cut in, braked, waited
    legal: bool = False  # asked as a question of law
    stood: bool = False  # the vehicle was standing when we went
    others: tuple[int, ...] = ()  # of whom the same is true
    holds: bool | None = None  # the reply to the yes or no question, or claim, that it answers
    claim: bool = False  # it answers a claim
    ring: bool = False  # at a roundabout, asked of nobody in particular
    light: bool = False  # a red light holds us at that junction, asked of nobody in particular
    walkers: bool = False  # at a crossing for people on foot, asked of nobody in particular
    grounds: bool = False  # asked how we know it
    after: tuple[int, ...] = ()  # who has to let us go first, where others go before us
    #: On what it rests that they go first: they come from the right, or we turn across their way;
    #: they go straight on beside us; they are on foot; their road has priority over ours.
    why: Literal["right", "across", "beside", "on-foot", "road"] | None = None
    apart: tuple[int, ...] = ()  # who was named as well, and whose way does not meet ours
    number: bool = False  # it is asked how many go first


class Unblocking(Value, frozen=True):
    """Who has to move first so that we can go: who is at the head of the row that we are in."""

    time: float  # [s]
    head: int
    going: bool = False  # it has set off
    waits: tuple[int, ...] = ()  # whom it lets go first, as was foreseen


class Comfort(Value, frozen=True):
    """How hard the ride was over an interval."""

    peak: Measure  # deceleration
    jerk: Measure | None = None
    episode: Episode | None = None
    hard: bool = False


class Closeness(Value, frozen=True):
    """How close a vehicle came: the answer to whether it was safe or dangerous."""

    vehicle: int | None
    closest: Measure | None  # distance at the closest
    ttc: Measure | None = None  # shortest time to collision
    risk: float | None = None  # of a collision under the plan, as foreseen
    asked: Literal["safe", "dangerous", "close", "hit", "room", "grounds"] = "safe"
    time: float = 0.0
    past: bool = True
    ever: Measure | None = None  # distance at the closest so far, where it was closer than that
    braked: tuple[Episode, ...] = ()  # hard braking: ours, or of those with right of way over us
    foreseen: bool = False  # it is how close it comes if all goes as planned and expected
    grounds: "Assurance | None" = None  # why no collision is expected, where that is asked
    giving: tuple[int, ...] = ()  # whom we are about to let go first, where it is asked of now
    degree: bool = False  # it is asked how risky it is, not whether


class Assurance(Value, frozen=True):
    """Why no collision is expected with a vehicle, or with anybody."""

    situations: int = 0  # that were simulated under the plan
    struck: int = 0  # in how many of them we collide
    belief: Belief | None = None  # what is expected of the vehicle
    stands: bool = False
    yields: Literal["we", "they"] | None = None  # who has to let the other one go first
    behind: bool = False  # it drives behind us


class Slowing(Value, frozen=True):
    """Whether we stop or slow down for somebody, as foreseen."""

    others: tuple[int, ...]  # the vehicles asked about, or those of them that hold us up
    stops: bool  # we come to a standstill
    held: float  # share of the drives foreseen in which they hold us up
    slows: bool = False  # it is asked whether we slow down, not whether we stop
    slow: float | None = None  # [m/s] down to which we slow; None: we do not
    time: float | None = None  # [s] when we stand
    share: float | None = None  # of the drives foreseen in which we come to a standstill
    order: Literal["we", "they", "nobody"] | None = None  # who comes first where our ways meet
    yields: bool = False  # we have to give way to some where our way leads next


class PullingUp(Value, frozen=True):
    """Whether somebody stops in time: "will he manage to stop?", "can you stop in time?"."""

    vehicle: int  # the other one
    how: Literal["stands", "brakes", "owes", "goes-first", "able", "unable", "apart"]
    ours: bool = False  # it is asked of us, who come up to the vehicle
    behind: bool = False  # it comes up behind us
    braking: Episode | None = None  # that goes on
    distance: Measure | None = None  # between the bodies, now
    speed: Measure | None = None  # of who is asked about
    needed: float | None = None  # [m] to come down to the speed of the one in front, braking hard
    risk: float | None = None  # of a collision under the plan
    chance: float | None = None  # that it lets us go first
