"""Questions: parsed clauses that ask, with their question words, conditions and contrasts."""

from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import Fault, HowSure, Question, Which, Why
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Happens,
    Pronoun,
    Proposition,
    Quantity,
    That,
    Wanted,
)
from xavi_dialogue.nlu.compose.alternatives.blames import blaming, causes_taken
from xavi_dialogue.nlu.compose.alternatives.options import WEAK, Options, alternatives, several_of
from xavi_dialogue.nlu.compose.alternatives.simulated import simulated
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement, wanted_pronoun
from xavi_dialogue.nlu.compose.clauses.followers import place_subject
from xavi_dialogue.nlu.compose.clauses.nominal import deed_of, event_in, propose
from xavi_dialogue.nlu.compose.clauses.sem import (
    Measure,
    Moment,
    Notes,
    Noun,
    Sem,
    Specified,
    as_thing,
    is_thing,
)
from xavi_dialogue.nlu.compose.clauses.tree import leaf_of, leaves_of, node_of
from xavi_dialogue.nlu.compose.refining.asked import refined
from xavi_dialogue.nlu.compose.refining.consequences import drawn
from xavi_dialogue.nlu.compose.refining.told import refined_whether
from xavi_dialogue.nlu.compose.verbs.trends import believed
from xavi_dialogue.nlu.compose.wh_questions.asking import Asking
from xavi_dialogue.nlu.compose.wh_questions.behind import behind_what, by_whom
from xavi_dialogue.nlu.compose.wh_questions.pointing import pointed
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh, held_then
from xavi_dialogue.nlu.compose.wh_questions.what import going_on, purpose
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_NOMINAL = ("np", "group", "accusative", "accusative_group")
WHOLE = -0.1  # cost of a place that is read as of what is asked for
EMPHATIC = 0.6  # cost of "who did stop"


