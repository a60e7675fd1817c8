"""Topics: what a text is about when it is not a question the record can answer."""

from functools import cache

from xavi_dialogue.language.tokens import Token
from xavi_dialogue.language.wordlists import english, vocabulary

#: Reasons, the most telling first: an insult about the weather is an insult.
PRECEDENCE = (
    "injection",
    "abuse",
    "not-an-action",
    "legality",
    "blame",
    "perception",
    "unsupported-condition",
    "capability",
    "command",
    "off-topic",
)
_FOREIGN_SHARE = 0.5


@cache
def _languages() -> dict[str, frozenset[str]]:
    table = english()["languages"]
    return {name: frozenset(words.split()) for name, words in table.items()}


def reason_for(tokens: tuple[Token, ...], typed: tuple[str, ...]) -> str | None:
    """Why the car declines, from words of topics; None where no topic shows.

    Args:
        tokens: the text as tokens.
        typed: its words as typed, before spelling.
    """
    if is_foreign(typed):
        return "non-english"
    found = {t.value for t in tokens if t.terminal in ("TOPIC", "NOTACTION")}
    if any(t.terminal == "RUDE" for t in tokens) and _addressed(tokens):
        found.add("abuse")
    return next((reason for reason in PRECEDENCE if reason in found), None)


def _addressed(tokens: tuple[Token, ...]) -> bool:
    """Whether somebody is spoken to or about in words that are no question."""
    return any(t.terminal in ("EGO", "CAR") for t in tokens)


def is_foreign(typed: tuple[str, ...]) -> bool:
    """Whether most words belong to another language, or to another script."""
    words = [w for w in typed if w.isalpha()]
    if not words:
        return False
    script = sum(any(ord(c) > 0x24F for c in w) for w in words)
    if script * 2 >= len(words):
        return True
    known = vocabulary().words
    for listed in _languages().values():
        hits = [w for w in words if w in listed]
        telling = [w for w in hits if w not in known]
        if telling and len(hits) >= _FOREIGN_SHARE * len(words):
            return True
    return False


def is_gibberish(tokens: tuple[Token, ...]) -> bool:
    """Whether the words are mostly not English."""
    words = [t for t in tokens if t.terminal not in ("BREAK", "NUMBER")]
    unknown = sum(t.terminal == "UNKNOWN" for t in words)
    return unknown * 2 > len(words)
