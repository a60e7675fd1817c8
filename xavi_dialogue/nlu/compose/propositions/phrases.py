"""Phrases of a clause: what each does to the slots."""

from dataclasses import replace
from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Ago,
    AtDecision,
    Ego,
    Event,
    Pronoun,
    Proposition,
    Quantity,
    Unsaid,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.clause import (
    Clause,
    Complement,
    Slots,
    is_share,
    takes_name,
)
from xavi_dialogue.nlu.compose.clauses.sem import Group, Notes, Sem, SideOf, is_named
from xavi_dialogue.nlu.compose.clauses.times import PAST, time_within
from xavi_dialogue.nlu.compose.clauses.tree import leaf_of, leaves_of, node_of, number_of, words_of
from xavi_dialogue.nlu.compose.propositions.adjuncts import CLAUSES, Adjuncts
from xavi_dialogue.nlu.compose.propositions.tally import frequency
from xavi_dialogue.nlu.compose.propositions.things import Nouns
from xavi_dialogue.nlu.compose.states.positions import place_of
from xavi_dialogue.nlu.compose.verbs.causing import let_apart
from xavi_dialogue.nlu.compose.verbs.lights import on_light
from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

EARLIER = 5.0  # [s] that "than before" reaches back
_SEEMING = frozenset({"feel", "look", "seem", "sound", "appear"})

_COMPARING = frozenset({"comparison", "than"})
_REFLEXIVE = frozenset({"itself", "himself", "herself", "themselves"})


