"""Heads: the head of a noun phrase with its traits becomes a vehicle, place, measure or deed."""

from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.terms import (
    Believed,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Exit,
    Feature,
    Happens,
    Is,
    Junction,
    Lane,
    Measured,
    Nobody,
    Passenger,
    Pronoun,
    Rank,
    Record,
    Road,
    Thing,
    Unknown,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.compose.clauses.extents import SLOWING, extent_of
from xavi_dialogue.nlu.compose.clauses.peaks import (
    braked_most,
    curve_ranked,
    deed_peak,
    deed_ranked,
    done_most,
    most_risk,
    peaks_of,
    quality_of,
)
from xavi_dialogue.nlu.compose.clauses.risks import risk_of
from xavi_dialogue.nlu.compose.clauses.sem import (
    Group,
    Measure,
    Moment,
    Noun,
    Sem,
    SideOf,
    as_thing,
    is_thing,
)
from xavi_dialogue.nlu.compose.clauses.traits import Traits, crossing, described, still_due
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.verbs.lights import light_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_PLACES: dict[str, Thing] = {
    "destination": Destination(),
    "own-lane": Lane("own"),
    "other-lane": Lane("other"),
    "wrong-lane": Lane("other"),
    "fitting-lane": Lane("own"),
    "left-lane": Lane("leftmost"),
    "right-lane": Lane("rightmost"),
    "left-lane-typed": Lane("left"),
    "right-lane-typed": Lane("right"),
    "left-exit": Exit(side="left"),
    "right-exit": Exit(side="right"),
    "side-road": Road("side"),
    "main-road": Road("main"),
    "wrong-way": Road("wrong"),
    **{place: Unknown(place) for place in ("here", "there")},
}


def noun(head: Leaf | Node | None, traits: Traits) -> Sem:
    """Read a noun phrase by its head."""
    if head is None:
        return _without_head(traits)
    if isinstance(head, Node):
        return Unknown(words_of(head))
    plural = head.form == "plural"
    match head.category:
        case "TUNIT" if head.words == ("second",) and _is_rank(traits):
            traits.ordinal = 2
            return described("vehicle", traits)
        case "KIND":
            return _vehicle(head, traits, plural)
        case "PLACEN":
            return curve_ranked(head.words, traits.extreme) or _place(head, traits)
        case "MEAS":
            return _SIREN if head.key == "siren" else _measure(head, traits, plural)
        case "EVN":
            found = _deed(head, traits)
            return deed_ranked(found, traits.extreme) or found
        case "RIDE":
            return Record() if head.key == "record" else Noun("ride", word=head.words[-1])
        case "UNIT" | "TUNIT" | "TIMES":
            return Moment(head.key, traits.ordinal)
        case "SIDE":
            return SideOf(head.key)
        case "ABS":
            return _abstract(head, traits, plural)
    return Unknown(" ".join([*traits.unknown, *head.words]))


_SEVERAL = frozenset({"people", "children", "schoolchildren"})  # irregular plurals
_BARE = ("highest", "lowest", "mean", "total", "best", "tightest", "sharpest")
_MET = (Vehicle, Described, Pronoun)
_SIREN = Measure(Measured("sound", Described(kind="emergency", definite=False)))


def _is_rank(traits: Traits) -> bool:
    """Say whether "the second" is no time: nothing else is said of it."""
    return traits.determiner == "def" and traits.ordinal is None and not traits.fields


def _without_head(traits: Traits) -> Sem:
    extent = extent_of(traits)
    if extent is not None:
        return extent
    if traits.extreme in _BARE and not traits.fields:
        return Unknown(traits.extreme)
    if traits.unknown:
        return Unknown(" ".join(traits.unknown))
    if traits.side and not traits.fields:
        return SideOf(traits.side)
    if traits.adjectives == ["new"] and not traits.fields:
        return Pronoun("that")  # "the same"
    if traits.determiner in ("this", "that") and traits.fields == {"number": 2}:
        return Pronoun("them-all")  # "those two"
    return described(traits.kind or "vehicle", traits)


def _vehicle(head: Leaf, traits: Traits, plural: bool) -> Sem:
    own = traits.determiner in ("our", "your") or isinstance(traits.owner, Ego)
    if own and head.key in ("car", "vehicle", "taxi") and not traits.fields:
        return Ego()
    special = [k for k in traits.fields if k not in ("number",)]
    if (traits.determiner == "every" or (traits.determiner == "def" and "all" in head.words)) and (
        not special
    ):
        return Everyone(cast(Any, head.key))
    kind = traits.kind if head.key in ("car", "vehicle") and traits.kind else head.key
    plural |= head.words[-1] in _SEVERAL
    found = described(kind, traits, plural=plural or traits.determiner == "every")
    if traits.determiner == "no":
        return Nobody(found)
    if head.words == ("one",) and traits.determiner in ("that", "this") and not special:
        return Pronoun(cast(Any, traits.determiner))
    quality = quality_of(traits.extreme, [])
    happened = traits.event is None or traits.event.action == "happen"
    if head.words == ("thing",) and quality in ("danger", "difficulty") and happened:
        return Noun("peak", word="thing", quality=quality)  # "the scariest thing that happened"
    if head.words == ("thing",) and traits.determiner in ("that", "this") and not special:
        return Pronoun(cast(Any, traits.determiner))
    return found


def _place(head: Leaf, traits: Traits) -> Sem:
    owner = as_thing(traits.owner or traits.of)
    if head.key == "destination" and owner is not None and not isinstance(owner, Ego):
        return Measure(Measured("heading", owner))
    if head.key == "light":
        return light_of(head, traits, owner)
    if head.key == "headlight" and owner is not None:
        return Measure(Measured("indicator", owner))
    if head.key in _PLACES and not (head.key.endswith("lane") and traits.owner):
        return _PLACES[head.key]
    rank = 1 if traits.following else traits.ordinal
    if rank is None and traits.determiner == "this":
        rank = 1
    side = traits.side if traits.side != "straight" else None
    match head.key:
        case "junction" if traits.kind and head.words == ("crossing",):
            return crossing(traits.kind, traits)
        case "junction" | "roundabout":
            definite = traits.owner is not None or traits.determiner == "def" or head.words[:-1]
            turning = bool(definite) and head.words[-1] in ("turning", "turn-off", "turnoff")
            return Junction(cast(Any, head.key), rank, turning=turning and rank is None)
        case "exit":
            return Exit(rank, cast(Any, side))
        case "road":
            return Road(cast(Any, side or "own"))
        case "lane" | "own-lane" | "left-lane-typed" | "right-lane-typed" | "other-lane":
            return _lane(head, traits, side, rank)
    beside = traits.fields.get("bearing") or traits.side
    if head.key == "space" and beside in ("left", "right"):
        return Measure(Measured("gap", to=Lane(cast(Any, beside))))  # "room on the left"
    if head.key == "space" and beside in ("ahead", "behind") and "gap" in head.words:
        back = Described(bearing="behind", extreme="nearest") if beside == "behind" else None
        return Measure(Measured("gap", to=back))
    if head.key == "queue" and isinstance(traits.of, Described) and traits.of.plural:
        said = {k: v for k, v in traits.fields.items() if k in ("bearing", "of", "doing", "such")}
        return structs.replace(traits.of, **said)
    apart = next((as_thing(s) for k, s in traits.about if k in ("into", "with", "from")), None)
    if head.key == "space" and isinstance(apart, Described | Vehicle | Pronoun):
        return Measure(Measured("distance", to=apart))  # "the space to the lorry"
    if head.key == "circle-shape":
        return Junction("roundabout")
    theirs = head.key == "way" and not isinstance(owner, Ego | Passenger)
    turned = traits.ordinal if head.key == "bend" else None
    return Feature(cast(Any, head.key), rank=turned, of=owner if theirs else None)


def _lane(head: Leaf, traits: Traits, side: str | None, rank: int | None) -> Lane:
    owner = as_thing(traits.owner or traits.of)
    of = None if isinstance(owner, (Ego, Passenger)) else owner
    listed = head.key.split("-")[0]
    behind = traits.fields.get("bearing")  # "change lanes to the right"
    side = side or (behind if behind in ("left", "right") else None)
    which = listed if listed in ("left", "right", "other") else side
    if which is None and (traits.other or traits.following):
        which = "other"
    if which is None:
        any_of = ("indef", "that", "every", "many")
        indefinite = head.form == "plural" or traits.determiner in any_of
        which = "any" if indefinite and not traits.owner else "own"
    return Lane(cast(Any, which), of)


def _measure(head: Leaf, traits: Traits, plural: bool) -> Sem:
    of = traits.of or traits.owner
    if head.key == "limit" and "number" in traits.fields:
        return described("vehicle", traits)  # "a fifty zone"
    things = [as_thing(s) for k, s in traits.about if k in ("into", "from", "over", "with")]
    to = next((t for t in things if t is not None), None)
    if head.key == "probability" and isinstance(traits.clause, Believed):
        return Measure(Measured("probability", about=traits.clause.content))  # "you gave it"
    if head.key == "probability" and isinstance(traits.clause, Happens):
        return Unknown(head.words[-1])  # nobody does anything to a chance
    if head.key == "probability" and of is None:
        of = next((s for k, s in traits.about if k in ("for", "about", "in")), None)
    beside = traits.fields.get("bearing") or traits.side
    if to is None and head.key in ("gap", "distance") and beside in ("left", "right"):
        to = Lane(cast(Any, beside))  # "a gap on the left"
    elif to is None and head.key in ("gap", "distance", "headway") and beside == "behind":
        to = Described(bearing="behind", extreme="nearest")  # "the gap behind"
    members = of.members if isinstance(of, Group) else ()
    if len(members) == 2:
        of, to = members[0], as_thing(members[1])
    event = of if isinstance(of, Event) else traits.event
    thing = of if is_thing(of) and not isinstance(of, Pronoun) else as_thing(of)
    if head.key == "colour" and of is None:  # "the one in green colour", "the colour"
        hued = "colour" in traits.fields
        return described("vehicle", traits) if hued else Measure(Measured("colour", Pronoun("it")))
    if head.key == "distance" and isinstance(to, Destination):
        return Measure(Measured("distance-to-go", cast(Any, thing) or Ego()))
    key = head.key
    if key == "speed" and isinstance(traits.clause, Is) and traits.clause.state == "allowed":
        key = "limit"  # "the speed that is permitted"
    if key == "place" and event is not None:
        action = "stop" if event.action == "block" else event.action  # the place is no vehicle
        of = event = structs.replace(event, action=action, object=None)
    if traits.deed is not None and key in ("duration", "delay") and event is None:
        event = of = Event(cast(Any, traits.deed), tense="past")
    if (risk := risk_of(key, of, event, beside)) is not None:
        return risk
    if key == "risk":  # of a collision, where nothing else is said
        named = (to, None if isinstance(of, Event) else as_thing(thing))
        whom = next((t for t in named if isinstance(t, _MET)), None)
        if event is None or (event.action == "collide" and event.object is None):
            event = Event("collide", object=whom)
        return Measure(Measured("probability", event=event), most_risk(traits.extreme))
    if key == "speed-difference":
        other = thing is not None and not isinstance(thing, Ego)
        key, to = "speed", to or (Ego() if other else Pronoun("it"))
    measured = Measured(
        cast(Any, key), cast(Thing, thing) if thing is not None else Ego(), to,
        event if isinstance(of, Event) else None,
    )  # fmt: skip
    highest = {"nearest": "lowest", "fastest": "highest", "slowest": "lowest",
               "farthest": "highest", "biggest": "highest", "smallest": "lowest",
               "difficult": "highest", "sharpest": "highest", "tightest": "lowest"}  # fmt: skip
    extreme = highest.get(traits.extreme or "", traits.extreme)
    closest = "lowest" if {"closest", "nearest", "close", "minimum"} & set(head.words) else None
    extreme = extreme if extreme in ("highest", "lowest", "mean", "total") else closest
    if "peak" in head.words:
        extreme = "highest"
    return Measure(measured, cast(Any, extreme), plural, isinstance(traits.owner, Ego))


def _deed(head: Leaf, traits: Traits) -> Sem:
    if head.key == "do" and traits.ordinal in (-1, 1) and traits.determiner == "def":
        return Noun("deed", word=head.words[-1], quality="last" if traits.ordinal < 0 else "first")
    if most := deed_peak(head.key, traits.extreme):
        return peaks_of(head, traits, most)
    if head.key == "do" and traits.extreme and quality_of(traits.extreme, traits.adjectives):
        quality = quality_of(traits.extreme, traits.adjectives, head.words)
        return Noun("peak", word=head.words[-1], quality=quality)
    actor = as_thing(traits.owner) or as_thing(traits.of) or Ego()
    side = cast(Any, traits.side)
    action = head.key
    if traits.kind and action in SLOWING | {"wait", "stand"}:
        actor = described(traits.kind, traits)  # "made the bus wait"
    if action == "brake" and traits.extreme == "lowest":
        return Measure(Measured("deceleration", actor), cast(Any, traits.extreme))
    if action in ("change-lane", "turn") and side in ("left", "right"):
        action = ("change-" if action == "change-lane" else "exit-") + side
        side = None
    known = traits.determiner in ("that", "this") and action == "do"
    said = {*traits.adjectives, *head.words}  # "hard braking" is one noun
    manner = tuple(a for a in ("hard", "sudden", "late", "early") if a in said)
    manners = tuple("suddenly" if a == "sudden" else a for a in manner)
    obj = next((as_thing(s) for k, s in traits.about if k in ("for", "into", "with")), None)
    due = traits.following or still_due(traits.clause)
    if due and action in ("turn", "exit-left", "exit-right", "change-lane", "stop"):
        return Event(cast(Any, action), actor, obj, side, tense="future")
    if known or (action == "do" and traits.determiner == "def"):
        return Event("do", actor, Pronoun("that"))
    rank = Unsaid() if traits.ordinal is None else Rank(traits.ordinal)
    return Event(cast(Any, action), actor, obj, side, cast(Any, manners), rank)


def _abstract(head: Leaf, traits: Traits, plural: bool) -> Sem:
    if head.key == "side" and traits.side:
        return SideOf(traits.side)
    if head.key == "option" and traits.deed is not None and not plural:
        return Event(cast(Any, traits.deed))  # "the stop branch"
    if head.key == "event" and traits.place is not None:
        return traits.place  # "the roundabout business"
    quality = braked_most(traits.of, traits.extreme)
    quality = quality or quality_of(traits.extreme, traits.adjectives)
    if quality and (head.key in ("peak", "event") or "call" in head.words):
        return Noun("peak", word=" ".join(head.words), quality=quality)
    deed = traits.clause.event if isinstance(traits.clause, Happens) else None
    most = "" if deed is None else done_most(deed, traits.gerund, traits.extreme)
    if head.key in ("time", "moment", "peak") and most:
        return peaks_of(head, traits, most)
    about = next((s for k, s in traits.about), None)
    extreme = traits.extreme if traits.extreme in ("highest", "lowest", "best") else None
    owner = traits.owner
    if owner is None and head.key == "fault" and traits.kind is not None:
        owner = structs.replace(described(traits.kind, traits), doing=None, such=None)
    return Noun(
        "event" if head.key == "peak" else head.key, traits.of, owner, about, plural, traits.other,
        traits.determiner == "no", "highest" if extreme else None, " ".join(head.words),
        traits.clause, number=(traits.ordinal or 1) if head.key == "time" else 1,
    )  # fmt: skip


def rank_of(leaf: Leaf | None) -> int:
    """Read an ordinal."""
    if leaf is None:
        return 1
    return 1 if leaf.key == "next" else int(leaf.key)
