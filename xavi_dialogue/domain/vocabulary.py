"""Vocabulary: the names of actions, attributes, relations and states that terms consist of."""

from typing import Literal, TypeAlias, get_args

from planner.record.trace import Action as MacroAction

#: Actions: first the macro actions, then other actions that people name. A lane change or turn
#: whose side is open is "change-lane" or "turn" with `Event.side` None.
ActionName: TypeAlias = Literal[
    "continue",  # follow the lane, go straight on where no junction comes first
    "change-left",
    "change-right",
    "exit-left",
    "exit-right",
    "exit-straight",
    "continue-next-exit",
    "stop",
    "give-way",  # to the object
    "slow-down",
    "speed-up",
    "overtake",  # the object
    "change-lane",  # side open
    "turn",  # side open
    "u-turn",
    "circle",  # go round a roundabout once more
    "fly",
    "go",  # move on, proceed, set off, pull away
    "move",  # be in motion, drive, as against standing
    "wait",  # for the object
    "stand",  # be at a standstill
    "brake",
    "swerve",
    "enter",  # the object: a junction, roundabout, lane, road
    "leave",  # the object: a roundabout, lane, road, junction; or go out of sight
    "merge",
    "cut-in",  # move in ahead of the object
    "pull-out",  # come out of a side road or a parking place, before the object
    "pass",  # go past the object, or go past us
    "follow",  # the object
    "keep-distance",  # to the object
    "approach",  # the object
    "come",  # towards us, from somewhere
    "cross",  # the object's way
    "let-go",  # let the object go first
    "block",  # the object
    "signal",  # a side, or "flash"
    "collide",  # with the object
    "nearly-collide",
    "avoid",  # the object
    "see",  # the object
    "appear",
    "disappear",
    "arrive",  # at the object, the destination unless said
    "head",  # be on the way to the object: a place or side
    "keep-lane",
    "change-plan",
    "do",  # something: "what is he doing", "do that"
    "happen",  # "what happened"
    "show",  # of a traffic light: a colour, the object
    "turn-colour",  # of a traffic light: to a colour, the object; or to another one
    # Actions that the car cannot do; a request for one is answered that way.
    "honk",
    "flash",
    "gesture",  # wave, nod, smile, shout
    "reverse",
    "park",
    "pull-over",
    "drop-off",
    "call",
    "open",
]

Side: TypeAlias = Literal["left", "right", "straight"]

#: How something is done.
Manner: TypeAlias = Literal[
    "hard", "gently", "suddenly", "fast", "slowly", "early", "late", "close", "again", "first",
    "far", "long", "still", "already", "safely", "on-purpose",
]  # fmt: skip
GENTLE: frozenset[Manner] = frozenset(("gently", "safely"))  # how passengers may want us to drive

#: What can be measured or seen. The comment states the unit; attributes with words have none.
Attribute: TypeAlias = Literal[
    "speed",  # [m/s]
    "limit",  # [m/s] in force where the thing is
    "speed-change",  # [m/s] difference in speed over the time or event
    "excess",  # [m/s] speed over the limit
    "acceleration",  # [m/s2] positive: speeding up
    "deceleration",  # [m/s2] positive: braking
    "gap",  # [m] bumper to bumper along the way, to the object
    "headway",  # [s] gap over the follower's speed
    "distance",  # [m] between bodies, to the object (a vehicle, junction, destination)
    "time-to-collision",  # [s] gap over closing speed
    "lane",  # which lane, from the right
    "lane-count",
    "indicator",  # lights shown
    "brake-lights",
    "colour",
    "kind",
    "size",  # [m] length
    "name",  # number on the screen
    "place",  # where it is, relative to us
    "origin",  # where it came from
    "heading",  # where it is going
    "right-of-way",
    "visibility",  # seen, hidden, lost; since when
    "distance-to-go",  # [m] to the destination
    "distance-driven",  # [m] of the ride so far
    "time-to-go",  # [s] to the destination
    "arrival-time",  # [s] clock of the ride
    "time",  # [s] clock of the ride now, or how long the ride has lasted
    "waiting-time",  # [s] spent at a standstill, or for the object
    "duration",  # [s] of an event
    "delay",  # [s] that an event cost or saved
    "probability",  # of a proposition
    "value",  # of an option
    "comfort",  # peak deceleration, jerk
    "jerk",  # [m/s3]
    "cost",  # reward terms of an option
    "exit-number",
    "turn",  # which way at the next junction
    "route",  # the way to the destination
    "count",
    "simulations",  # of a decision: of the option in `about`, that ended as the event says
    "options",  # of a decision
    "weather", "sound", "battery", "money", "law", "world",  # what no record holds
    "load", "occupant", "writing", "parts",  # of a vehicle: what cannot be seen from outside
]  # fmt: skip

