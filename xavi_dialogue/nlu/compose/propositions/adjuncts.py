"""Adjuncts: times, conditions, reasons and contrasts that stand beside a clause."""

from dataclasses import replace
from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Ago,
    At,
    AtDecision,
    Back,
    Event,
    Now,
    Pronoun,
    Quantity,
    Rank,
    Unsaid,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.amounts import speeds_of
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement, Slots
from xavi_dialogue.nlu.compose.clauses.sem import Group, Notes, SideOf, as_thing, is_named
from xavi_dialogue.nlu.compose.clauses.times import (
    come_to,
    left_behind,
    number_before,
    relative,
    time_of,
)
from xavi_dialogue.nlu.compose.clauses.tree import leaf_of, leaves_of, nodes_of, words_of
from xavi_dialogue.nlu.compose.propositions.heads import rank_of
from xavi_dialogue.nlu.compose.propositions.things import Nouns
from xavi_dialogue.nlu.compose.states.positions import placeless
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

CLAUSES = ("finite", "finite_short", "finite_topic", "inverted", "inverted_short", "vp",
           "copular", "state", "gerund", "bare", "infinitive")  # fmt: skip
NOUNS = ("np", "group", "accusative", "accusative_group")


#: Times that another one in the same clause may say more exactly, and such.
VAGUE = (Back(), Ago(), Now())
EXACT = (At, AtDecision)
SECOND = 0.4  # cost of another time in the same clause


