"""Details: what single types of question add to an Explanation. Values only, no text."""

from typing import Literal, TypeAlias

import msgspec

from planner.trace import Action, Outcome
from xavi_dialogue.explain.query import QueryAction

#: Something unpleasant that might have been avoided.
Mishap: TypeAlias = Literal["collision", "hard-brake", "stop", "slow-down", "give-way"]


class Step(msgspec.Struct, frozen=True):
    """One action of a plan that is still to come."""

    action: Action
    moment: float  # [s] simulation time at which it is expected to begin


class Grounds(msgspec.Struct, frozen=True):
    """How we came to believe something of another vehicle: how the belief grew, and why."""

    vehicle: int
    actions: tuple[QueryAction, ...]  # what is believed of it
    done: bool  # it has been seen to do so
    probability: float  # when it did, or else now; where that is less than even, at its highest
    latest: float  # by the latest decision that counts: up to when it did so, or the last
    since: float | None  # [s] from when on it was more probable than not; None if never
    start: float  # [s] the decisions between which it grew most ...
    end: float  # [s]
    before: float  # ... and how probable it was at either
    after: float
    deed: QueryAction | None  # what the vehicle was doing between them that it had not before
    speed_from: float | None  # [m/s] its speed at either
    speed_to: float | None
    rival: tuple[QueryAction, ...]  # what goes with the likeliest goal that it excludes
    fit: float | None  # how many times better its path fits the goal believed than that other


class Certainty(msgspec.Struct, frozen=True):
    """How sure we are of a plan, or that a choice was better than the best alternative.

    A plan goes well where it neither collides nor loses the way.
    """

    about: Literal["plan", "choice"]
    share: float  # probability that the plan goes well, or that the choice does better
    low: float  # that probability is at least this, at 95 %
    good: int  # situations in which it does
    situations: int  # that were tried; for a choice, with both options
    late: int = 0  # good ones in which the plan took longer than was looked ahead


class Avoidance(msgspec.Struct, frozen=True):
    """Whether something could have been avoided, by which of the options known."""

    mishap: Mishap
    possible: bool  # the counterfactual is the way to have avoided it
    risk: float  # probability of it under what was chosen, as seen at that decision
    other: float  # and under the counterfactual; where impossible, the lowest there is
    decisions: int  # that were looked at
    options: int  # that were looked at


class Impact(msgspec.Struct, frozen=True):
    """A collision that happened, and what the last decision before it expected.

    Without such a decision that knew the vehicle, `decided` and all after it is absent.
    """

    vehicle: int | None  # that we collided with, where that is known
    decided: float | None = None  # [s] when that decision was taken
    chance: float | None = None  # of a collision with that vehicle under its plan
    actions: tuple[Action, ...] = ()  # what it expected of that vehicle before anything else ...
    probability: float = 0.0  # ... and how surely
    deed: QueryAction | None = None  # what we did last, where the question is of all that happened


class Pivot(msgspec.Struct, frozen=True):
    """What a decision hangs on.

    - conduct: it would be otherwise if `vehicle` did `actions`, which has `probability`.
    - removal: it would be otherwise if `vehicle` were not there.
    - factor: what mattered most: `vehicle`, or the difference that the alternative makes.
    - none: nothing that was looked at changes it.
    """

    kind: Literal["conduct", "removal", "factor", "none"]
    vehicle: int | None = None
    actions: tuple[Action, ...] = ()
    probability: float | None = None


class Ranking(msgspec.Struct, frozen=True):
    """By which measure a fact and its foil are compared, and the probabilities that it takes."""

    by: Literal["safer", "smoother"]
    collision: float | None = None  # under what was done or is planned
    foil_collision: float | None = None
    hard_brake: float | None = None  # None where the record has no speeds
    foil_hard_brake: float | None = None


class Suspect(msgspec.Struct, frozen=True):
    """A vehicle that the question takes for the cause, and whether it is."""

    vehicle: int
    part: Literal["main", "some", "none"]


class Sight(msgspec.Struct, frozen=True):
    """What the latest scene shows of a vehicle, or of all."""

    about: Literal["speed", "distance", "place", "count", "colour", "nobody"]
    vehicle: int  # with nobody: the nearest to us
    place: str | None = None  # where it is seen from us; None: it is us; with nobody: as described
    oncoming: bool = False  # it comes towards us
    distance: float | None = None  # [m] of the gap ahead or behind, else between the centres
    speed: float | None = None  # [m/s]
    trend: Literal["slowing", "steady", "speeding-up", "standing"] | None = None
    colour: str | None = None
    others: tuple[int, ...] = ()  # that are in view


class Option(msgspec.Struct, frozen=True):
    """Something else that might have been done, and what was expected of it."""

    action: Action
    outcome: Outcome
    probability: float  # of that
    delta: float | None  # [s] by which it takes longer than what was chosen, if it gets there
    collided_with: int | None = None


class Choices(msgspec.Struct, frozen=True):
    """What else might have been done, best first; or which of it was the best or the worst.

    Of what would have been sooner, nothing else is among the others, and the soonest first.
    """

    about: Literal["options", "second", "worst", "sooner"]
    chosen: Action
    others: tuple[Option, ...]


class Need(msgspec.Struct, frozen=True):
    """Whether the ego had to do what it did.

    - only: nothing else could be done.
    - bad: the best alternative would not have gone well.
    - worse: it would have, but was not as good.
    - equal: it would have been as good.
    - driving: how it drove follows from who was in its way (the causes), or from the road.
    """

    asked: Literal["necessary", "other-way", "better-way"]
    kind: Literal["only", "bad", "worse", "equal", "driving"]
    foil: Action | None = None  # the best alternative


class Staying(msgspec.Struct, frozen=True):
    """Why the ego is in its lane.

    `deed` brought it there, and nothing before `since`; both None: it has been in it from the
    start. `only` says that there is no other to change to, for `reason` where that is another
    than that the road has none.
    """

    deed: Action | None = None
    since: float | None = None  # [s]
    under_way: bool = False  # it is only moving there
    only: bool = False
    reason: str | None = None
    same: bool = False  # to leave it would make no difference worth speaking of


class Contrary(msgspec.Struct, frozen=True):
    """What another vehicle is asked not to have done, and what it did of it."""

    asked: tuple[QueryAction, ...]
    done: float | None = None  # [s] when it did so all the same, before it did the contrary
    deed: QueryAction | None = None  # the contrary, where it did that
    chance: float | None = None  # that it does what is asked about yet, where that is foreseen
