"""Acts: the units of an utterance become questions, claims, requests, feelings, repairs."""

from dataclasses import replace
from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    AskHelp,
    Claim,
    Elliptic,
    HowSure,
    Identify,
    Repair,
    Request,
    Social,
    Summarise,
    WhatIf,
    Whether,
)
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Happens,
    Pronoun,
    Together,
    Vehicle,
)
from xavi_dialogue.nlu.compose.affairs import of_affairs, why_not
from xavi_dialogue.nlu.compose.alternatives.blames import blamed_for, causes_of
from xavi_dialogue.nlu.compose.alternatives.choosing import options_of
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.hedged import as_when, supposing
from xavi_dialogue.nlu.compose.clauses.peaks import extreme_told
from xavi_dialogue.nlu.compose.clauses.sem import Group, Measure, Notes, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import (
    is_not,
    is_possessed,
    leaf_of,
    leaves_of,
    lifted,
    node_of,
    words_of,
)
from xavi_dialogue.nlu.compose.fragments import Fragments
from xavi_dialogue.nlu.compose.orders import Orders
from xavi_dialogue.nlu.compose.propositions.phrases import Phrases
from xavi_dialogue.nlu.compose.propositions.propositions import Propositions
from xavi_dialogue.nlu.compose.propositions.severally import apart, asked_each, of_rival
from xavi_dialogue.nlu.compose.propositions.tally import among
from xavi_dialogue.nlu.compose.questions import Questions
from xavi_dialogue.nlu.compose.refining.asked import sought
from xavi_dialogue.nlu.compose.refining.counts import counted_each
from xavi_dialogue.nlu.compose.refining.told import lit_now, only_one, refined_whether
from xavi_dialogue.nlu.compose.refining.waits import waits_compared
from xavi_dialogue.nlu.compose.statements import Acts, Found, Statements, disputed
from xavi_dialogue.nlu.compose.states.existence import if_alone
from xavi_dialogue.nlu.compose.suppositions import goes_on, supposes
from xavi_dialogue.nlu.compose.talk import called, missed, says, stirred, talk_act
from xavi_dialogue.nlu.compose.verbs.expecting import as_expected, dreaded_hit, feared, of_belief
from xavi_dialogue.nlu.compose.wh_questions.frames import is_short
from xavi_dialogue.nlu.compose.wh_questions.whys import (
    RUN_ON,
    SWALLOWED,
    lacking,
    runs_on,
    swallows,
)
from xavi_dialogue.nlu.grammar.chart import Budget, Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_TALKING = frozenset({"TALK", "REPAIR", "HELP", "QUIZ", "OFFTOPIC"})
NOTHING = 2.5  # cost of a unit that cannot be read
NAMED = {"topic": 0.4, "apposed": 0.6}  # cost of alternatives beside the question which of them
SHORT = 0.5  # cost of "if you had" before an order
_COURTEOUS = frozenset({"PLEASE", "TAGWORD"})
_PROPOSING = frozenset({("maybe",), ("perhaps",)})


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
        """Read one unit as acts, in every way that it can be read; empty if there is none."""
        if unit.name in _RULES:
            found = cast(Found, getattr(self, _RULES[unit.name])(unit))
        else:
            found = self._talk(unit)
        found = [(of_affairs(acts, unit), cost) for acts, cost in found]
        talk = tuple(a for p in unit.parts if (a := _lead_act(p)) is not None)
        if unit.name == "talk" or not talk:
            return found
        return [((*talk, *acts), cost) for acts, cost in found]

    def _talk(self, unit: Node) -> Found:
        if unit.parts and isinstance(unit.parts[0], Node) and unit.parts[0].name == "called":
            return called(unit.parts[0])
        said = [p for p in unit.parts if isinstance(p, Leaf) and p.category in _TALKING]
        act = talk_act(said[0] if said else cast(Leaf, unit.parts[0])) if unit.parts else None
        if act is None and self.asks and words_of(unit).endswith("you sure"):
            return [((Ask(HowSure()),), 0.0)]
        asked = isinstance(act, Social) and act.kind == "how-are-you"
        if asked and leaf_of(unit, "P"):  # "what is up with that van"
            return []
        return [((act,) if act is not None else (), 0.0)]

    # --- questions ---------------------------------------------------

    def split(self, unit: Node) -> tuple[Node | None, list[Part]]:
        """Take the question word out of a unit; return it and the other parts."""
        whs = [p for p in unit.parts if isinstance(p, Node) and p.name.startswith("wh_")
               and p.name not in ("wh_clause", "wh_np_clause")]  # fmt: skip
        wh = whs[0] if whs else None
        return wh, lifted([p for p in unit.parts if p is not wh])

    def _ask(self, unit: Node) -> Found:
        wh_node, parts = self.split(unit)
        if wh_node is None:
            return []
        if unit.name == "ask_in_place":  # "you did not stop, why not?"
            at = unit.parts.index(wh_node)
            if any(isinstance(p, Node) and node_of(p, "tag") for p in unit.parts[at + 1 :]):
                return []  # "you could have gone, why didn't you?"
            parts = [p for p in parts if p not in unit.parts[at + 1 : at + 2] or not is_not(p)]
        if (also := node_of(unit, "also_wh")) is not None:
            return self._ask_both(unit, wh_node, also)
        wh = self.questions.wh_of(wh_node)
        if counts := counted_each(wh, lambda one: self.questions.asked(one, parts, Clause())):
            return counts
        clause = Clause()
        found = self.questions.asked(wh, parts, clause)
        bare = clause.verb is None and not clause.aux and isinstance(clause.subject, Measure)
        if wh.kind == "what" and wh.preposition and bare:
            return []  # "from what speed" asks for a speed, and not what "speed" is
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
        if wh.kind == "what" and missed(clause):
            return [((Ask(Summarise(time=clause.time)),), 0.0)]
        told = (found and clause.complements) or unit.name != "ask_lacking"  # "why aren't we?"
        if wh.kind == "why" and not told and (left := lacking(clause)) is not None:
            return [((left,), 0.0)]
        if (held := leaf_of(unit, "THINKQ")) is not None:
            found = [(of_belief(question, wh.kind, held.key), cost) for question, cost in found]
        named = next((sem for sem, _ in clause.objects), clause.subject)
        if waits := waits_compared(clause, [question for question, _ in found]):
            return [(tuple(Ask(question) for question in waits), found[0][1])]
        each = asked_each(named, clause, clause.tense) if wh.kind == "what" else ()
        if each and clause.verb is None:
            return [(tuple(Ask(question) for question in each), 0.0)]
        if (rival := of_rival(found, clause)) is not None:
            return [((Ask(found[0][0]), Ask(rival)), found[0][1])]
        extra = SWALLOWED * (wh.kind == "grade" and wh.key != "likely" and swallows(unit))
        return [((Ask(question),), cost + extra) for question, cost in found]

    def _ask_both(self, unit: Node, wh: Node, also: Node) -> Found:
        """Read "when and why did you brake" as two questions about one clause."""
        second = cast(Node, also.parts[-1])
        rest = [part for part in unit.parts if part is not also]
        others = tuple(second if part is wh else part for part in rest)
        found = self._ask(replace(unit, parts=others))
        if leaf_of(also, "OR") is not None and {wh.name, second.name} <= {"wh_who", "wh_what"}:
            return self._ask(replace(unit, parts=tuple(rest)))
        return [
            ((*acts, *more), cost + extra)
            for acts, cost in self._ask(replace(unit, parts=tuple(rest)))
            for more, extra in found[:1]
        ]

    def _polar(self, unit: Node) -> Found:
        clause = self.phrases.slots.fill(unit.parts)
        if (lit := lit_now(clause)) is not None:
            return [(lit, 0.0)]
        liked = clause.verb is not None and clause.verb.key in ("like", "love", "enjoy", "hate")
        liked = liked or "do you like" in words_of(unit)
        if clause.feelings and clause.that is not None and isinstance(clause.subject, Ego):
            dreaded = self.propositions.plain(clause.that)  # "were you worried he'd pull out"
            if (struck := dreaded_hit(dreaded)) is not None:
                return [((Social("feelings", struck),), 0.0)]
            if dreaded is not None and clause.feelings[0] in ("afraid", "nervous"):
                return [((Ask(HowSure(feared(dreaded), clause.time)),), 0.0)]
        if (moved := stirred(unit, clause, liked=liked and clause.modal is None)) is not None:
            return [((moved,), 0.1)]
        if says(clause) and clause.question is None:
            return [((AskHelp(),), 0.1)]
        order = self.orders.polite(
            clause, refrain=_refrains(unit), please="please" in words_of(unit).split()
        )
        if order is not None:
            return [(why_not(order, unit, clause), 0.0)]
        if goes_on(unit) or supposing(unit) or (clause.there and len(clause.objects) > 1):
            return []
        if (why := blamed_for(clause)) is not None:
            return [((Ask(why),), 0.0)]
        special = extreme_told(clause) or as_expected(unit, clause)
        special = special or if_alone(words_of(unit), clause) or only_one(clause)
        if special is not None:
            return [((Ask(special),), 0.0)]
        if supposes(unit, clause) and (supposed := self.questions.supposed(clause)) is not None:
            return [((Ask(WhatIf(supposed)),), 0.0)]
        found = [(refined_whether(clause, q), cost) for q, cost in self.questions.whether(clause)]
        if not found and unit.name == "polar_short":
            return self.fragments.short(clause)
        return [(apart(disputed(q, words_of(unit))), cost) for q, cost in found]

    # --- the rest ----------------------------------------------------

    def _imperative(self, unit: Node) -> Found:
        clause = self.phrases.slots.fill(unit.parts)
        leaf = clause.verb
        ceasing = any(isinstance(p, Node) and p.name == "ceasing" for p in unit.parts)
        if leaf is None or (leaf.form != "base" and not ceasing):
            return []
        if self.asks and leaf.words == ("speed",) and len(unit.parts) == 1:
            return []  # "speed?"
        given = clause.condition
        short = given is not None and is_short(given)
        if short and self.asks:
            return []  # "if it had come out?"
        negated = _forbids(unit) != ceasing
        if negated and leaf.key == "go" and clause.gerund is not None and not clause.particles:
            clause = clause.gerund  # "don't go getting close"
        found = [(acts, cost + SHORT * short)
                 for acts, cost in self.orders.order(clause, negated=negated)]  # fmt: skip
        courteous = any(
            leaf.category in _COURTEOUS or leaf.words in _PROPOSING for leaf in leaves_of(unit)
        ) or any(isinstance(part, Node) and part.name == "tail" for part in unit.parts)
        if not self.asks or courteous or ceasing or _forbids(unit):
            return found
        return [(self._asks_back(acts), cost) for acts, cost in found]

    def _asks_back(self, acts: Acts) -> Acts:
        """Read "back again?", "sit behind him all day?" as the question whether we will do so."""
        first = acts[0] if acts else None
        if not isinstance(first, Request) or first.event.action == "keep-distance":
            return acts
        return (Ask(Whether(Happens(first.event))), *acts[1:])

    def _fragment(self, unit: Node) -> Found:
        found = [] if goes_on(unit) else self.fragments.fragment(unit)
        if unit.name == "adverbial" and self.asks:
            return [(tuple(map(as_when, acts)), cost) for acts, cost in found]
        return found

    def _topic(self, unit: Node) -> Found:
        """Read a thing that is named first, and to which a pronoun of the next unit refers."""
        things = ("np", "aliased", "group", "accusative", "accusative_group")
        named = [p for p in unit.parts if isinstance(p, Node) and p.name in things]
        if any(is_possessed(part) for part in named[0].parts):
            return []  # "its green now" says that a light is green
        sem = self.phrases.nouns.read(named[0])
        if leaf_of(unit, "TALLY"):
            counted = among(sem, named[0])
            return [] if counted is None else [((Claim(counted),), 0.0)]
        if (options := options_of(sem) if unit.name == "topic" else causes_of(sem)) is not None:
            return [((Elliptic(Together(options), form="which"),), NAMED[unit.name])]
        thing = as_thing(sem)
        told = isinstance(thing, Described | Vehicle)
        if unit.name == "apposed" and isinstance(sem, Group):
            return []
        if unit.name == "apposed":
            told = told or isinstance(thing, Ego)
            told = told and getattr(thing, "definite", True)
        return [((Elliptic(thing),), 0.0)] if told else []

    def _ask_bare(self, unit: Node) -> Found:
        tails = (part for part in unit.parts if isinstance(part, Node) and part.name == "tail")
        if any(isinstance(p, Node) and p.name == "tag" for tail in tails for p in tail.parts):
            return []  # not "how close" with the tag "was it?", but one question
        extra = RUN_ON * runs_on(unit)
        found = self.fragments.bare_question(unit)
        return [(tuple(map(sought, acts)), cost + extra) for acts, cost in found]

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
    "ask_evidence": "_ask_bare",
    "polar": "_polar",
    "polar_short": "_polar",
    "declarative": "_declarative",
    "imperative": "_imperative",
    "fragment": "_fragment",
    "topic": "_topic",
    "apposed": "_topic",
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
    denies = isinstance(part, Leaf) and part.category == "NO"
    return Social("disagree") if denies else None


def _refrains(unit: Node) -> bool:
    """Check whether "could you please not brake" asks us not to; "couldn't you" does not."""
    words = [word for leaf in leaves_of(unit) for word in leaf.words]
    if "not" not in words:
        return False
    before, after = words[: words.index("not")], words[words.index("not") + 1 :]
    if after[:1] in (["you"], ["we"]):  # "can't you go any faster"
        return False
    polite = not {"please", "perhaps", "maybe", "possibly", "rather"}.isdisjoint(before)
    return polite or not {"any", "anymore", "so", "again", "too", "that"}.isdisjoint(words)


def _forbids(unit: Node) -> bool:
    return any(is_not(part) for part in unit.parts)
