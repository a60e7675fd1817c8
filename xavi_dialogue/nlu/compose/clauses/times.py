"""Times: phrases that say when."""

from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Ago,
    At,
    AtDecision,
    Back,
    Between,
    Ego,
    Event,
    Feature,
    Happens,
    Junction,
    Next,
    Now,
    Pronoun,
    Proposition,
    Rank,
    Related,
    Relative,
    Road,
    Start,
    Thing,
    Time,
    Unsaid,
    WholeRide,
    Within,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import as_thing
from xavi_dialogue.nlu.compose.clauses.tree import leaf_of, leaves_of, nodes_of, number_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}
UP_TO_NOW = 1e6  # [s] the end of a stretch that reaches up to now, or its decision
#: Deeds that name by their beginning the moment at which something was so.
MOMENTARY = frozenset(
    ("go", "do", "brake", "slow-down", "speed-up", "stop", "change-lane", "change-left",
     "change-right", "pull-out", "cut-in", "merge", "enter", "leave", "appear", "signal", "see"),
)  # fmt: skip
EARLIER = frozenset({"earlier", "before", "previously"})
PAST: tuple[Time, ...] = (Back("before"), Back("earlier"))
FEW = 5.0  # [s] "a few seconds"
_ADVERBS: dict[str, Time] = {
    "now": Now(),
    "recent": Ago(None),
    "past": Back("earlier"),
    "then": Back("during"),
    "before-that": Back("before"),
    "after-that": Back("after"),
    "between": Back("between"),
    "start": Start(),
    "whole": WholeRide(),
    "next": Next(),
    "soon": Within(None),
    "last-time": Rank(-1),
    "end": Rank(-1),
}


def clock(word: str) -> float:
    """Read a time of the ride: "1:05" is 65 s."""
    minutes, _, seconds = word.partition(":")
    return int(minutes) * 60.0 + int(seconds)


def time_of(node: Node) -> Time:
    """Read a phrase that says when."""
    if node.name == "time_adverb":
        leaf = leaf_of(node, "TIMEADV")
        return _ADVERBS[leaf.key] if leaf else Unsaid()
    clocks = [clock(leaf.key) for leaf in leaves_of(node) if leaf.category == "CLOCK"]
    if node.name == "time_between" and len(clocks) > 1:
        return Between(min(clocks), max(clocks))
    if clocks and node.name != "time_to_now":
        return _placed(node, clocks[0])
    if node.name == "time_since":
        adverbs = [leaf.key for leaf in leaves_of(node) if leaf.category == "TIMEADV"]
        return Back("after") if "now" in adverbs else Unsaid()
    if node.name == "time_to_now":
        return _to_now(node)
    if node.name == "time_rank":
        return Rank(_rank(node))
    if node.name in ("time_decision", "time_decisions"):
        ranks = [int(number_of(part)) for part in nodes_of(node, "num")]
        if _preposition(node) == "since":
            ranks.append(int(UP_TO_NOW))
        return AtDecision(min(ranks), max(ranks) if len(ranks) > 1 else None)
    if node.name == "time_between":
        numbers = [number_of(part) for part in nodes_of(node, "num")]
        return Between(min(numbers), max(numbers))
    return _amount(node)


def _to_now(node: Node) -> Time:
    """Read "between 13 s and now", "from decision 4 to now"."""
    adverb = leaf_of(node, "TIMEADV")
    if adverb is None or adverb.key != "now":
        return Unsaid()
    clocks = [clock(leaf.key) for leaf in leaves_of(node) if leaf.category == "CLOCK"]
    if clocks:
        return Between(clocks[0], UP_TO_NOW)
    number = number_of(nodes_of(node, "num")[0])
    if leaf_of(node, "DECIDED") is not None:
        return AtDecision(int(number), int(UP_TO_NOW))
    return Between(seconds_of(node) or number, UP_TO_NOW)


def _rank(node: Node) -> int:
    leaf = leaf_of(node, "ORD")
    return int(leaf.key) if leaf and leaf.key not in ("next",) else 1


def _placed(node: Node, at: float) -> Time:
    key = _preposition(node)
    if key == "before" or key == "until":
        return Between(0.0, at)
    if key in ("since", "from"):
        return Between(at, UP_TO_NOW)
    return At(at)


def _preposition(node: Node) -> str:
    first = node.parts[0]
    if isinstance(first, Node) or first.category not in ("P", "SUBORD", "BEARP"):
        return ""
    return first.key


def seconds_of(node: Node) -> float | None:
    """Read a stretch of time in seconds; None where it is not said how many."""
    unit = leaf_of(node, "TUNIT")
    scale = SECONDS.get(unit.key, 1.0) if unit else 1.0
    numbers = nodes_of(node, "num")
    if numbers and number_before(node) is None:
        return number_of(numbers[0]) * scale
    determiners = [p for p in node.parts if isinstance(p, Leaf) and p.category == "DET"]
    if any(one.key == "many" for one in determiners):
        return FEW * scale
    return scale if any(one.words[0] in ("a", "one") for one in determiners) else None


def time_within(node: Node, clause: Clause) -> Within | None:
    """Read "within five seconds" of what is to come; None: it is no time."""
    amount = cast(Node, node.parts[1])
    if len(node.parts) > 2 or leaf_of(amount, "TUNIT") is None or clause.tense == "past":
        return None
    return Within(seconds_of(amount))


