"""Reasons: why something was done or not, and what would have come of something else."""

from typing import Literal, TypeAlias

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.evidence import Causation, Contrast, Evidence
from xavi_dialogue.domain.facts import Belief, Episode
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.domain.traffic_lights import Shown
from xavi_dialogue.domain.vocabulary import ActionName, Manner, Relation

#: Whether a vehicle that a question takes for the cause is one; of two, one of them, or neither;
#: where it is taken for the only one, whether it is ("alone"), or there is more ("beside").
#: "same": it speaks against the alternative, but without it the same is done. Of several that are
#: taken for the cause together, "all" or only "some" are; asked which is more of it, "which" is, or
#: all are alike.
Suspected: TypeAlias = Literal[
    "main", "part", "none", "either", "neither", "alone", "beside", "same",
    "all", "some", "which", "all-alike",
]  # fmt: skip


class Performed(Value, frozen=True):
    """That we did something that is asked about, are doing it or plan to do it."""

    action: ActionName
    when: Literal["did", "doing", "will"]
    time: float | None = None  # [s] when it was done; None where it is only planned


class ChoiceReason(Value, frozen=True):
    """Why the ego chose an action, or not another."""

    form: Literal["why", "why-not", "necessary", "worth-it"]
    deed: Episode | None  # what was done; None where it is only planned
    contrast: Contrast
    suspect: int | None = None  # a vehicle that the question takes for the cause ...
    suspected: Suspected | None = None  # ... and whether it is
    past: bool = True
    ahead: "MotionCause | None" = None  # who was in the way in the lane that we left, or left alone
    of_causes: bool = False  # it was asked who or what causes it
    later: Performed | None = None  # "why-not": it was done after that decision, or is planned
    besides: tuple[int, ...] = ()  # who else is the cause, where the suspect was taken for all
    open_at: float | None = None  # [s] when it could last be done, before the decision in force
    behind: "MotionCause | None" = None  # behind whom we stay, where it is asked why we do


class MotionCause(Value, frozen=True):
    """One reason for how the ego drives: who or what is in the way or ahead."""

    kind: Literal[
        "leader",  # somebody in front drives so, or stands
        "right-of-way",  # somebody goes first
        "cut-in",
        "blocked",
        "lane-beside",  # somebody is beside us in the lane that is asked about ...
        "lane-ahead",  # ... or drives slower there, or stands, at `value` [m]
        "no-room",  # somebody is in the way of leaving the lane
        "turn",  # a turn to be taken at this speed
        "bend",  # likewise a bend of the road
        "lane",  # our lane, which runs that way
        "roundabout",  # likewise a roundabout
        "limit",  # the speed limit
        "give-way-line",  # a line at which one must be ready to stop
        "may-go-first",  # somebody who might have to be let go first
        "hidden",  # what cannot be seen, past `vehicle`, or a building
        "destination",
        "lane-end",
        "plan",  # the plan calls for it, no reason beyond
        "starting",  # we have only just set off
        "picking-up",  # we speed up again, and are not there yet
        "parked",  # it has stood there since it was first seen
        "next-move",  # the change of lanes that `actions` are comes next
        "given-up",  # a stop, or the turn that `actions` are, was decided, and given up again
        "light",  # a traffic light, `shown`
        "moved-on",  # somebody who held us up has driven on ...
        "let-go",  # ... or was let go first
    ]
    vehicle: int | None = None
    actions: tuple[MacroAction, ...] = ()  # what it was expected to do ...
    probability: float | None = None  # ... and how surely
    speed: float | None = None  # [m/s] of that vehicle then
    did: Episode | None = None  # what it did in fact since
    necessary: bool | None = None  # without it we would not have done so; None: not tried
    value: float | None = None  # the limit [m/s], the turn's speed, the distance [m]
    shown: Shown | None = None  # what a traffic light shows that holds us, or that vehicle
    side: Literal["left", "right", "ahead"] | None = None  # where it is that cannot be seen
    between: int | None = None  # who drives between a leader and us


