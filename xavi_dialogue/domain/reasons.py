"""Reasons: answers why something was done or not, and what would have followed otherwise."""

from typing import Literal, TypeAlias

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.evidence import Causation, Contrast, Evidence
from xavi_dialogue.domain.facts import Belief, Episode
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.domain.traffic_lights import Shown
from xavi_dialogue.domain.vocabulary import ActionName, Manner, Relation

#: Whether a vehicle that the question suspects is a cause. Of two suspects: either, or neither.
#: Of a suspect as the only cause: it is ("alone"), or there are others besides it ("beside").
#: "same": it speaks against the alternative, but without it the same is done. Of several suspects
#: together: "all" or only "some" are causes. Of the question which of them is more of a cause:
#: "which" is, or all are alike.
Suspected: TypeAlias = Literal[
    "main", "part", "none", "either", "neither", "alone", "beside", "same",
    "all", "some", "which", "all-alike",
]  # fmt: skip


class Performed(Value, frozen=True):
    """The statement that we did something that is asked about, are doing it or plan to do it."""

    action: ActionName
    when: Literal["did", "doing", "will"]
    time: float | None = None  # [s] when it was done; None: it is only planned


class ChoiceReason(Value, frozen=True):
    """The reason why the ego chose an action, or did not choose another."""

    form: Literal["why", "why-not", "necessary", "worth-it", "mistaken"]
    deed: Episode | None  # what was done; None: it is only planned
    contrast: Contrast
    suspect: int | None = None  # a vehicle that the question supposes to be the cause ...
    suspected: Suspected | None = None  # ... and whether it is
    past: bool = True
    ahead: "MotionCause | None" = None  # who was in the way in the lane we left, or did not enter
    of_causes: bool = False  # the question is who or what causes it
    later: Performed | None = None  # "why-not": it was done after that decision, or is planned
    besides: tuple[int, ...] = ()  # other causes, if the question supposes that there are none
    open_at: float | None = None  # [s] when it was last possible, before the decision in force
    behind: "MotionCause | None" = None  # who we stay behind, if the question is why we do


class MotionCause(Value, frozen=True):
    """One reason for how the ego drives: who or what is in the way or ahead."""

    kind: Literal[
        "leader",  # somebody in front drives that way, or stands
        "right-of-way",  # somebody goes first
        "cut-in",
        "blocked",
        "lane-beside",  # somebody is beside us in the lane that is asked about ...
        "lane-ahead",  # ... or drives slower there, or stands, at `value` [m]
        "no-room",  # somebody is in the way of leaving the lane
        "turn",  # a turn, to be taken at speed `value`
        "bend",  # a bend of the road, likewise
        "lane",  # our lane, which runs that way
        "roundabout",  # a roundabout, to be taken at speed `value`
        "limit",  # the speed limit
        "give-way-line",  # a line at which one must be ready to stop
        "may-go-first",  # somebody to whom we might have to give way
        "hidden",  # what `vehicle`, or a building, hides
        "destination",
        "lane-end",
        "plan",  # the plan requires it; no other reason is known
        "starting",  # we have only just set off
        "picking-up",  # we speed up again, and are not there yet
        "parked",  # it has stood there since it was first seen
        "next-move",  # the lane change in `actions` comes next
        "given-up",  # a stop, or the turn in `actions`, was decided, and given up again
        "light",  # a traffic light, `shown`
        "moved-on",  # somebody who held us up has driven on ...
        "let-go",  # ... or we let them go first
    ]
    vehicle: int | None = None
    actions: tuple[MacroAction, ...] = ()  # what it was expected to do ...
    probability: float | None = None  # ... and how probably
    speed: float | None = None  # [m/s] of that vehicle then
    did: Episode | None = None  # what it has actually done since
    necessary: bool | None = None  # without it we would not have done so; None: not tested
    value: float | None = None  # the limit [m/s], the turn's speed [m/s], the distance [m]
    shown: Shown | None = None  # the traffic light that holds us, or that vehicle
    side: Literal["left", "right", "ahead"] | None = None  # of the hidden stretch
    between: int | None = None  # vehicle between a leader and us


