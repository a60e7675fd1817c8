"""Things: noun phrases become vehicles by description, places, measures, deeds."""

from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Nobody,
    Passenger,
    Pronoun,
    Quantity,
    Thing,
    Unknown,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.adoption import CROSSINGS, also_named
from xavi_dialogue.nlu.compose.clauses.followers import Followers, doing
from xavi_dialogue.nlu.compose.clauses.sem import (
    NONE_OF_THEM,
    Group,
    Moment,
    Noun,
    Sem,
    SideOf,
    Specified,
    as_thing,
)
from xavi_dialogue.nlu.compose.clauses.traits import Traits, described
from xavi_dialogue.nlu.compose.clauses.tree import (
    leaf_of,
    leaves_of,
    node_of,
    nodes_of,
    number_of,
    words_of,
)
from xavi_dialogue.nlu.compose.propositions.heads import noun, rank_of
from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_CROSSING = frozenset({"cross", "pass", "overtake", "let-go", "come", "see"})
_AMISS = frozenset({"dangerous", "wrong", "uncomfortable"})  # of what happens
_SCALES = {
    "kmh": ("m/s", 1 / 3.6),
    "mph": ("m/s", 0.44704),
    "ms": ("m/s", 1.0),
    "ms2": ("m/s2", 1.0),
    "m": ("m", 1.0),
    "km": ("m", 1000.0),
    "mile": ("m", 1609.344),
    "ft": ("m", 0.3048),
    "s": ("s", 1.0),
    "min": ("s", 60.0),
    "h": ("s", 3600.0),
    "percent": ("%", 1.0),
    "half": ("%", 50.0),
    "third": ("%", 33.3),
    "quarter": ("%", 25.0),
    "times": ("count", 1.0),
}