class MotionReason(Value, frozen=True):
    """Why the ego drove as it did: slowed, braked, stood, waited, gave way, drove slowly."""

    deed: Episode
    causes: tuple[MotionCause, ...]  # most important first; () none is known
    premise: bool = True  # False: the question called it otherwise ("stop" for slowing down)
    asked: ActionName | None = None  # what the question called it
    suspect: int | None = None
    suspected: Suspected | None = None
    evidence: Evidence = Evidence()
    manner: Manner | None = None  # how it drove, where that is asked about: slowly, fast, close
    limit: float | None = None  # [m/s] that was in force
    form: Literal["why", "necessary", "did"] = "why"  # "did": it was asked why we did not
    cleared: tuple[int, ...] = ()  # vehicles that make no difference: it was planned without them
    past: bool = False  # it was asked about as past, though it may go on
    halted: float | None = None  # [s] when, while slowing down already, it was decided to stop
    causation: Causation | None = None  # None: nobody was suspected
    of_causes: bool = False  # it was asked who or what causes it
    besides: tuple[int, ...] = ()  # who else is the cause, where the suspect was taken for all
    peak: float | None = None  # [m/s2] of braking, where it is asked why so hard


class CrossingVehicle(Value, frozen=True):
    """Somebody whose way crosses ours at the moment when we go: who goes first, what it does."""

    vehicle: int
    #: "none": our ways do not cross; "ahead": it drives in front of us
    first: Literal["ego", "vehicle", "depends", "none", "ahead"]
    trend: Literal["slowing", "steady", "speeding-up", "standing"] | None = None
    distance: float | None = None  # [m] from us
    gone: bool = False  # we have let it go first


class NobodyElse(Value, frozen=True):
    """Whether others than those told as causes mattered for a deed, by planning without them."""

    named: tuple[int, ...]  # the causes
    others: tuple[int, ...]  # who else was seen at that decision; those who matter, where known
    matter: bool | None  # without all of the others something else is done; None: not known
    decided: float  # [s]
    past: bool = True


class GoReason(Value, frozen=True):
    """Why the ego went then: whom it had let go, who had to let it, who was not in its way."""

    deed: Episode | None
    others: tuple[CrossingVehicle, ...]  # () nobody's way crossed ours
    contrast: Contrast | None = None  # with waiting
    past: bool = True
    refrained: ActionName | None = None  # what was asked: why we did not wait, stop, ...
    evidence: Evidence = Evidence()  # the decision in force when we went
    freed: MotionCause | None = None  # what held us up until then


#: What is asked of a supposition about us: what would come of it, whether or how probably we would
#: collide, whether we could do it, when we would be there.
Asking: TypeAlias = Literal[
    "what-if", "crash", "chance", "could", "arrival", "quicker", "better", "safe", "safer",
    "slower", "worse", "riskier",
]  # fmt: skip


class Unslowed(Value, frozen=True):
    """What can be said, without a simulation, of not having slowed down or waited."""

    deed: Episode  # the slowing or waiting
    cause: MotionCause | None  # why we did
    ours: float | None = None  # [s] when we would have been where our ways meet ...
    theirs: float | None = None  # [s] ... and when the vehicle was there
    going: bool = True  # asked of going on; False: of another speed
    vehicle: int | None = None  # whose way ours would have crossed
    right: bool = True  # it had right of way
    past: bool = True
    form: Asking = "what-if"
    saved: float | None = None  # [s] that the slowing or waiting cost
    arrival: float | None = None  # [s] when we would be there without
    red: bool = False  # a red light holds us
    through: bool = False  # the light would have been red when we came to it


class OtherReason(Value, frozen=True):
    """Why another vehicle does or did something, as far as can be seen or was inferred."""

    vehicle: int
    deed: Episode | None
    asked: Event | None = None  # what was asked, where it did otherwise
    causes: tuple[MotionCause, ...] = ()
    goal: Belief | None = None  # where it was thought to be going
    evidence: Evidence = Evidence()
    ours: bool | None = None  # the reply where it is asked whether we are the cause