class Questions(Options):
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
        if kind in ("where", "when"):
            leaf = leaf_of(node, kind.upper())
            besides &= kind == "when"
            return Wh(kind, leaf.key if leaf else "", preposition=key, besides=besides)
        if kind in ("grade", "count"):
            grade = leaf_of(node, "GRADE") or leaf_of(node, "AMOUNT")
            words = grade.words if grade else ()
            sem = self._counted(node) if kind == "count" else None
            return Wh(kind, grade.key if grade else "", words, sem, key)
        if kind == "which":
            asked = self._asked_noun(node)
            words = tuple(w for p in leaves_of(node) for w in p.words)
            if words[1:3] == ("one", "of") and words[3:] in (("them",), ("these",), ("those",)):
                return Wh("which", "", words, None, key, besides, Pronoun("they"))
            spoken = isinstance(asked, Pronoun)
            return Wh("which", "", words, None if spoken else asked, key, besides,
                      asked if spoken else None)  # fmt: skip
        if kind == "whose":
            return Wh("whose", "", (), self._asked_noun(node))
        return Wh(kind, "", (), None, key, besides)

    def _counted(self, node: Node) -> Sem:
        inner = node_of(node, "np", "group", "accusative")
        many = Described(plural=True, definite=False)  # "how many are coming?"
        if inner is not None:
            named = cast(Sem, self.phrases.nouns.read(inner))
            those = several_of(named) if isinstance(named, Pronoun) else None
            return named if those is None else structs.replace(many, among=those)
        amount = leaf_of(node, "AMOUNT")
        alone = amount is not None and amount.key == "many"
        return self._asked_noun(node) or (many if alone else Pronoun("one"))

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
        factor = isinstance(wh.sem, Noun) and wh.sem.key == "factor"
        if wh.kind in ("what", "who", "whose") or factor:
            return Wanted()  # "which constraint limits our speed?": what does
        if wh.kind in ("which", "count") and isinstance(wh.sem, (Measure, Noun, Moment, Quantity)):
            return wh.sem
        kind = wh.sem.kind if isinstance(wh.sem, Described) else "vehicle"
        return Wanted(kind) if wh.kind in ("which", "count") else None

    # --- clauses that ask --------------------------------------------

    def embedded(self, node: Node, outer: Clause) -> tuple[Wh | None, list[Question]]:
        """Read "why you stopped" behind "tell me" or "I wonder"."""
        whs = [p for p in node.parts if isinstance(p, Node) and p.name.startswith("wh_")]
        also = node_of(node, "also_wh")
        inner = [p for p in node.parts if isinstance(p, Node) and p not in (*whs, also)]
        if not whs:
            clause = self.phrases.clause(inner[0]) if inner else Clause()
            return None, [refined_whether(clause, q) for q, _ in self.whether(clause)]
        wh = self.wh_of(whs[0])
        if not inner:
            return wh, []
        clause = self.phrases.slots.fill((), Clause())
        found = self.asked(wh, inner, clause)
        if also is not None and inner:
            more = self.asked(self.wh_of(cast(Node, also.parts[-1])), inner, Clause())
            outer.also += [question for question, _ in more[:1]]
        return wh, [q for q, _ in found]

    def asked(self, wh: Wh, parts: list[Any], clause: Clause) -> list[tuple[Question, float]]:
        """Fill a clause that a question word asks of, and build its questions."""
        clause.gap = self.gap_of(wh)
        self.phrases.slots.fill(tuple(parts), clause)
        if (meant := drawn(wh, clause)) is not None:
            return [(meant, 0.0)]
        by_whom(clause)
        if (held := behind_what(clause)) is not None:
            return [(self.asking.ask(wh, *held), WHOLE)]
        plain = self.propositions.plain
        causes = causes_taken(clause, self.notes) if wh.kind == "why" else ()
        found = [(refined(wh, clause, q, plain), cost) for q, cost in self.of(wh, clause)]
        return [(blaming(question, causes), cost) for question, cost in found]

    def of(self, wh: Wh, clause: Clause) -> list[tuple[Question, float]]:
        """Build the questions that a question word asks of a clause."""
        wh, clause = cleft(wh, clause)
        does = wh.kind == "what" and clause.verb is not None and clause.verb.key == "do"
        if does or wh.kind in ("where", "grade", "who"):
            place_subject(clause)
        if (most := pointed(wh, clause)) is not None:
            return [(most, 0.0)]
        if does:
            # "what is he doing, braking like that?"
            clause.objects = [o for o in clause.objects if not isinstance(o[0], Event)]
        for_what = wh.preposition == "for" and isinstance(clause.subject, Event)
        if wh.kind == "what" and (for_what or purpose(clause)):
            wh = Wh("why")
            if (why := _what_for(clause)) is not None:
                return [(why, 0.0)]
        emphatic = 0.0
        if clause.subject is None and not clause.there and clause.gap is not None:
            clause.subject, clause.gap = clause.gap, None
            emphatic = EMPHATIC if clause.has("do") else 0.0
            if wh.kind == "which" and wh.sem is None and _is_base(clause):
                emphatic += WEAK  # "which exit"
        if clause.subject is None and wh.kind in ("which", "count"):
            clause.subject = wh.sem if is_thing(wh.sem) or wh.kind == "count" else None
        if wh.kind == "what" and isinstance(clause.subject, Measure) and _says_what(clause):
            return []  # "what colour was the car" is no "what" of a colour that was a car
        options = alternatives(clause) if wh.kind in ("who", "what", "which") else None
        held = clause.subject.of if isinstance(clause.subject, Measure) else None
        chance = held is not None and held.attribute == "probability"
        if wh.kind == "grade" and (wh.key == "likely" or chance):
            content = self._believed(clause) or (believed(held) if held and chance else None)
            if content is not None:
                return [(HowSure(held_then(clause, content), clause.time), 0.0)]
        if wh.kind == "grade" and (graded := self._graded(wh, clause)) is not None:
            return [(graded, 0.0)]
        if wh.preposition and clause.gap is None and wh.kind in ("what", "who", "which"):
            clause.gap = Wanted()
            if wh.preposition == "for":  # "for whom did you stop?"
                stranded = Node("stranded", (), 0, 0, 0.0)
                clause.complements.append(Complement("for", None, stranded))
        nominal = (
            self.mattering(wh, clause, options)
            or self.effect(wh, clause)
            or self._nominal(wh, clause)
        )
        if nominal is not None:
            return [(self.framed(nominal, clause, None), 0.0)]
        if options is not None:
            return [self.one_of(wh, clause, options)]
        candidates = self.propositions.readings(clause)
        pairs: list[tuple[Any, float]] = [(c.value, c.cost) for c in candidates] or [(None, 0.0)]
        found = []
        for value, cost in pairs:
            compared = simulated(wh, clause, value) or self.compared(wh, clause, value)
            question = compared or _among(wh, self.asking.ask(wh, clause, value))
            lost = compared is None and _is_lost(wh, clause, value, question)
            extra = emphatic + WEAK * lost
            found.append((self.framed(question, clause, value), cost + extra))
        return found

    def _graded(self, wh: Wh, clause: Clause) -> Question | None:
        """Ask how much something hangs on another, or how much better or worse it is."""
        judged = wh.key == "worse" or (wh.key == "faster" and clause.than is not None)
        weighed = self.margin(wh, clause) or self.needing(clause)
        return weighed or (self.weighed(wh, clause) if judged else None)

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
            return HowSure(held_then(clause, content), clause.time)
        return None

    def _believed(self, clause: Clause) -> Proposition | None:
        """Find what it is that "how sure" is asked of."""
        if clause.verb is not None or wanted_only(clause):
            return None
        governed = clause.that or clause.infinitive or clause.gerund
        if governed is not None:
            governed.subject = governed.subject or Ego()
            weighed = self.weighed_deed(governed)
            return weighed or cast("Proposition | None", self.propositions.plain(governed))
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


