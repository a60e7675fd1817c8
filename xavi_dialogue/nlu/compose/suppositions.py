"""Suppositions by themselves, and "what about": "what if he had", "if he hadn't?"."""

from typing import Any, Final

from xavi_dialogue.domain.meaning import Act, Ask, Claim, Elliptic, HowKnow, WhatIf, Why
from xavi_dialogue.domain.terms import Ego, Everyone, Pronoun, Proposition, Unsaid
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import leaf_of, node_of
from xavi_dialogue.nlu.compose.wh_questions.frames import is_contrary, is_short
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_AUXILIARY = frozenset({"BE", "DO", "HAVE", "HAD", "MODAL"})
#: What "had you ...?" asks of us: whether we did, and not what would have been.
_NOTICING = frozenset(
    {"see", "notice", "spot", "account", "consider", "know", "expect", "realise", "predict",
     "foresee", "anticipate", "detect", "register", "plan"}
)  # fmt: skip
Found = list[tuple[tuple[Act, ...], float]]


_ALL: Final = (Pronoun("them-all"), Everyone())


class Suppositions:
    """Reads units that suppose something."""

    composer: Any
    phrases: Any

    def noun_asked(self, sem: Sem | None, clause: Clause) -> Found | None:
        """Read a noun phrase as a question for it."""
        raise NotImplementedError

    def elliptic(self, unit: Node, clause: Clause) -> Found:
        """Read what takes its frame from the turn before."""
        raise NotImplementedError

    def about(self, unit: Node) -> Found:
        """Read "what about the bus", "how about slowing down"."""
        clause = self.phrases.slots.fill(unit.parts)
        for part in unit.parts:
            if isinstance(part, Node) and part.name in (
                "np",
                "group",
                "accusative",
                "accusative_group",
            ):
                clause.objects.insert(0, (self.phrases.nouns.read(part), part))
        sem: Sem | None = clause.objects[0][0] if clause.objects else None
        if isinstance(sem, (Measure, Noun)):
            found = self.noun_asked(sem, clause)
            if found is not None:
                return found
        supposed = self.composer.questions.supposition(clause)
        if supposed is not None:
            return [((suppose(supposed),), 0.0)]
        if clause.subject is not None and clause.verb is not None:
            value = self.composer.propositions.plain(clause)
            if value is not None:
                return [((Ask(WhatIf(value)),), 0.1)]
        return self.elliptic(unit, clause)

    def supposed(self, unit: Node) -> Found:
        """Read "what if he had stopped", "if he hadn't?", "suppose X. Would Y?"."""
        inner = node_of(
            unit,
            "finite",
            "finite_short",
            "finite_topic",
            "inverted",
            "inverted_short",
            "gerund",
            "np_not",
            "vp",
            "copular",
            "state",
        )
        then = node_of(unit, "then")
        outer = Clause(subject=Ego())
        if inner is not None:
            outer.condition = self.phrases.condition(inner, outer)
        else:
            self.phrases.slots.fill(unit.parts, outer)
        question = self._then(then) if then is not None else None
        condition = outer.condition
        if condition is not None and is_short(condition):
            thing = as_thing(condition.subject)
            act = Elliptic(thing, negated=condition.negated, form="what-if")
            return [((act,), 0.0)]
        supposed = self.composer.questions.supposition(outer)
        if supposed is None:
            return []
        if leaf_of(unit, "WHATIF") is None and question is None:
            return [((Ask(WhatIf(supposed)),), 0.1)]
        if isinstance(question, Why) and not is_contrary(question):
            return [((Claim(supposed), Ask(question)), 0.0)]  # "if it is green, why do we wait"
        if isinstance(question, HowKnow) and question.of is None:
            return [((Ask(HowKnow(supposed)),), 0.0)]  # "if somebody came, how would you know?"
        return [((Ask(WhatIf(supposed, question)),), 0.0)]

    def _then(self, node: Node) -> Any:
        wh_node, parts = self.composer.split(node)
        if wh_node is not None:
            wh = self.composer.questions.wh_of(wh_node)
            rest = [p for p in parts if not isinstance(p, Leaf) or p.category not in ("SO",)]
            if not rest:
                return None
            found = self.composer.questions.asked(wh, rest, Clause())
        else:
            clause = self.phrases.slots.fill(tuple(parts))
            if clause.verb is None and _bare_subject(clause):
                return None
            found = self.composer.questions.whether(clause)
        return found[0][0] if found else None

    def had(self, unit: Node) -> Found:
        """Read "had he stopped" by itself."""
        hads = node_of(unit, "hads")
        if hads is None:
            return []
        condition = self.phrases.clause(hads)
        if _is_noticing(condition):
            return []
        supposed = self.composer.questions.supposed(condition)
        return [((suppose(supposed),), 0.3)] if supposed is not None else []


def _bare_subject(clause: Clause) -> bool:
    return not (clause.objects or clause.adjectives or clause.comparisons or clause.complements
                or clause.bearings or clause.manner)  # fmt: skip


def suppose(supposed: Proposition) -> Act:
    """Ask what follows from a supposition."""
    return Ask(WhatIf(supposed))


def supposes(unit: Node, clause: Clause) -> bool:
    """Say whether "had you gone left?" supposes it: no time and no "already" asks for a fact.

    Neither does what is said of all of several.
    """
    had = next((p for p in unit.parts if isinstance(p, Leaf) and p.category in _AUXILIARY), None)
    if had is None or had.category != "HAD":
        return False
    led = any(isinstance(p, Leaf) and p.category in ("AND", "BUT") for p in unit.parts)
    if led and not {"already", "ever"} & {*clause.manner, *clause.focus}:  # "and had it moved off?"
        timed, told = False, clause.verb is not None or bool(clause.comparisons)
    else:
        timed = bool(not isinstance(clause.time, Unsaid) or clause.focus or clause.manner)
        told = clause.verb is not None
    if timed or not told or clause.subject in _ALL:
        return False
    return not _is_noticing(clause)


def _is_noticing(clause: Clause) -> bool:
    """Say whether "had you seen him" asks what we knew, and supposes nothing."""
    noticed = clause.verb is not None and clause.verb.key in _NOTICING
    return noticed and isinstance(clause.subject, Ego)


def goes_on(unit: Node) -> bool:
    """Say whether "and" or "or" stands behind "had you seen it": then nothing is supposed."""
    for part, later in zip(unit.parts, unit.parts[1:], strict=False):
        led = isinstance(part, Node) and part.name == "lead_clause"
        if led and isinstance(part, Node) and node_of(part, "hads") is not None:
            rest = unit.parts[unit.parts.index(later) :]
            leaves = [p.category for p in rest if isinstance(p, Leaf) and p.category != "COMMA"]
            return bool(leaves) and leaves[0] in ("AND", "OR")
    return False
