"""Things: noun phrases become vehicles by description, places, measures, deeds."""

from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Nobody,
    Not,
    Passenger,
    Pronoun,
    Quantity,
    Related,
    Thing,
    Unknown,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.heads import noun, rank_of
from xavi_dialogue.nlu.compose.sem import (
    Group,
    Moment,
    Noun,
    Sem,
    SideOf,
    Specified,
    as_thing,
)
from xavi_dialogue.nlu.compose.traits import Traits, described
from xavi_dialogue.nlu.compose.tree import (
    is_negated,
    leaf_of,
    leaves_of,
    node_of,
    nodes_of,
    number_of,
    words_of,
)
from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_SCALES = {
    "kmh": ("m/s", 1 / 3.6),
    "mph": ("m/s", 0.44704),
    "ms": ("m/s", 1.0),
    "m": ("m", 1.0),
    "km": ("m", 1000.0),
    "mile": ("m", 1609.344),
    "ft": ("m", 0.3048),
    "s": ("s", 1.0),
    "min": ("s", 60.0),
    "h": ("s", 3600.0),
    "percent": ("%", 1.0),
    "times": ("count", 1.0),
}
_RELATIONS = {
    "ahead": "ahead-of",
    "behind": "behind",
    "left": "left-of",
    "right": "right-of",
    "beside": "beside",
    "oncoming": "oncoming-to",
    "around": "near",
    "in-way": "in-the-way-of",
    "here": "near",
    "there": "near",
    "far": "near",
}


