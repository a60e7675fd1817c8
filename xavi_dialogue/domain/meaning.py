"""Meaning: the acts that an utterance consists of: questions, claims, requests, feelings, ..."""

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
from xavi_dialogue.domain.vocabulary import Extreme, FeelingKind, Merit, PeakKind


class Why(Value, frozen=True):
    """The question why something is so; with `Not`, why it is not ("why didn't you")."""

    of: Proposition
    instead: Proposition | None = None  # the contrast: "instead of", "rather than", "and not"
    suspect: Thing | None = None  # "is it the truck?", "because of him?"
    rival: Thing | None = None  # "... or because of the bus?"
    alone: bool = False  # "only because of him?", "because of him alone?"


class WhatIf(Value, frozen=True):
    """The question what would happen, or would have happened, under a supposition."""

    supposed: Proposition  # `Not(Exists(thing))`: if it were not there
    then: "Question | None" = None  # about the supposed world: "would you still have braked?"


class Whether(Value, frozen=True):
    """A yes or no question."""

    that: Proposition
    tag: bool = False  # worded as a statement: "you saw him, right?"
    degree: bool = False  # "how risky was that?"


class Which(Value, frozen=True):
    """The question for whom or what something holds: "who did you wait for"."""

    thing: Thing  # that is asked for: `Wanted`, or `Described` ("which of the red cars")
    such: Proposition | None = None  # that contains the `Wanted`; None: "who is" the `thing`?
    among: tuple[Thing, ...] = ()  # "who lets us in, the bus or the red car?"


class Identify(Value, frozen=True):
    """The question what a thing is: "what is that big thing", "which car is vehicle 3"."""

    thing: Thing


class HowMuch(Value, frozen=True):
    """The question for a measure: "how fast", "how far", "what is the limit", "which colour"."""

    of: Measured
    extreme: Extreme | None = None  # "the highest speed we reached"
    more_than: Quantity | None = None


class HowMany(Value, frozen=True):
    """The question how many things there are, or how often an event happened."""

    of: Thing | Event
    such: Thing | None = None  # grounded: the description of those that are counted


class When(Value, frozen=True):
    """The question at what time something happens, happened or will happen."""

    of: Proposition
    edge: Literal["begin", "end"] = "begin"


class HowLong(Value, frozen=True):
    """The question how long something lasts or lasted, or since when: "how long did you wait"."""

    of: Event | Proposition


class Where(Value, frozen=True):
    """The question where a thing is, or where an event took place."""

    of: Thing | Event
    time: Time = Unsaid()


class Whither(Value, frozen=True):
    """The question where somebody is going."""

    actor: Thing = Ego()
    time: Time = Unsaid()


class Doing(Value, frozen=True):
    """The question what somebody does, did, or will do; or what happened (`actor` None)."""

    actor: Thing | None = Ego()
    time: Time = Unsaid()
    tense: Tense = "present"
    besides: Proposition | None = None  # known already: the question is what else


class Compare(Value, frozen=True):
    """The question which of several is better, sooner, safer, smoother, faster, closer, ahead."""

    options: tuple[Proposition | Thing, ...]
    by: Merit
    least: bool = False  # which is slower, smaller, farther, behind


class Listing(Value, frozen=True):
    """The request for a list of things of a sort, with times if they have any."""

    of: Literal[
        "events", "vehicles", "options", "beliefs", "causes", "reasons", "stops", "decisions",
        "wrong-predictions", "capabilities", "rivals", "hidden",  # parts of the road
    ]  # fmt: skip
    about: Thing | None = None
    time: Time = Unsaid()
    event: Event | None = None  # of events: only those that match it


class Peak(Value, frozen=True):
    """The question when something was greatest: "the hardest moment", "the closest call"."""

    of: PeakKind
    time: Time = Unsaid()
    number: int = 1  # how many of them: "the three times we slowed down the most"
    deed: Event | None = None  # while we did what: "which turn was the slowest"


class Changed(Value, frozen=True):
    """The question what changed between two times in the plan, the view and the expectations."""

    time: Time = Unsaid()


class Summarise(Value, frozen=True):
    """The request for a summary of the ride, an interval, a vehicle, or the current episode."""

    about: Thing | Event | None = None
    time: Time = Unsaid()


class HowKnow(Value, frozen=True):
    """The question on what evidence the car believed or said something."""

    of: Proposition | None = None  # None: what the car said last