Relation: TypeAlias = Literal[
    "ahead-of", "behind", "left-of", "right-of", "beside", "near", "oncoming-to", "between",
    "on",  # a lane, road, roundabout
    "from",  # comes from a place
    "to",  # is going to a place
    "has-priority-over",
    "must-yield-to",
    "waiting-for",
    "can-see",
    "sees-past",  # the object, which hides a part of the road
    "in-the-way-of",
    "same-as",
    "faster-than",
    "slower-than",
    "closer-than",
    "with",
]  # fmt: skip

#: States that people ascribe to a thing or an event.
State: TypeAlias = Literal[
    "safe", "dangerous", "comfortable", "uncomfortable", "allowed", "necessary", "possible",
    "free",  # a lane, a way
    "visible", "hidden", "stationary", "moving", "fast", "slow", "close", "far", "sure", "over",
    "late", "wrong", "right", "present", "lost", "stuck", "at-fault", "first", "last", "dirty",
    "astray",  # off the way to one's destination
    "big", "roomy", "normal", "worth-it", "better", "faulty", "awake", "autonomous", "busy",
    "upset",  # how a driver feels: angry, glad, afraid
]  # fmt: skip

#: What kind a vehicle looks to a passenger. "vehicle": not named, or cannot be known; "bike": with
#: or without a motor, which passengers may say, but is never the kind of a vehicle in view.
Kind: TypeAlias = Literal[
    "vehicle", "car", "truck", "bus", "van", "motorcycle", "bicycle", "pedestrian", "tram", "taxi",
    "emergency", "wheelchair", "scooter", "bike",
]  # fmt: skip

#: Where something is, relative to our car (or to the vehicle that is named with it).
Bearing: TypeAlias = Literal[
    "ahead", "behind", "left", "right", "ahead-left", "ahead-right", "behind-left", "behind-right",
    "beside", "beside-left", "beside-right", "oncoming", "around", "crossing-left",
    "crossing-right", "here", "there", "far",
]  # fmt: skip

Comparator: TypeAlias = Literal["more", "less", "same", "at-least", "at-most", "too-much", "enough"]
Extreme: TypeAlias = Literal["highest", "lowest", "first", "last", "mean", "total"]

#: What is at its most at a moment of the ride.
PeakKind: TypeAlias = Literal[
    "danger", "difficulty", "closeness", "braking", "slowing", "slowness", "speed", "waiting",
    "delay", "risk", "choice", "tightness",
]  # fmt: skip

FeelingKind: TypeAlias = Literal[
    "afraid", "nervous", "startled", "sick", "angry", "annoyed", "impatient", "bored", "happy",
    "relieved", "surprised", "confused", "impressed", "distrustful", "sad", "tired", "curious",
    "disliking", "liking",
]  # fmt: skip

#: What several things or actions are compared by.
Merit: TypeAlias = Literal[
    "best", "time", "safety", "comfort", "speed", "distance", "probability", "size", "place",
    "margin",  # by how much the one was chosen before the other
]  # fmt: skip

MACRO_ACTIONS: tuple[MacroAction, ...] = get_args(MacroAction)
BEYOND: frozenset[ActionName] = frozenset(
    (
        "honk",
        "flash",
        "reverse",
        "park",
        "pull-over",
        "drop-off",
        "call",
        "open",
        "u-turn",
        "fly",
        "gesture",
    )
)
