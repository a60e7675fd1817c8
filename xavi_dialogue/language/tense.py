"""Tense: when what a question speaks of happened, from its auxiliaries and verb forms."""

from collections.abc import Iterable
from typing import cast

from xavi_dialogue.explain.query import Tense
from xavi_dialogue.language.tokens import AUXILIARIES, Token

_PRESENT_HEADS = frozenset(
    {"is", "are", "do", "does", "makes", "causes", "keeps", "keeping", "prevents"}
)
_PAST_HEADS = frozenset({"was", "were", "did", "made", "caused", "taken", "been", "changed"})


def hypothetical(tokens: Iterable[Token]) -> bool:
    """Whether a "would" or "could" stands in the tokens without "have"."""
    return any(
        {"would", "could"} & set(t.value.split()) and "have" not in t.text.split()
        for t in tokens
        if t.terminal in AUXILIARIES
    ) and not any(t.terminal == "HAVE" for t in tokens)


def tense_of(tokens: tuple[Token, ...]) -> Tense | None:
    """The tense that auxiliaries and verb forms show; None where they show none."""
    values = [v for t in tokens if t.terminal in AUXILIARIES for v in t.value.split()]
    if "future" in values:
        return "past" if "past" in values else "future"
    if "past" not in values and any(_obliged(t) for t in tokens):
        return "present"
    if "past" in values or any(t.terminal == "HAVE" for t in tokens):
        return "past"
    if any("have" in t.text.split() for t in tokens if t.terminal in AUXILIARIES):
        return "past"
    if "present" in values:
        return "present"
    forms = {t.form for t in tokens if t.terminal not in AUXILIARIES or t.terminal == "BEGIN"}
    if forms & {"past", "part"}:
        return "past"
    return "present" if "third" in forms else None


def _obliged(token: Token) -> bool:
    """Whether it is a "have to" or "have got to"."""
    words = token.text.split()
    owes = "to" in words and bool({"have", "has"} & set(words)) and "had" not in words
    return token.terminal in AUXILIARIES and owes


def _dropped(clause: tuple[Token, ...]) -> bool:
    """Whether an "are" or "is" was left out: "why we stopping"."""
    forms = [t.form for t in clause if t.form]
    named = any(t.terminal in ("EGO", "NUMBER", "CAR", "KIND", "IT") for t in clause)
    auxiliary = any(t.terminal in AUXILIARIES for t in clause)
    return named and not auxiliary and forms[:1] == ["gerund"]


def head_tense(tokens: tuple[Token, ...]) -> Tense | None:
    """The tense of a phrase such as "what is the reason for", from its words."""
    words = {word for token in tokens for word in token.text.split()}
    if words & _PAST_HEADS:
        return "past"
    return "present" if words & _PRESENT_HEADS else None


def tense_for(rule: str, clause: tuple[Token, ...], whole: tuple[Token, ...]) -> Tense | None:
    """The tense of a question of that rule.

    Args:
        rule: the start rule of its reading.
        clause: tokens of the clause asked about.
        whole: all tokens of the question.
    """
    if rule == "what_if":
        return _of_what_if(whole)
    if rule in ("how", "confidence"):
        return _of_complement(rule, clause, whole)
    if rule == "replace":
        times = [t.value for t in whole if t.terminal == "TIME"]
        return cast(Tense, times[0]) if times and times[0] != "future" else None
    if rule == "where_goal":
        return tense_of(tuple(t for t in whole if t.terminal in AUXILIARIES))
    if named := [t.value for t in whole if t.terminal in ("HAPPENED", "PLAN")]:
        return cast(Tense, named[0])
    if rule == "compare":
        if hypothetical(whole):
            return "future"
        return tense_of(tuple(t for t in whole if t.terminal in AUXILIARIES)) or head_tense(whole)
    if rule == "sensitivity":
        found = tense_of(whole)
        if found == "past" or not any(t.terminal == "REQUIRE" for t in whole):
            return found or "past"
        return "past" if head_tense(whole) == "past" else "future"
    if rule == "when":
        ahead = any(t.terminal == "HOWLONG" and "will" in t.text.split() for t in whole)
        found = tense_of(clause) or ("future" if ahead else None)
        return "future" if found == "present" or hypothetical(clause) else found
    if hypothetical(clause):
        return "future" if rule == "what" else "past"
    found = tense_of(clause) or head_tense(tuple(t for t in whole if t.terminal not in AUXILIARIES))
    prevented = any(t.terminal in ("PREVENT", "MADE") for t in whole)
    if found is None and not prevented and rule in ("why", "why_not") and _dropped(clause):
        return "present"
    if any(t.terminal == "TIME" and t.value == "future" for t in whole) and found != "past":
        return "future"
    return found


def _of_what_if(whole: tuple[Token, ...]) -> Tense | None:
    if any(_unreal_past(t) or (t.terminal == "HAVE" and "past" in t.value) for t in whole):
        return "past"
    if hypothetical(whole) or any(_supposes(token) for token in whole):
        return "future"
    if _supposed_now(whole):
        return "future"
    words = {word for token in whole for word in token.text.split()}
    if tense_of(whole) == "past" or words & {"have", "happened"}:
        return "past"
    if any(t.form in ("base", "third") or t.terminal in AUXILIARIES for t in whole):
        return "future"
    return None


def _supposed_now(whole: tuple[Token, ...]) -> bool:
    """Whether it is of now: "what if it stopped now?", in which the past is no past."""
    since = next((i for i, t in enumerate(whole) if t.terminal == "IF"), len(whole))
    return any(t.terminal == "TIME" and t.value == "present" for t in whole[since:])


def _supposes(token: Token) -> bool:
    """Whether it is a "what would happen" or the like."""
    words = token.text.split()
    return token.terminal == "HAPPEN" and "would" in words and "have" not in words


def _unreal_past(token: Token) -> bool:
    """Whether it is a "would have" or the like."""
    if token.terminal not in AUXILIARIES:
        return False
    return "have" in token.text.split() and bool({"would", "could"} & set(token.value.split()))


def _after(clause: tuple[Token, ...], whole: tuple[Token, ...]) -> tuple[Token, ...]:
    """The auxiliaries behind a clause: "that stopping was right"."""
    start = next((i for i, t in enumerate(whole) if t is clause[-1]), len(whole))
    return tuple(t for t in whole[start + 1 :] if t.terminal in AUXILIARIES)


def _of_complement(rule: str, clause: tuple[Token, ...], whole: tuple[Token, ...]) -> Tense | None:
    """What was known or believed: seen from then, "was going to" lies ahead."""
    values = {v for t in clause if t.terminal in AUXILIARIES for v in t.value.split()}
    if whole and whole[0].terminal == "DECIDE":
        return "past" if head_tense(whole[:1]) == "past" else "present"
    if not clause:
        could = any("could" in t.text.split() for t in whole)
        return "past" if could or head_tense(whole) == "past" else None
    if "future" in values or "would" in values:
        return "future"
    bare = not any(t.terminal in AUXILIARIES or t.form in ("past", "third") for t in clause)
    if rule == "how" and bare and (head := head_tense(whole)):
        return head
    found = tense_of(clause) or tense_of(_after(clause, whole)) or tense_of(whole)
    named = any(t.terminal in ("CAR", "KIND", "NUMBER") for t in clause)
    if found is None and named and any(t.form == "gerund" for t in clause):
        return "future"  # "the odds of vehicle 3 turning"
    third = any(t.form in ("third", "base") for t in clause) and "past" not in values
    return "future" if third and "present" not in values else found