class MotionReason(Value, frozen=True):
    """The reason why the ego slowed, braked, stood, waited, gave way or drove slowly."""

    deed: Episode
    causes: tuple[MotionCause, ...]  # most important first; () none is known
    premise: bool = True  # False: the question named another action ("stop" for slowing down)
    asked: ActionName | None = None  # what the question called it
    suspect: int | None = None
    suspected: Suspected | None = None
    evidence: Evidence = Evidence()
    manner: Manner | None = None  # if the question is about it: slowly, fast, close
    limit: float | None = None  # [m/s] that was in force
    form: Literal["why", "necessary", "did"] = "why"  # "did": asked why not, but we did it
    cleared: tuple[int, ...] = ()  # vehicles that make no difference, tested by planning again
    past: bool = False  # the question is in the past tense, though it may go on
    over: bool = False  # the question is in the present tense, though it ended seconds ago
    halted: float | None = None  # [s] when we decided to stop, while slowing down already
    causation: Causation | None = None  # None: nobody was suspected
    of_causes: bool = False  # the question is who or what causes it
    besides: tuple[int, ...] = ()  # other causes, if the question supposes that there are none
    peak: float | None = None  # [m/s2] of braking, if the question is why so hard


class CrossingVehicle(Value, frozen=True):
    """A vehicle whose way crosses ours when we set off, with who goes first and what it does."""

    vehicle: int
    #: "none": our ways do not cross; "ahead": it drives in front of us
    first: Literal["ego", "vehicle", "depends", "none", "ahead"]
    trend: Literal["slowing", "steady", "speeding-up", "standing"] | None = None
    distance: float | None = None  # [m] from us
    gone: bool = False  # we have let it go first


class NobodyElse(Value, frozen=True):
    """The answer whether others than the stated causes mattered, by planning without them."""

    named: tuple[int, ...]  # the causes
    others: tuple[int, ...]  # the others in view at that decision; those that matter, if known
    matter: bool | None  # without all of the others something else is done; None: not known
    decided: float  # [s]
    past: bool = True


class GoReason(Value, frozen=True):
    """The reason why the ego went: who it had let go, who gave way, who was not in its way."""

    deed: Episode | None
    others: tuple[CrossingVehicle, ...]  # () nobody's way crossed ours
    contrast: Contrast | None = None  # with waiting
    past: bool = True
    refrained: ActionName | None = None  # the question is why we did not do this: wait, stop, ...
    evidence: Evidence = Evidence()  # the decision in force when we went
    freed: MotionCause | None = None  # what held us up until then


#: The question about a supposition: what would follow, whether or how probably we would collide,
#: whether we could do it, when we would arrive, whether it is better, safer, slower and so on.
Asking: TypeAlias = Literal[
    "what-if", "crash", "chance", "could", "arrival", "quicker", "better", "safe", "safer",
    "slower", "worse", "riskier", "dangerous", "likely", "forces",
]  # fmt: skip


class Unslowed(Value, frozen=True):
    """The answer, without simulation, what if we had not slowed down or waited."""

    deed: Episode  # the slowing or waiting
    cause: MotionCause | None  # why we did
    ours: float | None = None  # [s] when we would have been where our ways meet ...
    theirs: float | None = None  # [s] ... and when the vehicle was there
    going: bool = True  # we are supposed to go on; False: to drive at another speed
    vehicle: int | None = None  # the one whose way we would have crossed
    right: bool = True  # it had right of way
    past: bool = True
    form: Asking = "what-if"
    saved: float | None = None  # [s] that the slowing or waiting cost
    arrival: float | None = None  # [s] when we would be there without
    red: bool = False  # a red light holds us
    through: bool = False  # the light would have been red when we came to it


class OtherReason(Value, frozen=True):
    """The reason why another vehicle does or did something, as seen or inferred."""

    vehicle: int
    deed: Episode | None
    asked: Event | None = None  # the question's event, if the vehicle did something else
    causes: tuple[MotionCause, ...] = ()
    goal: Belief | None = None  # where it was thought to be going
    evidence: Evidence = Evidence()
    ours: bool | None = None  # the reply to the question whether we are the cause


