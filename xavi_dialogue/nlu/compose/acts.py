"""Acts: the units of an utterance become questions, claims, requests, feelings, repairs."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    AskHelp,
    Elliptic,
    HowKnow,
    Identify,
    Question,
    Repair,
    Request,
    Social,
    WhatIf,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Happens,
    Pronoun,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.fragments import Fragments
from xavi_dialogue.nlu.compose.nominal import asked_each
from xavi_dialogue.nlu.compose.orders import Orders
from xavi_dialogue.nlu.compose.phrases import Phrases
from xavi_dialogue.nlu.compose.propositions import Propositions
from xavi_dialogue.nlu.compose.questions import Questions
from xavi_dialogue.nlu.compose.sem import Notes, as_thing
from xavi_dialogue.nlu.compose.statements import Acts, Found, Statements
from xavi_dialogue.nlu.compose.talk import says, talk_act
from xavi_dialogue.nlu.compose.tree import leaf_of, leaves_of
from xavi_dialogue.nlu.compose.whys import lacking
from xavi_dialogue.nlu.grammar.chart import Budget, Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_AUXILIARY = frozenset({"BE", "DO", "HAVE", "HAD", "MODAL"})
_TALKING = frozenset({"TALK", "REPAIR", "HELP", "QUIZ", "OFFTOPIC"})
NOTHING = 2.5  # cost of a unit of which nothing can be made
SHORT = 0.5  # of "if you had" before an order
#: What is asked rather than bidden where it ends with a question mark.
_WAYS = frozenset({"exit-left", "exit-right", "exit-straight", "turn", "change-left",
                   "change-right", "change-lane", "reverse", "continue", "leave",
                   "go"})  # fmt: skip


class Composer(Statements):
    """Composes the units of one utterance."""

    def __init__(self, budget: Budget, end_mark: str = "") -> None:
        self.notes = Notes()
        self.asks = end_mark == "?"
        self.propositions = Propositions(self.notes, budget)
        self.questions = Questions(self.notes)
        self.phrases = Phrases(self.propositions, self.questions, self.notes)
        self.questions.phrases = self.phrases
        self.questions.propositions = self.propositions
        self.questions.asking.propositions = self.propositions
        self.orders = Orders(self)
        self.fragments = Fragments(self)

    def compose(self, unit: Node) -> Found:
        """Read one unit as acts, in every way that it can be read; empty where in none."""
        if unit.name in _RULES:
            found = cast(Found, getattr(self, _RULES[unit.name])(unit))
        else:
            found = self._talk(unit)
        talk = tuple(a for p in unit.parts if (a := _lead_act(p)) is not None)
        if unit.name == "talk" or not talk:
            return found
        return [((*talk, *acts), cost) for acts, cost in found]

    def _talk(self, unit: Node) -> Found:
        said = [p for p in unit.parts if isinstance(p, Leaf) and p.category in _TALKING]
        act = talk_act(said[0] if said else cast(Leaf, unit.parts[0])) if unit.parts else None
        asked = isinstance(act, Social) and act.kind == "how-are-you"
        if asked and leaf_of(unit, "P"):  # "what is up with that van"
            return []
        return [((act,) if act is not None else (), 0.0)]

    # --- questions ---------------------------------------------------

    def split(self, unit: Node) -> tuple[Node | None, list[Part]]:
        """Take the question word out of the parts of a unit."""
        whs = [p for p in unit.parts if isinstance(p, Node) and p.name.startswith("wh_")
               and p.name not in ("wh_clause", "wh_np_clause")]  # fmt: skip
        wh = whs[0] if whs else None
        return wh, [p for p in unit.parts if p is not wh]

    def _ask(self, unit: Node) -> Found:
        wh_node, parts = self.split(unit)
        if wh_node is None:
            return []
        wh = self.questions.wh_of(wh_node)
        clause = Clause()
        found = self.questions.asked(wh, parts, clause)
        if wh.kind in ("how", "what", "where") and says(clause):
            return [((AskHelp(),), 0.0)]
        if (
            clause.verb is not None
            and clause.verb.key == "mean"
            and isinstance(clause.subject, Ego)
        ):
            kind: Any = "simpler" if wh.kind == "what" else "repeat"
            if wh.kind in ("who", "which"):
                return [((Ask(Identify(Pronoun("that"))),), 0.0)]
            return [((Repair(kind),), 0.0)]
        if wh.kind == "why" and unit.name == "ask_lacking" and clause.verb is None:
            return [((lacking(clause),), 0.0)]
        if wh.kind == "why" and leaf_of(unit, "THINKQ"):
            found = [(_grounds(question), cost) for question, cost in found]
        named = next((sem for sem, _ in clause.objects), clause.subject)
        each = asked_each(named, clause.time, clause.tense) if wh.kind == "what" else ()
        if each and clause.verb is None:
            return [(tuple(Ask(question) for question in each), 0.0)]
        return [((Ask(question),), cost) for question, cost in found]

    def _polar(self, unit: Node) -> Found:
        clause = self.phrases.slots.fill(unit.parts)
        if clause.feelings and _of_you(unit, clause):
            return [((Social("are-you-human"),), 0.1)]
        if says(clause) and clause.question is None:
            return [((AskHelp(),), 0.1)]
        order = self.orders.polite(clause)
        if order is not None:
            return [(order, 0.0)]
        if _supposes(unit, clause) and (supposed := self.questions.supposed(clause)) is not None:
            return [((Ask(WhatIf(supposed)),), 0.0)]
        found = self.questions.whether(clause)
        if not found and unit.name == "polar_short":
            return self.fragments.short(clause)
        return [((Ask(q),), cost) for q, cost in found]

    # --- the rest ----------------------------------------------------

    def _imperative(self, unit: Node) -> Found:
        clause = self.phrases.slots.fill(unit.parts)
        leaf = clause.verb
        if leaf is None or leaf.form != "base":
            return []
        given = clause.condition
        short = given is not None and given.verb is None and bool(given.aux)
        found = [(acts, cost + SHORT * short)
                 for acts, cost in self.orders.order(clause, negated=_forbids(unit))]  # fmt: skip
        asks = self.asks and "PLEASE" not in {leaf.category for leaf in leaves_of(unit)}
        if not asks or _forbids(unit):
            return found
        return [(self._asks_back(acts), cost) for acts, cost in found]

    def _asks_back(self, acts: Acts) -> Acts:
        """Take "back again?", "left here?" for the question whether we do so."""
        first = acts[0] if acts else None
        if not isinstance(first, Request) or first.event.action not in _WAYS:
            return acts
        return (Ask(Whether(Happens(first.event))), *acts[1:])

    def _fragment(self, unit: Node) -> Found:
        return self.fragments.fragment(unit)

    def _topic(self, unit: Node) -> Found:
        """Read what is named first and taken up by a pronoun of the next unit."""
        named = [p for p in unit.parts if isinstance(p, Node) and p.name in ("np", "group")]
        thing = as_thing(self.phrases.nouns.read(named[0]))
        told = isinstance(thing, Described | Vehicle)
        return [((Elliptic(thing),), 0.0)] if told else []

    def _ask_bare(self, unit: Node) -> Found:
        return self.fragments.bare_question(unit)

    def _about(self, unit: Node) -> Found:
        return self.fragments.about(unit)

    def _supposed(self, unit: Node) -> Found:
        return self.fragments.supposed(unit)

    def _had(self, unit: Node) -> Found:
        return self.fragments.had(unit)


_RULES = {
    "ask_inverted": "_ask",
    "ask_extracted": "_ask",
    "ask_lacking": "_ask",
    "ask_measure": "_ask_bare",
    "ask_subject": "_ask",
    "ask_declarative": "_ask",
    "ask_in_place": "_ask",
    "ask_bare": "_ask_bare",
    "polar": "_polar",
    "polar_short": "_polar",
    "declarative": "_declarative",
    "imperative": "_imperative",
    "fragment": "_fragment",
    "topic": "_topic",
    "adverbial": "_fragment",
    "about": "_about",
    "supposed": "_supposed",
    "had_supposed": "_had",
}


def _lead_act(part: Part) -> Act | None:
    if isinstance(part, Node) and part.name == "talk_lead":
        return talk_act(cast(Leaf, part.parts[0]))
    if isinstance(part, Leaf) and part.category in _TALKING:
        return talk_act(part)
    if isinstance(part, Leaf) and part.category == "NO":
        return Social("disagree")
    return None


def _supposes(unit: Node, clause: Clause) -> bool:
    """Say whether "had you gone left?" supposes it: no time and no "already" asks for a fact."""
    had = next((p for p in unit.parts if isinstance(p, Leaf) and p.category in _AUXILIARY), None)
    timed = not isinstance(clause.time, Unsaid) or clause.focus or clause.manner
    return had is not None and had.category == "HAD" and clause.verb is not None and not timed


def _grounds(question: Question) -> Question:
    """Take "why do you think he stops" for the question what shows it."""
    return HowKnow(question.of) if isinstance(question, Why) else question


def _of_you(unit: Node, clause: Clause) -> bool:
    """Say whether "are you scared", "do you get bored" is asked: of the car, with no reason."""
    if not isinstance(clause.subject, Ego) or clause.that is not None or clause.because is not None:
        return False
    return any(leaf.category == "YOU" for leaf in leaves_of(unit)) and not clause.complements


def _forbids(unit: Node) -> bool:
    return any(isinstance(p, Leaf) and p.category == "NOT" for p in unit.parts)
