"""Questions: parsed clauses that ask, with their question words, conditions and contrasts."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Compare,
    Fault,
    HowSure,
    Question,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Happens,
    Next,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    That,
    Wanted,
)
from xavi_dialogue.nlu.compose.adoption import with_fields
from xavi_dialogue.nlu.compose.asking import Asking
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.comparing import BY
from xavi_dialogue.nlu.compose.effects import Effects
from xavi_dialogue.nlu.compose.nominal import event_in, propose
from xavi_dialogue.nlu.compose.peaks import peak_of
from xavi_dialogue.nlu.compose.sem import (
    Group,
    Measure,
    Moment,
    Notes,
    Noun,
    Sem,
    as_thing,
    is_thing,
)
from xavi_dialogue.nlu.compose.tree import leaf_of, leaves_of, node_of
from xavi_dialogue.nlu.compose.wh import Wh, fact
from xavi_dialogue.nlu.compose.what import purpose
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_YIELDS = frozenset({"give-way", "let-go", "wait"})
_NOMINAL = ("np", "group", "accusative", "accusative_group")
EMPHATIC = 0.6  # cost of "who did stop"
WEAK = 1.0  # cost of a clause of which nothing is said


#: What tells nobody apart: "a man", "somebody".
_SORTS = (Described(definite=False), Described(kind="pedestrian", definite=False))


class Questions(Effects):
    """Builds questions from parses."""

    def __init__(self, notes: Notes) -> None:
        self.notes = notes
        self.asking = Asking()
        self.phrases: Any = None  # set by the composer
        self.propositions: Any = None

    # --- question words ----------------------------------------------

    def wh_of(self, node: Node) -> Wh:
        """Read a question word and what stands with it."""
        kind = node.name.removeprefix("wh_")
        preposition = leaf_of(node, "P")
        key = preposition.key if preposition else ""
        besides = leaf_of(node, "ELSE") is not None
        if kind == "where":
            where = leaf_of(node, "WHERE")
            return Wh("where", where.key if where else "", preposition=key)
        if kind == "when":
            moment = leaf_of(node, "WHEN")
            return Wh("when", moment.key if moment else "", preposition=key, besides=besides)
        if kind in ("grade", "count"):
            grade = leaf_of(node, "GRADE") or leaf_of(node, "AMOUNT")
            words = grade.words if grade else ()
            sem = self._counted(node) if kind == "count" else None
            return Wh(kind, grade.key if grade else "", words, sem, key)
        if kind == "which":
            asked = self._asked_noun(node)
            words = tuple(w for p in leaves_of(node) for w in p.words)
            return Wh("which", "", words, None if isinstance(asked, Pronoun) else asked, key,
                      besides)  # fmt: skip
        if kind == "whose":
            return Wh("whose", "", (), self._asked_noun(node))
        return Wh(kind, "", (), None, key, besides)

    def _counted(self, node: Node) -> Sem:
        inner = node_of(node, "np", "group")
        if inner is not None:
            return cast(Sem, self.phrases.nouns.read(inner))
        return self._asked_noun(node) or Pronoun("one")

    def _asked_noun(self, node: Node) -> Sem | None:
        inner = node_of(node, "of")
        parts = tuple(
            p
            for p in node.parts
            if not (
                isinstance(p, Leaf)
                and p.category
                in ("WHAT", "WHICH", "WHOSE", "P", "HOW", "GRADE", "AMOUNT", "ELSE", "OF")
            )
        )
        posts = tuple(
            p
            for p in parts
            if (isinstance(p, Node) and p.name in ("of", "at_bearing"))
            or (isinstance(p, Leaf) and p.category == "BEARING" and p is parts[-1])
        )
        core = tuple(p for p in parts if p not in posts)
        if core and isinstance(core[0], Node) and core[0].name in ("np", "group", "accusative"):
            return cast(Sem, self.phrases.nouns.read(core[0]))
        if not core:
            return None if inner is None else cast(Sem, self.phrases.inner(inner.parts[1]))
        wrapped = Node("described", core, node.start, node.end, 0.0)
        return cast(Sem, self.phrases.nouns.read(
            Node("np", (wrapped, *posts), node.start, node.end, 0.0)))  # fmt: skip

    def gap_of(self, wh: Wh) -> Sem | None:
        """Give what a question word leaves open in its clause."""
        if wh.kind in ("what", "who", "whose"):
            return Wanted()
        if wh.kind in ("which", "count") and isinstance(wh.sem, (Measure, Noun, Moment, Quantity)):
            return wh.sem
        if wh.kind in ("which", "count"):
            kind = wh.sem.kind if isinstance(wh.sem, Described) else "vehicle"
            return Wanted(kind)
        return None

    # --- clauses that ask --------------------------------------------

    def embedded(self, node: Node, outer: Clause) -> tuple[Wh | None, list[Question]]:
        """Read "why you stopped" behind "tell me" or "I wonder"."""
        whs = [p for p in node.parts if isinstance(p, Node) and p.name.startswith("wh_")]
        inner = [p for p in node.parts if isinstance(p, Node) and p not in whs]
        if not whs:
            clause = self.phrases.clause(inner[0]) if inner else Clause()
            return None, [q for q, _ in self.whether(clause)]
        wh = self.wh_of(whs[0])
        if not inner:
            return wh, []
        clause = self.phrases.slots.fill((), Clause())
        found = self.asked(wh, inner, clause)
        return wh, [q for q, _ in found]

    def asked(self, wh: Wh, parts: list[Any], clause: Clause) -> list[tuple[Question, float]]:
        """Fill a clause that a question word asks of, and build its questions."""
        clause.gap = self.gap_of(wh)
        self.phrases.slots.fill(tuple(parts), clause)
        return self.of(wh, clause)

    def of(self, wh: Wh, clause: Clause) -> list[tuple[Question, float]]:
        """Build the questions that a question word asks of a clause."""
        most = peak_of(clause)
        if most is not None and wh.kind in ("where", "when", "what", "who", "which", "count"):
            return [(most, 0.0)]
        for_what = wh.preposition == "for" and isinstance(clause.subject, Event)
        if wh.kind == "what" and (for_what or purpose(clause)):
            clause.gap, wh = None, Wh("why")
            clause.complements = [c for c in clause.complements if c.sem is not None]
            if clause.verb is None and isinstance(clause.subject, (Event, Pronoun)):
                return [(Why(propose(clause.subject) or That()), 0.0)]
        emphatic = 0.0
        if clause.subject is None and not clause.there and clause.gap is not None:
            clause.subject, clause.gap = clause.gap, None
            emphatic = EMPHATIC if clause.has("do") else 0.0
            if wh.kind == "which" and wh.sem is None and _is_base(clause):
                emphatic += WEAK  # "which exit"
        if clause.subject is None and wh.kind in ("which", "count"):
            clause.subject = wh.sem if is_thing(wh.sem) or wh.kind == "count" else None
        options = _alternatives(clause) if wh.kind in ("who", "what", "which") else None
        if options is not None and all(option in _SORTS for option in options):
            options = None  # "a man or a lady?"
        if wh.kind == "grade" and wh.key == "likely":
            content = self._believed(clause)
            if content is not None:
                return [(HowSure(content, clause.time), 0.0)]
        if wh.preposition and clause.gap is None and wh.kind in ("what", "who", "which"):
            clause.gap = Wanted()
        nominal = self.effect(wh, clause) or self._nominal(wh, clause)
        if nominal is not None:
            return [(self.framed(nominal, clause, None), 0.0)]
        first = None if options is None else self._first_of(wh, clause, options)
        if first is not None:
            return [(first, 0.1)]
        if options is not None:
            by = "time" if "first" in clause.manner else "best"
            if clause.comparisons:
                by = BY.get(clause.comparisons[0][0], "best")
                if by == "time" and all(is_thing(option) for option in options):
                    by = "speed"
            things = by == "best" and all(is_thing(option) for option in options)
            return [(Compare(options, cast(Any, by)), 0.1 + WEAK * things)]
        candidates = self.propositions.readings(clause)
        pairs: list[tuple[Any, float]] = [(c.value, c.cost) for c in candidates] or [(None, 0.0)]
        found: list[tuple[Question, float]] = []
        for value, cost in pairs:
            compared = self._compared(wh, clause, value)
            question = compared or self.asking.ask(wh, clause, value)
            why = wh.kind == "why" and clause.subject is not None
            governing = wh.kind in ("what", "who") and clause.that is not None
            extra = WEAK if value is None and (why or governing) else 0.0
            found.append((self.framed(question, clause, value), cost + extra + emphatic))
        return found

    def _nominal(self, wh: Wh, clause: Clause) -> Question | None:
        """Ask "what are the chances that he stops", "whose fault is it"."""
        if wh.kind == "whose" and isinstance(wh.sem, Measure):
            lit: Any = "signal" if wh.sem.of.attribute == "indicator" else "brake"
            if wh.sem.of.attribute in ("indicator", "brake-lights"):
                return Which(Wanted(), Happens(Event(lit, Wanted(), tense="present")))
        if wh.kind == "whose":
            fault = isinstance(wh.sem, Noun) and wh.sem.key == "fault"
            return Fault() if fault else _whose_turn(wh.sem)
        if wh.kind != "what" or clause.verb is not None:
            return None
        named = clause.objects[0][0] if clause.objects else clause.subject
        if not isinstance(named, (Measure, Noun)):
            return None
        if clause.that is not None and (
            isinstance(named, Noun) or named.of.attribute == "probability"
        ):
            content = self.propositions.plain(clause.that)
            if isinstance(named, Noun) and named.key in ("reason", "factor"):
                return Why(content or That())
            return HowSure(content, clause.time)
        return None

    def _believed(self, clause: Clause) -> Proposition | None:
        """Find what it is that "how sure" is asked of."""
        if clause.verb is not None or wanted_only(clause):
            return None
        governed = clause.that or clause.infinitive or clause.gerund
        if governed is not None:
            governed.subject = governed.subject or Ego()
            return cast("Proposition | None", self.propositions.plain(governed))
        for phrase in clause.complements:
            sem = phrase.sem
            if isinstance(sem, Noun):
                sem = sem.about or sem.of
            event = event_in(sem)
            if event is not None:
                return Happens(event)
            thing = as_thing(sem)
            if (
                thing is not None
                and not isinstance(thing, Pronoun)
                and phrase.key in ("for", "about", "in")
            ):
                return Happens(Event("do", thing))
        return None

    def _first_of(self, wh: Wh, clause: Clause, options: tuple[Any, ...]) -> Question | None:
        """Ask "who goes first, we or the bus": who of them has to let the other go."""
        other = next((one for one in options if not isinstance(one, Ego)), None)
        bare = clause.verb is None and not (clause.comparisons or clause.adjectives)
        if isinstance(clause.time, Next) and bare:
            going = Event("go", Wanted(), other, None, ("first",), tense="present", modal="should")
            return Which(Wanted(), Happens(going))
        found = self.propositions.readings(clause)
        said = fact(found[0].value) if found and clause.verb is not None else None
        others = all(is_thing(one) and not isinstance(one, Ego) for one in options)
        if others and said is not None and not clause.comparisons:
            return Which(Wanted(), said, options)
        match fact(found[0].value) if found else None:
            case Related(relation="has-priority-over" | "must-yield-to") as related:
                return Which(Wanted(), with_fields(related, to=other))
            case Happens(event=event) if event.action in _YIELDS or "first" in event.manner:
                return Which(Wanted(), Happens(with_fields(event, object=other)))
        if wh.kind == "who" and Ego() in options and other is not None and not clause.comparisons:
            going = Event("go", Wanted(), other, None, ("first",), tense="present", modal="should")
            return Which(Wanted(), Happens(going))
        return None

    def _compared(self, wh: Wh, clause: Clause, value: Any) -> Question | None:
        """Ask "which is faster, left or right"."""
        if wh.kind not in ("which", "what", "who") or not clause.comparisons:
            return None
        deeds = self.deeds(clause)
        if deeds:
            return Compare(deeds, cast(Any, BY.get(clause.comparisons[0][0], "best")))
        options = [sem for sem, _ in clause.objects if isinstance(sem, Group)]
        if options:
            return Compare(tuple(_option(s) for s in options[0].members),
                           cast(Any, BY.get(clause.comparisons[0][0], "best")))  # fmt: skip
        among = [wh.sem, *(c.sem for c in clause.complements if c.key == "of")]
        spoken = any(isinstance(s, Pronoun) and s.form in ("they", "them-all") for s in among)
        if spoken or {"them", "those", "these", "both"} & set(wh.words):
            by = {"fast": "speed", "slow": "speed"}.get(clause.comparisons[0][0])
            other = BY.get(clause.comparisons[0][0], "best")
            return Compare((Pronoun("them-all"),), cast(Any, by or other))
        return None

    # --- what stands around a question -------------------------------


def wanted_only(clause: Clause) -> bool:
    """Say whether nothing is there that a belief could be of."""
    return not (clause.that or clause.infinitive or clause.gerund or clause.complements)


def _is_base(clause: Clause) -> bool:
    return clause.verb is not None and clause.verb.form == "base" and not clause.aux


def _alternatives(clause: Clause) -> tuple[Any, ...] | None:
    """Take "we or the blue one" out of a clause that asks which of them."""
    for index, (sem, _) in enumerate(clause.objects):
        if isinstance(sem, Group) and sem.join == "or":
            del clause.objects[index]
            return tuple(_option(member) for member in sem.members)
    for index, (join, other) in enumerate(clause.chained):
        if join == "or" and clause.objects and _is_option(other):
            del clause.chained[index]
            first, _ = clause.objects.pop()
            return _option(first), _option(other.objects[0][0])
    return None


def _is_option(other: Clause) -> bool:
    """Say whether nothing stands behind "or" but a thing."""
    more = (other.complements, other.adjectives, other.bearings, other.manner, other.particles)
    return len(other.objects) == 1 and is_thing(other.objects[0][0]) and not any(more)


def _whose_turn(sem: Sem | None) -> Question | None:
    """Ask "whose turn is it": who goes first."""
    if not isinstance(sem, Event) or sem.action != "turn" or sem.side is not None:
        return None
    going = Event("go", Wanted(), manner=("first",), tense="present", modal="should")
    return Which(Wanted(), Happens(going))


def _option(sem: Sem) -> Any:
    if isinstance(sem, Event):
        return Happens(sem)
    return as_thing(sem) or Pronoun("that")