class SignalReason(Value, frozen=True):
    """The meaning of another vehicle's indicator, and what the vehicle did then."""

    vehicle: int
    deed: Episode  # the indicating
    aims: tuple[ActionName, ...]  # what it may announce on that road
    probability: float | None = None  # that it does so, as believed then
    came: Episode | None = None  # which of those it has done since


class OwnSignal(Value, frozen=True):
    """The meaning of our own indicator, and whether we did what it announced."""

    shown: Episode  # the indicating
    aim: MacroAction | None  # what it announced; None: the record does not show it
    came: bool | None = None  # whether we did it; None: it may still come
    past: bool = False  # the question is in the past tense


class PlaceReason(Value, frozen=True):
    """The explanation how another vehicle came to be where it is, relative to us."""

    vehicle: int
    relation: Relation
    deed: Episode | None = None  # one of us let the other go first, or went past


class SupposedOfUs(Value, frozen=True):
    """The consequences of another action of the ego."""

    contrast: Contrast
    done: Performed | None = None  # it is exactly what was done, or is planned
    past: bool = True
    asked: ActionName | None = None  # if the foil is only the closest action: "brake" for a stop
    form: Asking = "what-if"
    arrival: float | None = None  # [s] when we would be there
    claimed: float | None = None  # [s] that it would gain or cost according to the question
    ahead: MotionCause | None = None  # who stood in the lane that we would have stayed in
    later: Performed | None = None  # it was done after that decision, or is planned
    open_at: float | None = None  # [s] when it was last possible, before the decision in force
    struck: int | None = None  # the vehicle of the collision that is asked about ...
    struck_risk: float | None = None  # ... and its probability under the foil


class SupposedOfOther(Value, frozen=True):
    """The consequences for the ego if another vehicle had acted otherwise, or had been absent."""

    vehicle: int
    supposed: Event | None  # None: the vehicle is absent
    prior: float | None  # probability of the supposition, as believed
    plan: tuple[MacroAction, ...]  # as things were
    then: tuple[MacroAction, ...]  # as it would have been
    same: bool
    contrast: Contrast | None = None  # of `then` (foil) against `plan` (fact)
    past: bool = True
    asked: Event | None = None  # "would you still have braked": the action asked about ...
    still: bool | None = None  # ... and whether we would have done it; None: not known
    negated: bool = False  # the vehicle is supposed not to have done that
    slows: bool | None = None  # we would have to slow down for it, but do not as things are
    faster: bool = False  # we would drive faster by the same plan
    form: Asking = "what-if"
    arrival: float | None = None  # [s] when we would be there
    others: tuple[int, ...] = ()  # further vehicles with the same supposition
    left_out: tuple[int, ...] = ()  # vehicles whose supposition could not be planned
    everybody: bool = False  # the supposition is that nobody else is there
    undone: bool = False  # we did not do what is asked about as things were
    within: Contrast | None = None  # if asked why: the alternative (foil) against `then` (fact)


class Reaction(Value, frozen=True):
    """Our possible reaction to a sudden action of another vehicle, by stopping distances."""

    vehicle: int | None  # None: somebody who is not there
    kind: Literal[
        "anybody",  # the place is not known
        "room",  # we would stop in time
        "short",  # we would not stop in time
        "first",  # we would be past before it got in our way
        "behind",  # it is behind us
        "beside",  # it is right beside us
        "apart",  # it stays in a lane of its own
        "joins",  # it moves in ahead of us and drives on, with room to do so
        "standing",  # we stand still ourselves
    ]
    supposed: Event | None  # None: the action is not known here
    time: float  # [s] when it is supposed to do so
    speed: float  # [m/s] ours then
    needed: float | None = None  # [m] our stopping distance
    room: float | None = None  # [m] to it, or to where it gets in our way
    left: float | None = None  # [m] that would be left behind a leader that brakes as hard
    closing: float | None = None  # [m/s] by which one behind us is faster
    past: bool = False
    negated: bool = False  # it is supposed not to do that
    asked: Literal["stop", "collide"] | None = None  # of yes or no questions: do we stop, collide?
