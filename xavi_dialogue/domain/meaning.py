"""Meaning: what an utterance is: a row of acts, each a question, claim, request, feeling, ..."""

from typing import Literal, TypeAlias

from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Measured,
    Proposition,
    Quantity,
    Tense,
    Thing,
    Time,
    Unsaid,
)
from xavi_dialogue.domain.vocabulary import Extreme, FeelingKind, Merit


class Why(Value, frozen=True):
    """Why something is so; with `Not`, why it is not ("why not", "why didn't you")."""

    of: Proposition
    instead: Proposition | None = None  # the contrast: "instead of", "rather than", "and not"
    suspect: Thing | None = None  # "is it the truck?", "because of him?"
    rival: Thing | None = None  # "... or because of the bus?"
    alone: bool = False  # "only because of him?", "because of him alone?"


class WhatIf(Value, frozen=True):
    """What would have been, or would be, under a supposition."""

    supposed: Proposition  # `Not(Exists(thing))`: if it were not there
    then: "Question | None" = None  # asked of that world: "would you still have braked?"


class Whether(Value, frozen=True):
    """A yes or no question."""

    that: Proposition
    tag: bool = False  # put as a statement: "you saw him, right?"
    degree: bool = False  # "how risky was that?"


class Which(Value, frozen=True):
    """Who or which thing it is of which something holds: "who did you wait for"."""

    thing: Thing  # what is asked for: `Wanted`, or `Described` ("which of the red cars")
    such: Proposition | None = None  # with the `Wanted` in it; None: "who is that?" of `thing`
    among: tuple[Thing, ...] = ()  # "who lets us in, the bus or the red car?"


class Identify(Value, frozen=True):
    """What or who a thing is: "what is that big thing on the left", "which car is vehicle 3"."""

    thing: Thing


class HowMuch(Value, frozen=True):
    """The value of a measure: "how fast", "how far", "what is the limit", "which colour"."""

    of: Measured
    extreme: Extreme | None = None  # "the highest speed we reached"
    more_than: Quantity | None = None


class HowMany(Value, frozen=True):
    """How many things there are, or how often an event happened."""

    of: Thing | Event
    such: Thing | None = None  # grounded: what was said of those that are counted


class When(Value, frozen=True):
    """At what time something happens, happened or will."""

    of: Proposition
    edge: Literal["begin", "end"] = "begin"


class HowLong(Value, frozen=True):
    """How long something lasts or lasted, or since when it is so: "how long did you wait"."""

    of: Event | Proposition


class Where(Value, frozen=True):
    """Where a thing is, or where an event took place."""

    of: Thing | Event
    time: Time = Unsaid()


class Whither(Value, frozen=True):
    """Where somebody is going."""

    actor: Thing = Ego()
    time: Time = Unsaid()


class Doing(Value, frozen=True):
    """What somebody does, did, or will do next; or what happened (`actor` None)."""

    actor: Thing | None = Ego()
    time: Time = Unsaid()
    tense: Tense = "present"
    besides: Proposition | None = None  # what else


class Compare(Value, frozen=True):
    """Which of several is better, sooner, safer, smoother, faster, closer, ahead."""

    options: tuple[Proposition | Thing, ...]
    by: Merit
    least: bool = False  # which is slower, smaller, farther, behind


class Listing(Value, frozen=True):
    """List things of a sort, with times where they have them."""

    of: Literal[
        "events", "vehicles", "options", "beliefs", "causes", "reasons", "stops", "decisions",
        "wrong-predictions", "capabilities", "rivals",
        "hidden",  # parts of the road
    ]  # fmt: skip
    about: Thing | None = None
    time: Time = Unsaid()
    event: Event | None = None  # of events: only those that are such


class Peak(Value, frozen=True):
    """The moment at which something was at its most: "the hardest moment", "the closest call"."""

    of: Literal["danger", "difficulty", "closeness", "braking", "slowing", "slowness", "speed",
                "waiting", "delay"]  # fmt: skip
    time: Time = Unsaid()
    number: int = 1  # how many of them: "the three times we slowed down the most"


class Changed(Value, frozen=True):
    """What became different between two times, in the plan and in what was seen and expected."""

    time: Time = Unsaid()


class Summarise(Value, frozen=True):
    """Tell what happened: of the ride, an interval, a vehicle, or the episode spoken of."""

    about: Thing | Event | None = None
    time: Time = Unsaid()


class HowKnow(Value, frozen=True):
    """On what evidence something was believed or said."""

    of: Proposition | None = None  # None: what was said last


class HowSure(Value, frozen=True):
    """How probable something was or is, for the car."""

    of: Proposition | None = None
    time: Time = Unsaid()
    changed: bool = False  # how it moved, when or why it changed


class HowDecide(Value, frozen=True):
    """How the car came to a decision, or how it works: the manner, not the reason."""

    of: Proposition | None = None


