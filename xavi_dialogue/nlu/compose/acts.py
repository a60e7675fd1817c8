"""Acts: the units of an utterance become questions, claims, requests, feelings, repairs."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Identify,
    Question,
    Repair,
    Social,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Believed,
    Ego,
    Event,
    Happens,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
)
from xavi_dialogue.nlu.compose.candidates import Special
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.fragments import Fragments
from xavi_dialogue.nlu.compose.orders import Orders
from xavi_dialogue.nlu.compose.phrases import Phrases
from xavi_dialogue.nlu.compose.propositions import Propositions
from xavi_dialogue.nlu.compose.questions import Questions
from xavi_dialogue.nlu.compose.sem import Notes, as_thing
from xavi_dialogue.nlu.compose.states import ungoverned
from xavi_dialogue.nlu.compose.talk import feeling_of, talk_act
from xavi_dialogue.nlu.compose.tree import leaf_of, leaves_of
from xavi_dialogue.nlu.compose.wh import fact
from xavi_dialogue.nlu.grammar.chart import Budget, Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

Acts = tuple[Act, ...]
Found = list[tuple[Acts, float]]
_TALKING = frozenset({"TALK", "REPAIR", "HELP", "QUIZ", "OFFTOPIC"})
NOTHING = 2.5  # cost of a unit of which nothing can be made
STATED = 0.15  # of a statement taken for a question


class Composer:
    """Composes the units of one utterance."""

    def __init__(self, budget: Budget, end_mark: str = "") -> None:
        self.notes = Notes()
        self.asks = end_mark == "?"
        self.propositions = Propositions(self.notes, budget)
        self.questions = Questions(self.notes)
        self.phrases = Phrases(self.propositions, self.questions, self.notes)
        self.questions.phrases = self.phrases
        self.questions.propositions = self.propositions
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
        act = talk_act(cast(Leaf, unit.parts[0])) if unit.parts else None
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
        if (
            clause.verb is not None
            and clause.verb.key == "mean"
            and isinstance(clause.subject, Ego)
        ):
            kind: Any = "simpler" if wh.kind == "what" else "repeat"
            if wh.kind in ("who", "which"):
                return [((Ask(Identify(Pronoun("that"))),), 0.0)]
            return [((Repair(kind),), 0.0)]
        return [((Ask(question),), cost) for question, cost in found]

    def _polar(self, unit: Node) -> Found:
        clause = self.phrases.slots.fill(unit.parts)
        if clause.feelings and _of_you(unit, clause):
            return [((Social("are-you-human"),), 0.1)]
        order = self.orders.polite(clause)
        if order is not None:
            return [(order, 0.0)]
        found = self.questions.whether(clause)
        if not found and unit.name == "polar_short":
            return self.fragments.short(clause)
        return [((Ask(q),), cost) for q, cost in found]

    # --- statements --------------------------------------------------

    def _declarative(self, unit: Node) -> Found:
        clause = self.phrases.slots.fill(unit.parts)
        meant = self._meant(clause)
        if meant is not None:
            return [((meant,), 0.0)]
        order = self.orders.stated(clause)
        if order is not None:
            return [(order, 0.0)]
        if isinstance(clause.subject, Ego) and any(key == "rude" for key, _ in clause.adjectives):
            return [((Social("insult"),), 0.0)]
        candidates = self.propositions.readings(clause)
        tagged = _tagged(unit)
        if (tagged or self.asks) and not clause.feelings:
            compared = self.questions.comparison(clause)
            if compared is not None:
                return [((Ask(self.questions.framed(compared, clause, None)),), STATED)]
        found: Found = []
        for candidate in candidates:
            acts = self._stated(clause, candidate.value, tagged)
            found.append((acts, candidate.cost))
        if not candidates and clause.feelings:
            feeling = feeling_of(clause, None)
            if feeling is not None:
                found.append(((feeling,), ungoverned(clause)))
        return found

    def _meant(self, clause: Clause) -> Act | None:
        """Read "I meant the red one", "I was asking about vehicle 3"."""
        if clause.verb is None or not isinstance(clause.subject, Passenger):
            return None
        if clause.verb.key not in ("mean", "ask", "talk", "refer", "speak"):
            return None
        sems = [p.sem for p in clause.complements] + [sem for sem, _ in clause.objects]
        thing = next((t for sem in sems if (t := as_thing(sem)) is not None), None)
        return Repair("meant", thing) if thing is not None and thing != Ego() else None

    def _stated(self, clause: Clause, value: Any, tagged: bool) -> Acts:
        feeling = feeling_of(clause, value)
        if feeling is not None:
            return (feeling,)
        asked = self._embedded(clause, value)
        if asked:
            return asked
        of = self.propositions.joined(clause, fact(value))
        if isinstance(value, Special) and isinstance(clause.subject, Passenger):
            expected = self._expected(value)
            if expected is not None:
                return (Ask(expected),)
        if tagged or self.asks:
            question = self.questions.polar(clause, value, tag=True)
            if isinstance(value, Special) and isinstance(of, Believed):
                question = Whether(of, True)
            return (Ask(self.questions.framed(question, clause, value)),)
        if isinstance(of, Related) and of.thing == Passenger() and of.relation == "with":
            return (Social("acknowledge"),)
        supposed = self.questions.supposition(clause)
        if supposed is not None:
            return (Ask(self.questions.framed(Whether(of, True), clause, value)),)
        return (Claim(of, _disputes(of, clause)),)

    def _expected(self, value: Special) -> Question | None:
        """Take "I expected you to stop" for the question why not."""
        if value.name in ("believe", "wish", "want") and value.content is not None:
            content = value.content
            if value.clause.negated:
                return Why(content)
            return Why(content.content if isinstance(content, Not) else Not(content))
        return None

    def _embedded(self, clause: Clause, value: Any) -> Acts:
        """Find the question behind "I wonder", "I do not understand", "do you know"."""
        if not isinstance(value, Special) or clause.question is None:
            return ()
        return self.orders.embedded(clause)

    # --- the rest ----------------------------------------------------

    def _imperative(self, unit: Node) -> Found:
        clause = self.phrases.slots.fill(unit.parts)
        leaf = clause.verb
        if leaf is None or leaf.form != "base":
            return []
        return self.orders.order(clause, negated=_forbids(unit))

    def _fragment(self, unit: Node) -> Found:
        return self.fragments.fragment(unit)

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


def _of_you(unit: Node, clause: Clause) -> bool:
    """Say whether "are you scared", "do you get bored" is asked: of the car, with no reason."""
    if not isinstance(clause.subject, Ego) or clause.that is not None or clause.because is not None:
        return False
    return any(leaf.category == "YOU" for leaf in leaves_of(unit)) and not clause.complements


def _tagged(unit: Node) -> bool:
    for part in unit.parts:
        if isinstance(part, Node) and part.name == "tail":
            if leaf_of(part, "TAGWORD") or any(isinstance(p, Node) for p in part.parts):
                return True
            if leaf_of(part, "NOT"):
                return True
    return False


def _forbids(unit: Node) -> bool:
    return any(isinstance(p, Leaf) and p.category == "NOT" for p in unit.parts)


def _disputes(of: Proposition, clause: Clause) -> bool:
    """Say whether a claim disputes what the car said: "that is wrong", "you could have known"."""
    match of:
        case Not() | Believed():
            return True
        case Happens(event=Event(actor=Ego(), modal=modal)) if modal in ("could", "should"):
            return True
    state = getattr(of, "state", "")
    return state in ("wrong", "dangerous")