class Nouns:
    """Reads noun phrases; clauses inside them are read by `clauses`."""

    def __init__(self, clauses: Any) -> None:
        self.clauses = clauses

    def read(self, node: Node) -> Sem:
        """Read an `np`, a group of them, or what can stand for one."""
        if node.name in ("group", "accusative_group"):
            return self._group(node)
        if node.name == "accusative":
            return self._pronoun(cast(Leaf, node.parts[0]), Traits())
        core = node.parts[0]
        traits = Traits()
        for part in node.parts[1:]:
            self._behind(part, traits)
        if isinstance(core, Leaf):
            return Unknown(core.words[0])
        return self._core(core, traits)

    def _group(self, node: Node) -> Sem:
        join = "or" if leaf_of(node, "OR") else "and"
        rest = self.read(cast(Node, node.parts[-1]))
        cut = next(i for i, p in enumerate(node.parts)
                   if isinstance(p, Leaf) and p.category in ("COMMA", "AND", "OR"))  # fmt: skip
        name = "accusative" if node.name == "accusative_group" else "np"
        first = self.read(Node(name, node.parts[:cut], node.start, node.end, 0.0))
        others = rest.members if isinstance(rest, Group) else (rest,)
        if isinstance(rest, Group):
            join = rest.join
        return Group((first, *others), join)

    def _core(self, core: Node, traits: Traits) -> Sem:
        if core.name == "pronoun":
            named = self._pronoun(cast(Leaf, core.parts[0]), traits)
            cleft = isinstance(named, Ego | Pronoun) and traits.clause is not None
            relative = traits.gerund is not None and traits.gerund.name == "relative"
            if cleft and relative and traits.clause is not None:
                return Specified(cast(Thing, named), traits.clause)
            return named
        if core.name == "anybody":
            return self._anybody(core, traits)
        if core.name == "driven":
            return self.read(cast(Node, core.parts[-1]))
        if core.name == "quantity":
            return self._quantity(core)
        if core.name == "times_clause":
            return Moment("times", rank_of(leaf_of(core, "ORD")))
        if core.name == "sided":
            return SideOf(cast(Leaf, core.parts[-1]).key)
        if core.name == "numbered":
            number = number_of(cast(Node, node_of(core, "num")))
            vehicle = Vehicle(int(number))
            if traits.gerund is not None and traits.gerund.name == "participle":
                return doing(vehicle, traits.event)
            return Specified(vehicle, traits.clause) if traits.clause is not None else vehicle
        head = self._before(core, traits)
        return noun(head, traits)

    def _pronoun(self, leaf: Leaf, traits: Traits) -> Sem:
        if leaf.key == "i":
            return Passenger()
        if leaf.key in ("you", "we"):
            return Ego()
        if traits.gerund is not None and traits.gerund.name == "participle":
            return doing(Pronoun(cast(Any, leaf.key)), traits.event)
        if {"doing", "bearing", "origin"} & traits.fields.keys():
            return described("vehicle", traits, plural=leaf.key == "they")
        return Pronoun(cast(Any, leaf.key))

    def _anybody(self, core: Node, traits: Traits) -> Sem:
        leaf = cast(Leaf, leaf_of(core, "ANY"))
        kind = leaf_of(core, "KIND")
        for part in core.parts[1:]:
            self._modifier(part, traits)
        traits.kind = kind.key if kind else None
        if leaf.key == "everything":
            return Noun("ride", word="everything")
        if leaf.key == "everybody" and {"bearing", "doing", "such"} & traits.fields.keys():
            traits.determiner = "def"  # "the others behind him"
            return described(traits.kind or "vehicle", traits, plural=True)
        if leaf.key == "everybody":
            return Everyone(cast(Any, traits.kind or "vehicle"))
        traits.determiner = "indef"
        found = described(traits.kind or "vehicle", traits)
        if leaf.key == "nobody":
            return Nobody(found if found != Described(definite=False) else None)
        return found

    def _quantity(self, core: Node) -> Sem:
        unit = leaf_of(core, "UNIT") or leaf_of(core, "TUNIT")
        said = node_of(core, "num", "bare_number")
        number = 1.0 if said is None else number_of(said)  # "a kilometre"
        if unit is None:
            return Quantity(number)
        name, scale = _SCALES[unit.key]
        return Quantity(round(number * scale, 6), cast(Any, name))

    # --- what stands before the head ---------------------------------

    def _before(self, core: Node, traits: Traits) -> Leaf | None:
        parts = list(core.parts)
        head = parts[-1] if core.name == "described" else None
        if isinstance(head, Node):  # an unknown word as head
            head = cast(Leaf, head.parts[0])
        for part in parts[: -1 if head is not None else None]:
            self._modifier(part, traits)
        return head

    def _modifier(self, part: Part, traits: Traits) -> None:
        if isinstance(part, Node):
            self._phrase_before(part, traits)
            return
        key = part.key
        match part.category:
            case "DET":
                traits.determiner = traits.determiner if key == "def" and traits.determiner else key
                traits.other |= "other" in part.words or "another" in part.words
            case "POSS":
                traits.determiner = key
                traits.owner = Pronoun("it") if key == "his" else Ego()
            case "OTHER":
                traits.other = True
            case "COLOUR":
                traits.fields["colour"] = key
            case "SIZE":
                traits.fields["size"] = key
            case "ORD":
                traits.following = key == "next"
                traits.ordinal = rank_of(part)
            case "SUPER":
                traits.extreme = key
            case "SIDE":
                traits.side = key
            case "BEARING" | "BEARADJ":
                traits.fields["bearing"] = key
            case "PLACEADV":
                traits.fields.setdefault("bearing", key)
            case "KIND":
                traits.kind = key
            case "EVN":
                traits.deed = key
            case "FROM":
                traits.fields["origin"] = key
            case "ADJ":
                traits.adjectives.append(key)

    def _phrase_before(self, part: Node, traits: Traits) -> None:
        match part.name:
            case "counted":
                traits.fields["number"] = int(number_of(cast(Node, part.parts[0])))
            case "adjective":
                traits.adjectives += [p.key for p in leaves_of(part) if p.category == "ADJ"]
            case "genitive":
                traits.owner = self._owner(cast(Node, part.parts[0]))
            case "unknown":
                traits.unknown.append(words_of(part))
            case "moving":
                traits.fields["doing"] = self.clauses.relative(part, Wanted())
            case "of_all":
                for leaf in leaves_of(part):
                    self._modifier(leaf, traits)

    def _owner(self, node: Node) -> Sem:
        first = node.parts[0]
        if len(node.parts) == 1 and isinstance(first, Leaf) and first.category != "KIND":
            wrapped = Node("pronoun", node.parts, node.start, node.end, 0.0)
            if first.category in ("PRON", "YOU", "WE"):
                return self._pronoun(first, Traits())
            if first.category == "ANY":
                return self._anybody(wrapped, Traits())
        if node_of(node, "num") and leaf_of(node, "NUMBERED"):
            return Vehicle(int(number_of(nodes_of(node, "num")[0])))
        last = node.parts[-1]
        if isinstance(last, Leaf) and last.category == "NUM":
            return Vehicle(int(number_of(node)))
        traits = Traits()
        for part in node.parts[:-1]:
            self._modifier(part, traits)
        if isinstance(last, Node):
            return Vehicle(int(number_of(last)))
        return noun(last, traits)

    # --- what stands behind it ---------------------------------------

    def _behind(self, part: Part, traits: Traits) -> None:
        if isinstance(part, Leaf):
            self._modifier(part, traits)
            return
        match part.name:
            case "of":
                traits.of = self.clauses.inner(part.parts[1])
            case "at_bearing":
                leaf = cast(Leaf, part.parts[0])
                of = as_thing(self.read(cast(Node, part.parts[1])))
                traits.fields["bearing"] = "ahead" if leaf.key == "in-way" else leaf.key
                traits.fields["of"] = None if isinstance(of, (Ego, Passenger)) else of
            case "relative" | "contact" | "participle" | "extent":
                self._clause_behind(part, traits)
            case "attached":
                key = cast(Leaf, part.parts[0]).key
                sem = self.clauses.inner(part.parts[1])
                traits.about.append((key, sem))
                gerund = part.parts[1]
                if isinstance(sem, Event) and isinstance(gerund, Node) and is_negated(gerund):
                    traits.clause = Not(Happens(sem))  # "the reason for not stopping"

    def _clause_behind(self, part: Node, traits: Traits) -> None:
        traits.gerund = part
        found = self.clauses.relative_proposition(part)
        traits.clause = found
        match found:
            case Happens(event=event):
                event = self._placed(event, traits)
                traits.fields["doing"] = event
                traits.event = event
            case Related(relation=relation, thing=Wanted(), to=to):
                bearing = next((b for b, r in _RELATIONS.items() if r == relation), None)
                if bearing is not None:
                    traits.fields["bearing"] = bearing
                    traits.fields["of"] = None if isinstance(to, Ego) else to
            case None:
                pass
            case _:
                traits.fields["such"] = found

    def _placed(self, event: Event, traits: Traits) -> Event:
        """Take the place of "standing on the right" for the place of who stands there."""
        where = event.where
        if where is None or where.thing != Wanted() or not isinstance(where.to, Ego):
            return event
        bearing = next((b for b, r in _RELATIONS.items() if r == where.relation), None)
        if bearing is None or "bearing" in traits.fields:
            return event
        traits.fields["bearing"] = bearing
        fields: dict[str, Any] = {k: getattr(event, k) for k in event.__struct_fields__}
        return Event(**{**fields, "where": None})


def doing(thing: Thing, event: Event | None) -> Sem:
    """Read "vehicle 1 entering our lane" as the event."""
    if event is None:
        return thing
    fields: dict[str, Any] = {k: getattr(event, k) for k in event.__struct_fields__}
    actor = thing if isinstance(event.actor, Wanted) else event.actor
    return Event(**{**fields, "actor": actor})


def relation_of(bearing: str) -> str:
    """Name the relation that a bearing is one side of."""
    return _RELATIONS.get(bearing.split("-")[0], "near")


def quantity_of(value: object) -> Quantity | None:
    """Give a quantity as such."""
    return value if isinstance(value, Quantity) else None