def number_before(node: Node) -> float | None:
    """Find a number that is none of seconds: the eighty of "eighty a minute ago"; None: none."""
    numbers, article = nodes_of(node, "num"), leaf_of(node, "DET")
    if node.name != "time_ago" or not numbers or article is None:
        return None
    said = number_of(numbers[0])
    return said if said >= 1.0 and article.start >= numbers[0].end else None


def left_behind(clause: Clause) -> Event | None:
    """Read "we are off this roundabout" as our leaving of it."""
    if clause.verb is not None or not isinstance(clause.subject, Ego) or clause.negated:
        return None
    places = [as_thing(c.sem) for c in clause.complements if c.key in ("off", "from", "out")]
    found = next((p for p in places if isinstance(p, Junction | Road | Pronoun)), None)
    return None if found is None else Event("leave", Ego(), found, tense="present")


def come_to(clause: Clause) -> Event | None:
    """Read "until we are at the light" as our coming to that place."""
    if clause.verb is not None or not isinstance(clause.subject, Ego) or clause.negated:
        return None
    places = [as_thing(c.sem) for c in clause.complements if c.key in ("at", "on", "by", "in")]
    found = next((p for p in places if is_come_to(p)), None)
    return None if found is None else Event("arrive", Ego(), found, tense="present")


def is_come_to(place: Thing | None) -> bool:
    """Check whether we come to a place on our way: a junction, a light, a line."""
    at_junction = isinstance(place, Feature) and place.kind in ("light", "line", "crossing")
    return at_junction or isinstance(place, Junction)


def as_coming_to(of: Proposition) -> Proposition:
    """Take being at a place, asked of its time to come, for our coming there."""
    match of:
        case Related(relation="on", thing=Ego(), to=place) if is_come_to(place):
            if of.tense in ("present", "future"):
                return Happens(Event("arrive", Ego(), place, tense="future"))
    return of


def _amount(node: Node) -> Time:
    """Read an amount of time, or after "at" a bare number of seconds."""
    if node.name == "time_bare" and leaf_of(nodes_of(node, "num")[0], "HUNDRED"):
        return Unsaid()  # "he went past us at a hundred"
    if node.name == "time_bare":
        return At(number_of(nodes_of(node, "num")[0]))
    amount = seconds_of(node)
    key = _preposition(node)
    adverb = leaf_of(node, "TIMEADV")
    if node.name == "time_ago":
        later = adverb is not None and adverb.key in ("next", "after-that", "now")
        if amount is not None and adverb is not None and EARLIER.intersection(adverb.words):
            return Back("before", amount)
        return Within(amount) if later else Ago(amount)
    if node.name == "time_span":
        order = leaf_of(node, "ORD")
        unit = leaf_of(node, "TUNIT")
        some = SECONDS.get(unit.key, 1.0) if unit and unit.key != "s" else FEW
        span = amount if amount is not None else some
        if order is not None and order.key == "next":
            return Within(span)
        return Ago(span, span=True)
    if key in ("in", "after") and amount is not None:
        return Within(amount)
    if key in ("for", "over", "during"):
        return Unsaid()
    if amount is not None and (key == "since" or (key == "from" and leaf_of(node, "PART"))):
        return Between(amount, UP_TO_NOW)  # "since forty seconds", "from ten seconds on"
    return At(amount) if amount is not None else Unsaid()


def relative(relation: str, anchor: object) -> Time:
    """Build a time before, after or during something."""
    match anchor:
        case Event(action="approach", actor=Ego(), object=Junction() as place):
            relation, anchor = "before", place  # "as we came up to the roundabout"
    names = {"before": "before", "after": "after", "until": "until", "since": "since"}
    return Relative(names.get(relation, "during"), anchor)  # type: ignore[arg-type]


def is_moment(time: Time) -> bool:
    """Tell whether a time is one moment: "at 12 s", "when you set off"."""
    if isinstance(time, Relative):
        of = time.anchor if time.relation == "during" else None
        return isinstance(of, Event) and of.action in MOMENTARY
    return isinstance(time, At) or (isinstance(time, AtDecision) and time.last is None)


def place_time(key: str, sem: object) -> Time | None:
    """Turn "at the junction" into a time; None where it is no such place."""
    if not isinstance(sem, Junction):
        return None
    relation: Any = key if key in ("before", "after", "until", "since") else "during"
    return Relative(relation, sem)


def at_place(clause: Clause) -> Time:
    """Take "at the second junction" for the time at which we were there."""
    untimed = clause.tense == "past" and isinstance(clause.time, Unsaid)
    places = (c.sem for c in clause.complements if untimed and c.key in ("at", "in", "over"))
    found = (Relative("during", of) for sem in places if (of := _anchor(sem)) is not None)
    return next(found, clause.time)


def _anchor(place: object) -> Junction | Event | None:
    """Give what a place is known by: a junction as such, a bend by our turn in it."""
    if isinstance(place, Feature) and place.kind == "bend":
        return Event("turn", time=Unsaid() if place.rank is None else Rank(place.rank))
    return place if isinstance(place, Junction) else None