class Nouns(Followers):
    """Reads noun phrases; clauses inside them are read by `clauses`."""

    def read(self, node: Node) -> Sem:
        """Read an `np`, a group of them, or what can stand for one."""
        if node.name in ("group", "accusative_group", "choice"):
            return self._group(node)
        if node.name == "aliased":  # "v16, the red one on the right, ..."
            cut = next(i for i, p in enumerate(node.parts) if _is_comma(p))
            first = Node("np", node.parts[:cut], node.start, node.end, 0.0)
            named = cast(Node, node_of(node, "named")).parts[0]
            return also_named(self.read(first), self.read(cast(Node, named)))
        if node.name in ("roll", "neither_nor"):  # "1, 3 and 5", "neither 1 nor the bus"
            listed = [p for p in node.parts if isinstance(p, Node)]
            join = "or" if node.name == "neither_nor" or leaf_of(node, "OR") else "and"
            return Group(tuple(self._listed(part) for part in listed), join)
        if node.name == "accusative":
            return self._pronoun(cast(Leaf, node.parts[0]), Traits())
        core = node.parts[0]
        traits = Traits()
        traits.reason = isinstance(core, Node) and _is_reason(core)
        for part in node.parts[1:]:
            self.follow(part, traits)
        if isinstance(core, Leaf):
            return Unknown(core.words[0])
        found = self._core(core, traits)
        return Group((found, *traits.beside)) if traits.beside else found

    def _listed(self, part: Node) -> Sem:
        """Read one of several that are listed; a mere number is that of a vehicle."""
        return Vehicle(int(number_of(part))) if part.name == "num" else self.read(part)

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
            leaf = cast(Leaf, core.parts[0])
            named = self._pronoun(leaf, Traits() if leaf.category == "OBJPRON" else traits)
            cleft = isinstance(named, Ego | Pronoun) and traits.clause is not None
            relative = traits.gerund is not None and traits.gerund.name == "relative"
            if cleft and relative and traits.clause is not None:
                return Specified(cast(Thing, named), traits.clause)
            return named
        if core.name == "anybody":
            return self._anybody(core, traits)
        if core.name == "driven":
            return _at_place(self.read(cast(Node, core.parts[-1])), core, traits)
        if core.name == "quantity":
            amount = self._quantity(core)
            if isinstance(amount, Quantity) and amount.unit == "count" and traits.clause:
                traits.fields["number"] = int(amount.value)  # "four we had to wait for"
                return described("vehicle", traits, plural=True)
            return amount
        if core.name == "times_clause":
            rank = rank_of(leaf_of(core, "ORD"))
            if isinstance(traits.clause, Happens):  # "the second time we stopped"
                return Noun("time", word="time", clause=traits.clause, number=rank)
            return Moment("times", rank)
        if core.name == "sided":
            return SideOf(cast(Leaf, core.parts[-1]).key)
        if core.name == "numbered":
            number = number_of(cast(Node, node_of(core, "num")))
            if (article := leaf_of(core, "DET")) is not None and article.key == "indef":
                return Unknown(words_of(core))  # "a truck two seconds ago"
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
            self.modify(part, traits)
        traits.kind = kind.key if kind else None
        deed = traits.fields.get("doing")
        if leaf.key == "everything" and isinstance(deed, Event) and deed.action in _CROSSING:
            traits.determiner = "def"  # "everything that crossed in front of us"
            return described("vehicle", traits, plural=True)
        if leaf.key == "everything":
            told = Happens(deed) if isinstance(deed, Event) and deed.action == "happen" else None
            return Noun("ride", word="everything", clause=told)
        if leaf.key == "everybody" and {"bearing", "doing", "such"} & traits.fields.keys():
            traits.determiner = "def"  # "the others behind him"
            return described(traits.kind or "vehicle", traits, plural=True)
        if leaf.key == "everybody":
            return Everyone(cast(Any, traits.kind or "vehicle"))
        if leaf.key == "neither":
            return NONE_OF_THEM
        traits.determiner = "indef"
        if leaf.key in ("somebody", "nobody"):
            words = {word for part in leaves_of(core) for word in part.words}
            traits.other |= bool({"else", "another"} & words)
        quality = leaf_of(core, "ADJ")
        if quality is not None and quality.key in _AMISS:
            traits.fields["such"] = Is(cast(Any, quality.key), Wanted())
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
            self.modify(part, traits)
        return head

    def modify(self, part: Part, traits: Traits) -> None:
        """Note what stands before the head."""
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
            case "PLACEN":
                traits.place = as_thing(noun(part, Traits()))
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
            case "compared":  # "the slower of the two"
                leaf = cast(Leaf, part.parts[0])
                traits.extreme = _MOST.get(leaf.key, traits.extreme)
            case "of_all":
                for leaf in leaves_of(part):
                    self.modify(leaf, traits)
                    traits.one_of |= leaf.category in ("ORD", "SUPER")

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
            self.modify(part, traits)
        if isinstance(last, Node):
            return Vehicle(int(number_of(last)))
        return noun(last, traits)


#: Which of two a comparative names.
_MOST = {"fast": "fastest", "slow": "slowest", "close": "nearest", "far": "farthest",
         "big": "biggest", "small": "smallest"}  # fmt: skip


def _at_place(where: Sem, core: Node, traits: Traits) -> Sem:
    """Take "the man in the red car" for the car, "the man on the left" for somebody there."""
    if isinstance(where, Noun) and where.key == "front":
        traits.fields["bearing"] = "ahead"  # "the guy in front"
        return described("vehicle", traits)
    if isinstance(where, Vehicle | Described | Pronoun | Specified | Group):
        return where
    if isinstance(where, SideOf) and where.side in ("left", "right"):
        traits.fields.setdefault("bearing", where.side)
    last = words_of(core).split()[-1]
    walks = last in CROSSINGS or "person" in words_of(core).split()  # "the lady at the crossing"
    return described("pedestrian" if walks else "vehicle", traits, plural=last == "people")


def _is_reason(core: Node) -> bool:
    """Say whether a noun phrase has a word for a reason at its head."""
    head = core.parts[-1] if core.parts else None
    return isinstance(head, Leaf) and (head.category, head.key) == ("ABS", "reason")


def _is_comma(part: Part) -> bool:
    """Say whether a part is a comma."""
    return isinstance(part, Leaf) and part.category == "COMMA"