class WhatWouldChange(Value, frozen=True):
    """What a decision hangs on; what mattered most; what would have made it decide otherwise."""

    of: Proposition | None = None
    most: bool = False  # the one factor that mattered most


class HowAvoid(Value, frozen=True):
    """How something could have been avoided, or done sooner or better."""

    of: Proposition | None = None


class Fault(Value, frozen=True):
    """Whose fault, who is to blame, was it legal: answered by facts, not by a verdict."""

    of: Proposition | None = None
    suspect: Thing | None = None
    legal: bool = False


Question: TypeAlias = (
    Why
    | WhatIf
    | Whether
    | Which
    | Identify
    | HowMuch
    | HowMany
    | When
    | HowLong
    | Where
    | Whither
    | Doing
    | Compare
    | Listing
    | Peak
    | Changed
    | Summarise
    | HowKnow
    | HowSure
    | HowDecide
    | WhatWouldChange
    | HowAvoid
    | Fault
)

# --- acts ---------------------------------------------------------------------------------------


class Ask(Value, frozen=True):
    """A question."""

    question: Question


class Claim(Value, frozen=True):
    """A statement about the ride, to be checked: "that is not true, it was going straight"."""

    that: Proposition
    challenge: bool = False  # it disputes what the car said or did


class Request(Value, frozen=True):
    """Something the car is asked to do: "slow down please", "overtake it", "drop me off"."""

    event: Event
    negated: bool = False  # not to do it: "don't stop"


class Feel(Value, frozen=True):
    """How the passenger feels, about what where that is said."""

    feeling: FeelingKind
    about: Proposition | Thing | None = None


class Repair(Value, frozen=True):
    """A turn about the conversation itself."""

    kind: Literal[
        "repeat", "simpler", "shorter", "longer", "cancel", "correct", "meant", "continue", "why",
        "yes", "no", "pick",
    ]  # fmt: skip
    thing: Thing | None = None  # "no, the red one": what was meant instead
    question: Question | None = None  # "I meant ..."
    pick: int | None = None  # which of the readings offered, from 1


class Elliptic(Value, frozen=True):
    """A fragment that takes its frame from the question before: "and the bus?", "and before that?".

    What is not None replaces the part of the same sort in the question under discussion.
    """

    thing: Thing | None = None
    event: Event | None = None
    time: Time = Unsaid()
    negated: bool = False  # "and if he hadn't?", "why not?"
    form: Literal["same", "why", "why-not", "what-if", "which", "when", "where", "how", "sure"] = (
        "same"
    )
    besides: bool = False  # "what else", "anything else?"


class Social(Value, frozen=True):
    """A social move."""

    kind: Literal[
        "greeting", "farewell", "thanks", "apology", "praise", "insult", "joke", "how-are-you",
        "who-are-you", "are-you-human", "feelings", "agree", "disagree", "acknowledge", "laugh",
        "wish", "address", "caution",
    ]  # fmt: skip
    about: Proposition | Thing | None = None  # of "feelings": what is to have stirred us


class AskHelp(Value, frozen=True):
    """What can be asked, how this works."""


class Quizzing(Value, frozen=True):
    """The passenger wants to be quizzed, or to stop it."""

    stop: bool = False


class Beyond(Value, frozen=True):
    """What the car cannot speak of, as read from the words: what topic, never by a word alone."""

    topic: Literal[
        "off-topic", "injection", "non-english", "capability", "perception", "advice", "opinion",
        "unsupported-condition", "abuse",
    ]  # fmt: skip
    words: str = ""


Act: TypeAlias = (
    Ask | Claim | Request | Feel | Repair | Elliptic | Social | AskHelp | Quizzing | Beyond
)


class TokenShare(Value, frozen=True):
    """What one word contributes to a reading."""

    text: str  # as typed
    read: str  # as read, spelling corrected
    share: Literal["meaning", "grammar", "politeness", "hedge", "address", "unknown"]
    part: str = ""  # what it stands for, for developers
    act: int | None = None  # index of the act that it belongs to; None: not told
    strange: bool = False  # it is no English word that is known


class Unread(Value, frozen=True):
    """A stretch of a text of which nothing was made."""

    words: tuple[str, ...]  # as typed
    asks: bool = False  # it has the form of a question


class Reading(Value, frozen=True):
    """One way to understand an utterance, every word accounted for."""

    acts: tuple[Act, ...]
    shares: tuple[TokenShare, ...]
    cost: float = 0.0  # lower is likelier, by the words alone
    unread: tuple[Unread, ...] = ()
    paraphrase: str = ""  # the plain question that the text as a whole was taken for
    ignored: tuple[tuple[str, ...], ...] = ()  # clauses without which the acts are the same

    @property
    def unknown(self) -> tuple[str, ...]:
        """The words as typed that have no part in the reading."""
        return tuple(share.text for share in self.shares if share.share == "unknown")

    @property
    def strange(self) -> tuple[str, ...]:
        """The words as typed that are no words that are known."""
        return tuple(share.text for share in self.shares if share.strange)