class SignalReason(Value, frozen=True):
    """What the indicator of another vehicle announces, and what came of it."""

    vehicle: int
    deed: Episode  # the indicating
    aims: tuple[ActionName, ...]  # what it may announce on that road
    probability: float | None = None  # that it does so, as it was believed then
    came: Episode | None = None  # what it did of that since


class OwnSignal(Value, frozen=True):
    """What our own indicator announces, and whether we did so."""

    shown: Episode  # the indicating
    aim: MacroAction | None  # what it announced; None: the record does not tell
    came: bool | None = None  # None: it may still come
    past: bool = False  # it was asked about as past


class PlaceReason(Value, frozen=True):
    """How another vehicle came to be where it is, seen from us."""

    vehicle: int
    relation: Relation
    deed: Episode | None = None  # who let whom go first, or went past whom


class SupposedOfUs(Value, frozen=True):
    """What would have come of another action of the ego."""

    contrast: Contrast
    done: Performed | None = None  # it is just what was done, or is planned
    past: bool = True
    asked: ActionName | None = None  # where the foil is only the nearest to it: "brake" for a stop
    form: Asking = "what-if"
    arrival: float | None = None  # [s] when we would be there
    claimed: float | None = None  # [s] what the question takes it to gain or cost
    ahead: MotionCause | None = None  # who stood in the lane that we would have stayed in
    later: Performed | None = None  # it was done after that decision, or is planned
    open_at: float | None = None  # [s] when it could last be done, before the decision in force
    struck: int | None = None  # the vehicle of which a collision is asked about ...
    struck_risk: float | None = None  # ... and its probability under the foil


class SupposedOfOther(Value, frozen=True):
    """What the ego would have done had another vehicle done otherwise, or not been there."""

    vehicle: int
    supposed: Event | None  # None: it were not there
    prior: float | None  # probability of what is supposed, as it was believed
    plan: tuple[MacroAction, ...]  # as things were
    then: tuple[MacroAction, ...]  # as it would have been
    same: bool
    contrast: Contrast | None = None  # of `then` (foil) against `plan` (fact)
    past: bool = True
    asked: Event | None = None  # "would you still have braked": the deed asked about ...
    still: bool | None = None  # ... and whether it would have come about; None: not known
    negated: bool = False  # it is supposed not to have done that
    slows: bool | None = None  # we would have to slow down for it, as we do not otherwise
    faster: bool = False  # by the same plan we would drive faster
    form: Asking = "what-if"
    arrival: float | None = None  # [s] when we would be there
    others: tuple[int, ...] = ()  # further vehicles of which the same is supposed
    left_out: tuple[int, ...] = ()  # vehicles of which something is supposed that could not be
    everybody: bool = False  # nobody else is supposed to be there
    undone: bool = False  # what is asked about did not come about as things were
    within: Contrast | None = None  # asked why: of what else there is (foil) against `then` (fact)


class Reaction(Value, frozen=True):
    """What a sudden act of another vehicle would ask of us: told by distances to stop."""

    vehicle: int | None  # None: somebody who is not there
    kind: Literal[
        "anybody",  # it is not known where that would be
        "room",  # we would stop in time
        "short",  # we would not
        "first",  # we would be past before it got in our way
        "behind",  # it is behind us
        "beside",  # it is right beside us
        "apart",  # it stays in a lane of its own
        "joins",  # it moves in ahead of us and drives on, with room to do so
        "standing",  # we stand still ourselves
    ]
    supposed: Event | None  # None: what it does is not known here
    time: float  # [s] when it is supposed to do so
    speed: float  # [m/s] ours then
    needed: float | None = None  # [m] in which we come to a standstill
    room: float | None = None  # [m] to it, or to where it gets in our way
    left: float | None = None  # [m] that would be left behind a leader that brakes as hard
    past: bool = False
    negated: bool = False  # it is supposed not to do that
    asked: Literal["stop", "collide"] | None = None  # as a yes or no question: could we stop, ...