def _among(wh: Wh, question: Question) -> Question:
    """Keep of whom one is asked for: "which of them will turn"."""
    those = several_of(wh.of)
    if not isinstance(question, Which) or question.among or those is None:
        return question
    return structs.replace(question, among=(those,))


def _is_lost(wh: Wh, clause: Clause, value: Any, question: Question) -> bool:
    """Say whether a question leaves out what the clause is of."""
    why = wh.kind == "why" and clause.subject is not None
    governing = wh.kind in ("what", "who") and clause.that is not None
    governed = clause.that or clause.infinitive or clause.gerund
    unsure = question == HowSure(None, clause.time) and (
        governed is not None or isinstance(clause.subject, Specified)
    )
    return unsure or (value is None and (why or governing))


def _what_for(clause: Clause) -> Why | None:
    """Read "what was that stop for", "what is all that braking about"; None: ask of the verb."""
    clause.gap = None
    if going_on(clause):
        clause.subject = Ego()
    clause.particles = [leaf for leaf in clause.particles if leaf.key != "around"]
    clause.complements = [c for c in clause.complements if c.sem is not None]
    subject = deed_of(clause.subject) or clause.subject
    named = clause.verb is None and isinstance(subject, Event | Pronoun)
    return Why(propose(subject) or That()) if named else None


def _says_what(clause: Clause) -> bool:
    """Say whether a subject is said to be some thing."""
    return clause.verb is None and any(is_thing(sem) for sem, _ in clause.objects)


def wanted_only(clause: Clause) -> bool:
    """Say whether nothing is there that a belief could be of."""
    return not (clause.that or clause.infinitive or clause.gerund or clause.complements)


def _is_base(clause: Clause) -> bool:
    return clause.verb is not None and clause.verb.form == "base" and not clause.aux


def _whose_turn(sem: Sem | None) -> Question | None:
    """Ask "whose turn is it": who goes first."""
    if not isinstance(sem, Event) or sem.action != "turn" or sem.side is not None:
        return None
    going = Event("go", Wanted(), manner=("first",), tense="present", modal="should")
    return Which(Wanted(), Happens(going))


def cleft(wh: Wh, clause: Clause) -> tuple[Wh, Clause]:
    """Read "when was it that he braked" as "when did he brake"."""
    empty = wanted_pronoun(clause.subject) and clause.verb is None and clause.question is None
    told = clause.that
    if told is None or not empty or wh.kind not in _CLEFT or clause.adjectives or clause.objects:
        return wh, clause
    return Wh("why") if wh.kind == "how" else wh, told  # "how is it that he braked?"


_CLEFT = frozenset({"when", "where", "why", "how"})