class Phrases(Adjuncts):
    """Reads the phrases of a clause; knows of noun phrases and of the clauses inside."""

    def __init__(self, propositions: Any, questions: Any, notes: Notes) -> None:
        self.propositions = propositions
        self.questions = questions
        self.notes = notes
        self.nouns = Nouns(self)
        self.slots = Slots(self)

    # --- used by noun phrases ----------------------------------------

    def inner(self, part: Part) -> Sem:
        """Read what stands behind a preposition: a noun phrase or a gerund."""
        if isinstance(part, Node) and part.name in CLAUSES:
            return cast(Sem, self.propositions.as_deed(self.clause(part)))
        return self.nouns.read(cast(Node, part))

    def relative_clause(self, node: Node) -> Clause:
        """Fill the slots of a relative clause; its gap is wanted."""
        clause = Clause(gap=Wanted())
        if node.name == "participle" or node_of(node, "subject") is None:
            named = any(
                isinstance(p, Leaf) and p.category in ("I", "YOU", "WE", "PRON") for p in node.parts
            )
            if not named:
                clause.subject, clause.gap = Wanted(), None
        return self.slots.fill(node.parts, clause)

    def relative_proposition(self, node: Node) -> Proposition | None:
        """Compose a relative clause; what it is about is `Wanted` in it."""
        return cast("Proposition | None", self.propositions.plain(self.relative_clause(node)))

    def relative(self, node: Node, subject: Wanted) -> Any:
        """Compose a participle before a noun: "the waiting car"."""
        clause = self.slots.fill(node.parts, Clause(subject=subject))
        found = self.propositions.plain(clause)
        return getattr(found, "event", None)

    def noun_clause(self, node: Node) -> Proposition | None:
        """Compose the clause that belongs to an abstract noun: "the reason you stopped"."""
        clause = self.slots.fill(node.parts, Clause())
        return cast("Proposition | None", self.propositions.plain(clause))

    # --- clauses -----------------------------------------------------

    def clause(self, node: Node, outer: Clause | None = None) -> Clause:
        """Fill the slots of an embedded clause; a missing subject is that of the outer one."""
        clause = self.slots.fill(node.parts)
        if clause.subject is None and not clause.there and outer is not None:
            clause.subject = outer.subject
        return clause

    def _on_placed_first(self, node: Node, clause: Clause) -> None:
        self.slots.fill(node.parts, clause)
        clause.there = True  # "in front is a big brown truck"

    def _on_subject(self, node: Node, clause: Clause) -> None:
        inner = node.parts[0]
        if isinstance(inner, Leaf):
            clause.there = True
        elif inner.name == "side_subject":
            side = cast(Leaf, inner.parts[0]).key
            clause.subject = Event(cast(Any, f"exit-{side}"), tense="present")
        elif inner.name == "decision":  # what it does, we do then
            clause.subject = Ego()
            clause.time = AtDecision(int(number_of(cast(Node, node_of(inner, "num")))))
        elif inner.name == "neither_nor":
            clause.subject, clause.negated = self.nouns.read(inner), True
        elif inner.name == "dative":
            clause.subject = self.nouns.read(cast(Node, inner.parts[0]))
        elif inner.name == "gerund":
            last = inner.parts[-1]
            if isinstance(last, Node) and last.name in _COMPARING and len(inner.parts) > 1:
                inner = Node("gerund", inner.parts[:-1], inner.start, inner.end, inner.cost)
                handle = self._on_than if last.name == "than" else self._on_comparison
                handle(last, clause)  # "was stopping better than turning"
            clause.subject = self.inner(inner)
        else:
            clause.subject = self.nouns.read(inner)
            clause.the_car = words_of(inner) in ("the car", "the vehicle", "this car")
        if clause.topic is not None and takes_name(clause):
            clause.subject, clause.topic = clause.topic, None

    def _on_vp(self, node: Node, clause: Clause) -> None:
        self.slots.fill(node.parts, clause)

    _on_copular = _on_state = _on_verbless = _on_vp
    _on_short_gerund = _on_vp
    _on_vp_odd = _on_vp
    _on_hads = _on_finite = _on_finite_short = _on_vp
    _on_inverted = _on_vp
    _on_pre_to = _on_vp
    _on_late_not = _on_vp
    _on_aside = _on_vp
    _on_asked_whether = _on_vp

    def _on_unknown_verb(self, node: Node, clause: Clause) -> None:
        clause.verb = cast(Leaf, node.parts[0])

    def _on_object(self, node: Node, clause: Clause) -> None:
        if clause.verb is not None and words_of(node) in _REFLEXIVE:
            return  # "it has tucked itself in"
        *before, whole = let_apart(cast(Node, node.parts[0]), clause)
        clause.objects += [(self.nouns.read(who), node) for who in before]
        named, node = self.nouns.read(whole), Node("object", (whole,), node.start, node.end, 0.0)
        if clause.comma == node.start and is_named(named) and takes_name(clause):
            clause.subject = named  # "is it fast, that bus?"
            return
        clause.objects.append((named, node))

    def _on_comma(self, node: Node, clause: Clause) -> None:
        clause.comma = node.end

    def _on_frequency(self, node: Node, clause: Clause) -> None:
        frequency(node, clause)

    def _on_lone_number(self, node: Node, clause: Clause) -> None:
        clause.objects.append((Quantity(number_of(node)), node))

    def _on_pp(self, node: Node, clause: Clause) -> None:
        leaf = cast(Leaf, node.parts[0])
        last = node.parts[1]
        if isinstance(last, Node) and last.name == "wh_np_clause":
            inner = node_of(last, "finite") if node_of(last, "wh_where") else None
            deed = None if inner is None else self.propositions.plain(self.clause(inner))
            if (place := place_of(deed)) is None:
                clause.question = self.questions.embedded(last, clause)
            else:
                clause.complements.append(Complement(leaf.key, place, node))
            return
        sem = self.inner(last)
        if leaf.key == "from" and isinstance(last, Node) and last.name in CLAUSES:
            clause.away = self.clause(last)  # "what keeps you from driving the limit"
        if isinstance(sem, SideOf):
            self._sided(leaf.key, sem.side, node, clause)
            return
        if is_share(leaf.key, sem, clause):
            clause.share = cast(Quantity, sem)
            return
        if leaf.words == ("up", "to") and clause.verb is not None and clause.verb.key == "come":
            clause.particles.append(replace(leaf, category="PART", key="up"))
        forced = "semi-must" in clause.aux and clause.verb is not None and not clause.passive
        if leaf.key == "by" and forced and is_named(sem):
            clause.because = sem  # "were you forced to stop by the bus"
            return
        lacked = getattr(sem, "described", None)  # "would you have braked with no bus there?"
        if leaf.key == "with" and clause.modal == "would" and lacked is not None:
            clause.without = lacked
            return
        shown = on_light(leaf.key, sem, leaves_of(node))
        clause.complements.append(Complement(leaf.key, shown, node))

    def _sided(self, key: str, side: str, node: Node, clause: Clause) -> None:
        if key == "from":
            clause.origin = side
        elif key in ("on", "at") and side in ("left", "right"):
            clause.bearings.append((side, node))
        else:
            clause.side = side

    def _on_side_pp(self, node: Node, clause: Clause) -> None:
        side = leaf_of(node, "SIDE")
        key = cast(Leaf, node.parts[0]).key
        self._sided(key, side.key if side else "left", node, clause)

    def _on_pp_bearing(self, node: Node, clause: Clause) -> None:
        leaf = cast(Leaf, node.parts[0])
        sem = self.nouns.read(cast(Node, node.parts[1]))
        clause.complements.append(Complement("bearing-" + leaf.key, sem, node))

    def _on_degree(self, node: Node, clause: Clause) -> None:
        leaf = cast(Leaf, node.parts[0])
        if leaf.key == "too":
            clause.focus.add("too")

    def _on_between(self, node: Node, clause: Clause) -> None:
        clause.complements.append(
            Complement("between", self.nouns.read(cast(Node, node.parts[1])), node)
        )

    def _on_between_deeds(self, node: Node, clause: Clause) -> None:
        deeds = tuple(self.inner(part) for part in node.parts if isinstance(part, Node))
        clause.complements.append(Complement("between", Group(deeds), node))

    def _on_stranded(self, node: Node, clause: Clause) -> None:
        leaf = cast(Leaf, node.parts[0])
        key = "bearing-" + leaf.key if leaf.category == "BEARP" else leaf.key
        clause.complements.append(Complement(key, None, node))

    # --- qualities ---------------------------------------------------

    def _on_adjective(self, node: Node, clause: Clause) -> None:
        words = [leaf for leaf in leaves_of(node) if leaf.category in ("DEG", "FOCUS")]
        degree = "too" if any(leaf.key == "too" for leaf in words) else ""
        if any(leaf.key == "enough" for leaf in words):
            degree = "enough"
        clause.still |= any("still" in leaf.words for leaf in words)
        leaf = leaf_of(node, "ADJ")
        if leaf is not None:
            clause.adjectives.append((leaf.key, degree))

    def _on_feeling(self, node: Node, clause: Clause) -> None:
        leaf = leaf_of(node, "FEELADJ")
        if leaf is not None:
            clause.feelings.append(leaf.key)

    def _on_comparison(self, node: Node, clause: Clause) -> None:
        leaf = leaf_of(node, "COMPAR")
        if leaf is not None:
            clause.comparisons.append((leaf.key, " ".join(leaf.words)))
            return
        for leaf in leaves_of(node):
            if leaf.category in ("ADJ", "ADV", "FEELADJ"):
                clause.comparisons.append((leaf.key, "as"))

    def _on_then_than(self, node: Node, clause: Clause) -> None:
        if leaf_of(node, "COMPAR") is not None:
            self._on_comparison(node, clause)
        self._on_than(node, clause)

    def _on_than(self, node: Node, clause: Clause) -> None:
        inner = node.parts[-1]
        if isinstance(inner, Leaf):  # "compared to his"
            clause.than = Pronoun("it") if inner.key == "his" else Ego()
            return
        if inner.name == "when" or inner.name.startswith("time"):
            then = self.slots.fill((inner,), Clause(subject=clause.subject)).time
            clause.than_time = Ago(EARLIER) if then in PAST else then
            return
        than: Clause | Sem | None
        than = self.clause(inner, clause) if inner.name in CLAUSES else self.inner(inner)
        if isinstance(than, Clause) and than.only_subject:
            if not isinstance(than.time, Unsaid):
                clause.than_time = Ago(EARLIER) if than.time in PAST else than.time
            than = than.subject
        clause.than = than

    def _on_as_than(self, node: Node, clause: Clause) -> None:
        self._on_comparison(node, clause)
        self._on_than(node, clause)
        than = clause.than
        if isinstance(than, Clause) and than.verb is not None and than.verb.key in _SEEMING:
            clause.adjectives.append((clause.comparisons.pop()[0], ""))
            clause.than = None  # "as hard as it felt"

    def _on_within(self, node: Node, clause: Clause) -> None:
        """Read "within two metres of us" as being closer than that, "within 5 s" as a time."""
        if (soon := time_within(node, clause)) is not None:
            clause.time = soon
            return
        clause.comparisons.append(("close", "within"))
        clause.than = self.nouns.read(Node("np", node.parts[1:2], node.start, node.end, 0.0))
        to = self.nouns.read(cast(Node, node.parts[3])) if len(node.parts) > 2 else Ego()
        if len(node.parts) == 2 and getattr(clause.than, "unit", "m") != "m":
            self.notes.unknown.append(node.leaves[0])  # "within two seconds" is no distance
        clause.complements.append(Complement("into", to, node))

    # --- complement clauses ------------------------------------------

    def _on_infinitive(self, node: Node, clause: Clause) -> None:
        inner = clause.infinitive = self.clause(node, clause)
        clause.judge()
        if clause.passive:  # "was it made to brake by us": by whom is said of the whole
            clause.complements += [c for c in inner.complements if c.key == "by"]
            inner.complements = [c for c in inner.complements if c.key != "by"]

    def _on_gerund(self, node: Node, clause: Clause) -> None:
        clause.gerund = self.clause(node, clause)

    def _on_bare(self, node: Node, clause: Clause) -> None:
        clause.bare = self.clause(node, clause)

    def _on_that_clause(self, node: Node, clause: Clause) -> None:
        bare = node_of(node, "finite_bare")
        inner = node_of(bare or node, *CLAUSES)
        clause.that = self.clause(inner) if inner is not None else self.slots.fill(node.parts)

    def _on_here_clause(self, node: Node, clause: Clause) -> None:
        inner = node_of(node, "finite")
        clause.that = None if inner is None else self.clause(inner)
        clause.focus.add("where")  # "is this where we get off"
        if clause.that is not None:
            clause.that.focus.add("where")

    def _on_tagged_state(self, node: Node, clause: Clause) -> None:
        self.slots.fill(node.parts, clause)  # "nearly there, aren't we?"

    def _on_wh_clause(self, node: Node, clause: Clause) -> None:
        clause.question = self.questions.embedded(node, clause)

    def _on_wh_np_clause(self, node: Node, clause: Clause) -> None:
        clause.question = self.questions.embedded(node, clause)

    def _on_and_pred(self, node: Node, clause: Clause) -> None:
        join = "or" if leaf_of(node, "OR") else "and"
        inner = cast(Node, node.parts[-1])
        chained = self.clause(inner, clause)
        chained.negated ^= leaf_of(node, "NOT") is not None
        plain = chained.verb is not None and chained.verb.form == "base"
        if not chained.aux:  # "going to stop or come out", but "going to stop, and went on"
            chained.aux = [a for a in clause.aux if plain or not a.startswith("semi")]
        clause.chained.append((join, chained))
        self.notes.chained.append(chained)

    def _on_skipped(self, node: Node, clause: Clause) -> None:
        clause.skipped += [leaf for leaf in leaves_of(node) if leaf.category in ("SKIP", "UNK")]
