"""Tokens: what was typed, cut into words, numbers, times of the ride and clause marks."""

import re
import unicodedata
from dataclasses import dataclass
from itertools import pairwise

MAX_CHARACTERS = 256  # read of any input: the end of a longer one, where the question stands
MAX_TOKENS = 48
MAX_INPUT = 4096  # [characters] of a longer input only the end is looked at

_ESCAPES = re.compile(r"\x1b(?:\[[0-9;:?<=>]*[a-zA-Z@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\)?|.)")
_QUOTES = str.maketrans({"’": "'", "‘": "'", "`": "'", "´": "'", "ʼ": "'", "“": " ", "”": " "})
_PIECES = re.compile(
    r"#\d{1,3}(?!\d)|(?<!\d)\d{1,3}:\d{2}(?!\d)|[^\W\d_]+(?:_[^\W_]+)+|\d{1,3}'s(?![^\W_])"
    r"|\d+(?:st|nd|rd|th)(?![^\W_])|4ever|2day|(?:no|any|ne|some|every)1(?!\d)|[glmwr]{1,2}8[a-z]{0,4}"
    r"|\d+(?:[.,]\d+)?|[a-uw-z]\d[a-z]?(?![a-z\d])|[^\W\d_]+(?:['-][^\W\d_]+)*'?"
    r"|%|\.{2,}|[.,;:!?–—()]|-"
)
_MODALS = frozenset(("would", "could", "should", "might", "must"))
_NUMBERS = {"four": "for", "two": "to"}  # as a recogniser of speech mistakes them
_AFTER_PREPOSITION = frozenset(("us", "him", "her", "them", "me", "it", "the", "that", "this"))
_STOPS = frozenset(".!?;")
_MARKS = frozenset(".,;:!?–—()-")


@dataclass(frozen=True, slots=True)
class Token:
    """One word as typed; `mark` is the clause mark before it: "", "," or "."."""

    text: str
    mark: str = ""


@dataclass(frozen=True, slots=True)
class Typed:
    """The tokens of an utterance and the mark that ends it, "?" where it asks."""

    tokens: tuple[Token, ...]
    end: str = ""
    shortened: bool = False


def clean(text: str) -> str:
    """Strip escapes and control characters, fold to NFKC and lower case, single spaces."""
    text = _ESCAPES.sub(" ", text[-MAX_INPUT:])
    text = unicodedata.normalize("NFKC", text).translate(_QUOTES)
    kept = (c if unicodedata.category(c)[0] not in "CM" else " " for c in text)
    return " ".join("".join(kept).lower().split())


def _heard_as_of(tokens: list[Token]) -> list[Token]:
    """Write "have" where "of" was heard: "would of"; it is superfluous in "hadn't of"."""
    found: list[Token] = []
    for index, token in enumerate(tokens):
        before = tokens[index - 1].text.replace("'", "") if index else ""
        after = tokens[index + 1].text if index + 1 < len(tokens) else "course"
        if token.text != "of" or token.mark or after == "course":
            found.append(token)
        elif before.removesuffix("nt") in _MODALS:
            found.append(Token("have"))
        elif before not in ("had", "hadnt"):
            found.append(token)
    return found


def _heard_as_number(tokens: list[Token]) -> list[Token]:
    """Write the preposition where a number was heard before a pronoun or article: "four us"."""
    found = list(tokens)
    for index, (token, after) in enumerate(pairwise(tokens)):
        if token.text in _NUMBERS and after.text in _AFTER_PREPOSITION and not after.mark:
            found[index] = Token(_NUMBERS[token.text], token.mark)
    return found


def tokenise(text: str) -> Typed:
    """Cut a text into tokens; of one that is too long the end is read."""
    cleaned = clean(text)
    shortened = len(cleaned) > MAX_CHARACTERS
    if shortened:
        cleaned = cleaned[-MAX_CHARACTERS:].partition(" ")[2] or cleaned[-MAX_CHARACTERS:]
    tokens: list[Token] = []
    mark = ""
    for piece in _PIECES.findall(cleaned):
        if piece in _MARKS or piece.startswith(".."):
            mark = "." if piece in _STOPS or mark == "." else ","
            if piece == "?":
                mark = "?"
        else:
            tokens.append(Token(piece.rstrip("'") or piece, mark if tokens else ""))
            mark = ""
    tokens = _heard_as_number(_heard_as_of(tokens))
    if len(tokens) > MAX_TOKENS:
        tokens, shortened = tokens[-MAX_TOKENS:], True
    return Typed(tuple(tokens), mark, shortened)