class Adjuncts:
    """Reads what stands beside a clause."""

    notes: Notes
    propositions: Any
    nouns: Nouns
    slots: Slots

    def clause(self, node: Node, outer: Clause | None = None) -> Clause:
        """Read a clause inside."""
        raise NotImplementedError

    def _on_or_state(self, node: Node, clause: Clause) -> None:
        shared = Clause(subject=clause.subject, aux=list(clause.aux), verb=clause.verb)
        if clause.there:  # "is there anybody ahead, or behind?"
            shared.there = True
            shared.objects = [(placeless(sem), node) for sem, node in clause.objects]
        other = self.slots.fill(node.parts, shared)
        clause.chained.append(("or", other))
        self.notes.chained.append(other)

    def _on_or_gapped(self, node: Node, clause: Clause) -> None:
        """Read "or we for them" as the same deed of another: "did he wait for us or we for him"."""
        other = Clause(aux=list(clause.aux), verb=clause.verb)
        other = self.slots.fill(tuple(p for p in node.parts if isinstance(p, Node)), other)
        clause.chained.append(("or", other))
        self.notes.chained.append(other)

    def _on_or_other(self, node: Node, clause: Clause) -> None:
        """Read "or is he" as the same of another: "are you braking or is he?"."""
        bare = Clause(aux=list(clause.aux), verb=clause.verb)
        subject = self.slots.fill(tuple(p for p in node.parts if isinstance(p, Node)), bare)
        other = replace(clause, subject=subject.subject, chained=[], condition=None)
        clause.chained.append(("or", other))
        self.notes.chained.append(other)

    def _time(self, node: Node, clause: Clause) -> None:
        time = time_of(node)
        if (before := number_before(node)) is not None:
            clause.objects.append((Quantity(before), node))  # "we were doing eighty a minute ago"
        if isinstance(clause.time, Unsaid) or (clause.time in VAGUE and isinstance(time, EXACT)):
            clause.time = time  # "back then, at 3 s"
            clause.dated = leaf_of(node, "P") is not None and words_of(node).startswith("at ")
        elif node.name == "time_adverb":
            self.notes.inner[id(node)] = SECOND
        if words_of(node) == "right now" and _turns(clause):
            clause.side = "right"
        leaf = leaf_of(node, "P")
        asking = leaf is not None and leaf.key in ("for", "about")
        asking = asking or words_of(node).startswith("about a ")
        if node.name == "time_ago" and asking:  # "what for, a second ago"
            clause.complements.append(Complement("for", None, node))

    _on_time_adverb = _on_time_clock = _on_time_amount = _on_time_ago = _time
    _on_time_span = _on_time_rank = _on_time_between = _on_time_since = _time
    _on_time_to_now = _time
    _on_time_decision = _on_time_decisions = _on_time_bare = _time

    def _on_lead_time(self, node: Node, clause: Clause) -> None:
        for part in node.parts:
            if isinstance(part, Node):
                self._time(part, clause)

    def _on_lead_clause(self, node: Node, clause: Clause) -> None:
        inner = cast(Node, node.parts[0])
        if inner.name in ("hads", "if_clause"):
            clause.led = True
        if inner.name == "hads":
            clause.condition = self.clause(inner)
        elif inner.name == "pp" and cast(Leaf, inner.parts[0]).key == "about":
            about = cast(Node, inner.parts[1])
            named = self.nouns.read(about) if about.name in NOUNS else None
            clause.topic = named if named is not None and is_named(named) else None
            self.slots.fill(() if clause.topic else node.parts, clause)
        else:
            self.slots.fill(node.parts, clause)

    def _on_hads_clause(self, node: Node, clause: Clause) -> None:
        if clause.subject is None and clause.verb is None:
            self.notes.unknown.append(node.leaves[0])  # "how long had he been waiting?"
        clause.condition = self.clause(cast(Node, node.parts[0]))

    def _on_when(self, node: Node, clause: Clause) -> None:
        if len(node.parts) == 1:
            node = cast(Node, node.parts[0])
        leaf = cast(Leaf, node.parts[0])
        inner = cast(Node, node.parts[1])
        if inner.name in CLAUSES:
            said = self.clause(inner, clause)
            event, ended = self.propositions.as_event(said), self.propositions.ended(said)
            event = left_behind(said) or event
            if leaf.key in ("until", "before"):
                event = come_to(said) or event
        else:
            event, ended = self.nouns.read(inner), None
        anchor = ended or self.propositions.anchor(event)
        if leaf.key == "either":
            clause.focus.add("either")
        if leaf.key == "since" and anchor in (Event("go"), Event("leave")):
            clause.time = WholeRide()  # "since we set off"
        elif anchor is not None and isinstance(clause.time, Unsaid):
            clause.time = relative(_relation(leaf.key, bool(ended)), anchor)

    def _on_speeds(self, node: Node, clause: Clause) -> None:
        """Read "from 50 to 15" as speeds, which nobody says the unit of."""
        if (found := speeds_of(node)) is None:
            self.notes.inner[id(node)] = SECOND
        else:
            clause.speeds = found

    def _on_time_from_place(self, node: Node, clause: Clause) -> None:
        """Read "between the side road and here" as all since that place."""
        place = as_thing(self.nouns.read(nodes_of(node, "np")[0]))
        ends = [leaf.key for leaf in leaves_of(node) if leaf.category in ("TIMEADV", "PLACEADV")]
        starts = {leaf.key for leaf in leaves_of(node) if leaf.category in ("BETWEEN", "P")}
        if ends[-1:] not in (["now"], ["here"]) or not starts & {"between", "from"}:
            self.notes.inner[id(node)] = SECOND
        elif place is not None and isinstance(clause.time, Unsaid):
            clause.time = relative("since", place)

    def _on_occasion(self, node: Node, clause: Clause) -> None:
        """Take "the last time we stopped" for that clause, of that rank."""
        clause.that = self.clause(cast(Node, node.parts[-1]), clause)
        clause.that.time = Rank(rank_of(leaf_of(node, "ORD")))
        clause.subject = Pronoun("it")

    def _on_ever_was(self, node: Node, clause: Clause) -> None:
        """Read "was there a moment when he braked" as whether he ever did."""
        self.slots.fill(node.parts[-1:], clause)
        if isinstance(clause.time, Unsaid):
            clause.time = WholeRide()
        clause.focus.add("ever")

    def _on_when_np(self, node: Node, clause: Clause) -> None:
        self._on_when(node, clause)

    def _on_if_clause(self, node: Node, clause: Clause) -> None:
        clause.condition = self.condition(cast(Node, node.parts[1]), clause)

    def condition(self, inner: Node, outer: Clause | None) -> Clause:
        """Read what is supposed: a clause, or a thing that might be there."""
        if inner.name == "np_not":
            sem = self.nouns.read(cast(Node, inner.parts[-1]))
            negated = leaf_of(inner, "NOT") is not None
            return Clause(there=True, objects=[(sem, inner)], negated=negated)
        clause = self.clause(inner)
        if clause.subject is None and not clause.there and outer is not None:
            clause.subject = outer.subject
        return clause

    def _on_because(self, node: Node, clause: Clause) -> None:
        inner = cast(Node, node.parts[-1])
        if inner.name in CLAUSES:
            clause.because = self.clause(inner, clause)
        else:
            named = self.nouns.read(inner)
            first = clause.because
            if first is not None and not isinstance(first, Clause | Group):
                named = Group((first, named), "or")
            clause.because = named

    def _on_without(self, node: Node, clause: Clause) -> None:
        inner = cast(Node, node.parts[-1])
        if inner.name == "gerund":
            deed = self.propositions.as_deed(self.clause(inner))
            clause.lacking = deed if isinstance(deed, Event) else None
            return
        if inner.name in CLAUSES:
            clause.condition = self.clause(inner, clause)
            clause.condition.negated = True
        else:
            clause.without = self.nouns.read(inner)

    def _on_contrast(self, node: Node, clause: Clause) -> None:
        inner = node.parts[-1]
        if isinstance(inner, Leaf):
            clause.contrast = inner.key
        elif inner.name in CLAUSES:
            clause.contrast = self.clause(inner, clause)
        elif inner.name in NOUNS:
            sem = self.nouns.read(inner)
            clause.contrast = sem.side if isinstance(sem, SideOf) else sem
        else:
            clause.contrast = self.slots.fill((inner,), Clause(subject=clause.subject))


def _turns(clause: Clause) -> bool:
    """Tell whether a clause says that somebody turns and not yet which way."""
    said = clause.side or clause.particles or clause.objects or clause.complements
    return clause.verb is not None and clause.verb.key == "turn" and not said


def _relation(key: str, ended: bool) -> str:
    """Name how a time lies to an event; of "before or after" the first."""
    if ended:
        return "after"
    return "before" if key == "either" else key
