"""Orthography: words to text. Spacing, punctuation, capitals."""

import re

_BEFORE_STOP = re.compile(r"\s+([,.;:?!])")
_WITHIN_BRACKETS = re.compile(r"(?<=\()\s+|\s+(?=\))")
_COMMAS = re.compile(r",(?:\s*,)+")
_COMMA_STOP = re.compile(r",\s*([.;:?!])")
_AN = re.compile(r"\b([Aa]) (?=(?:8\d*|11|18)\b)")  # an 8, an 11, an 80
_SENTENCE_START = re.compile(r"(^|[.?!]\s+)([a-z])")
_SENTENCE = re.compile(r"[.?!](?=\s+[A-Z0-9\"]|\s*$)")


def join(words: tuple[str, ...]) -> str:
    """Return the words as text, with single spaces, and without space before punctuation."""
    text = " ".join(" ".join(words).split())
    text = _WITHIN_BRACKETS.sub("", _BEFORE_STOP.sub(r"\1", text))
    return _AN.sub(r"\1n ", _COMMA_STOP.sub(r"\1", _COMMAS.sub(",", text)))


def capitalise(text: str) -> str:
    """Return the text with a capital at the start of every sentence."""
    return _SENTENCE_START.sub(lambda m: m[1] + m[2].upper(), text)


def count_sentences(text: str) -> int:
    """Return the number of sentences in a text, at least 1."""
    return max(1, len(_SENTENCE.findall(text)))


def sentence(text: str) -> str:
    """Return the text with a full stop at its end, unless it ends in a stop."""
    text = text.rstrip(" ,;:")
    return text if text.endswith((".", "?", "!", '."', '?"', '!"')) else f"{text}."