class HowSure(Value, frozen=True):
    """The question how probable the car considers something, or did."""

    of: Proposition | None = None
    time: Time = Unsaid()
    changed: bool = False  # how, when or why the probability changed


class HowDecide(Value, frozen=True):
    """The question how the car makes a decision, or how it works: the manner, not the reason."""

    of: Proposition | None = None


class WhatWouldChange(Value, frozen=True):
    """The question what a decision depends on, what mattered most, or what would change it."""

    of: Proposition | None = None
    most: bool = False  # the one factor that mattered most


class HowAvoid(Value, frozen=True):
    """The question how something could have been avoided, or done sooner or better."""

    of: Proposition | None = None


class Fault(Value, frozen=True):
    """The question whose fault it was, or whether it was legal; facts answer it, not a verdict."""

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
    """The passenger's feeling, and what it is about if they say so."""

    feeling: FeelingKind
    about: Proposition | Thing | None = None


class Repair(Value, frozen=True):
    """A turn about the conversation itself."""

    kind: Literal[
        "repeat", "simpler", "shorter", "longer", "cancel", "correct", "meant", "continue", "why",
        "yes", "no", "pick",
    ]  # fmt: skip
    thing: Thing | None = None  # "no, the red one": the thing that was meant instead
    question: Question | None = None  # "I meant ..."
    pick: int | None = None  # which of the readings offered, from 1


class Elliptic(Value, frozen=True):
    """A fragment that the question before completes: "and the bus?", "and before that?".

    Fields that are not None replace the part of the same sort in the question under discussion.
    """

    thing: Thing | None = None
    event: Event | None = None
    time: Time = Unsaid()
    negated: bool = False  # "and if he hadn't?", "why not?"
    form: Literal[
        "same", "why", "why-not", "what-if", "which", "when", "until", "where", "how", "how-much",
        "sure",
    ] = "same"  # fmt: skip
    besides: bool = False  # "what else", "anything else?"


class Social(Value, frozen=True):
    """A social move."""

    kind: Literal[
        "greeting", "farewell", "thanks", "apology", "praise", "insult", "joke", "how-are-you",
        "who-are-you", "are-you-human", "feelings", "agree", "disagree", "acknowledge", "laugh",
        "wish", "address", "caution",
    ]  # fmt: skip
    about: Proposition | Thing | None = None  # of "feelings": what our feelings would be about


class AskHelp(Value, frozen=True):
    """The question what can be asked, or how this works."""


class Quizzing(Value, frozen=True):
    """The wish of the passenger to be quizzed, or to stop the quiz."""

    stop: bool = False


class Beyond(Value, frozen=True):
    """A topic that the car cannot speak about, found by more than a single word."""

    topic: Literal[
        "off-topic", "injection", "non-english", "capability", "perception", "advice", "opinion",
        "unsupported-condition", "abuse",
    ]  # fmt: skip
    words: str = ""


Act: TypeAlias = (
    Ask | Claim | Request | Feel | Repair | Elliptic | Social | AskHelp | Quizzing | Beyond
)


class TokenShare(Value, frozen=True):
    """The contribution of one word to a reading."""

    text: str  # as typed
    read: str  # as read, spelling corrected
    share: Literal["meaning", "grammar", "politeness", "hedge", "address", "idle", "unknown"]
    part: str = ""  # what it stands for, for developers
    act: int | None = None  # index of the act that it belongs to; None: not known
    strange: bool = False  # it is in no vocabulary


class Unread(Value, frozen=True):
    """A stretch of a text that was not understood."""

    words: tuple[str, ...]  # as typed
    asks: bool = False  # it has the form of a question


class Reading(Value, frozen=True):
    """One way to understand an utterance, every word accounted for."""

    acts: tuple[Act, ...]
    shares: tuple[TokenShare, ...]
    cost: float = 0.0  # the lower, the likelier by the words alone
    unread: tuple[Unread, ...] = ()
    paraphrase: str = ""  # the plain question as which the whole text was understood
    ignored: tuple[tuple[str, ...], ...] = ()  # clauses without which the acts are the same

    @property
    def unknown(self) -> tuple[str, ...]:
        """Return the words, as typed, that have no part in the reading."""
        return tuple(share.text for share in self.shares if share.share == "unknown")

    @property
    def strange(self) -> tuple[str, ...]:
        """Return the words, as typed, that are in no vocabulary."""
        return tuple(share.text for share in self.shares if share.strange)
