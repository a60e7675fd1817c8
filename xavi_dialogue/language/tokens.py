"""Tokens: words -> what they stand for in the grammar.

Lark never sees characters: words are found here, so a word can only match as a whole.
"""

from dataclasses import dataclass
from functools import cache

from xavi_dialogue.language.normalise import BREAK, Normalised
from xavi_dialogue.language.phrases import Sense
from xavi_dialogue.language.spelling import correct
from xavi_dialogue.language.wordlists import PLAIN_RANK, english, vocabulary

AUXILIARIES = frozenset({"DO", "BE", "HAVE", "WILL", "WOULD", "CAN", "COULD", "BEGIN"})


WEAK = frozenset({"PLAIN", "USER", "RUDE"})  # no second sense of a word that has a better one


@dataclass(frozen=True, slots=True)
class Token:
    """One word or phrase."""

    terminal: str  # of the grammar; NOISE is dropped, UNKNOWN is not in the vocabulary
    value: str  # what it means within its terminal: "left", "3", "off-topic"
    text: str  # the words
    form: str = ""  # of a verb: base, third, past, part, gerund
    others: tuple[Sense, ...] = ()  # what else it may stand for, likeliest first

    @property
    def senses(self) -> tuple[tuple[str, str], ...]:
        """(terminal, value) of all that it may stand for, likeliest first."""
        return ((self.terminal, self.value), *self.others)

    @property
    def terminals(self) -> tuple[str, ...]:
        """The terminals among `senses`."""
        return (self.terminal, *(sense.terminal for sense in self.others))


@dataclass(frozen=True, slots=True)
class Tokenised:
    """A text as tokens, with what had to be corrected on the way."""

    tokens: tuple[Token, ...]
    corrections: tuple[tuple[str, str], ...] = ()  # (as typed, as read)

    @property
    def heard(self) -> tuple[Token, ...]:
        """What is parsed: no noise, neighbouring auxiliaries as one token."""
        heard: list[Token] = []
        for token in self.tokens:
            if token.terminal == "NOISE" and not token.others:
                continue
            last = heard[-1] if heard else None
            if last and last.terminal in AUXILIARIES and token.terminal in AUXILIARIES:
                heard[-1] = Token(
                    last.terminal,
                    f"{last.value} {token.value}",
                    f"{last.text} {token.text}",
                    token.form,
                )
            else:
                heard.append(token)
        return tuple(heard)


@cache
def _numbers() -> dict[str, int]:
    table: dict[str, int] = english()["numbers"]
    return table


@cache
def _vehicle_nouns() -> frozenset[str]:
    return frozenset({"vehicle", "car", "number", "truck"})


def tokenise(normalised: Normalised, vehicles: frozenset[int]) -> Tokenised:
    """Correct the spelling, read numbers, and find the longest phrases from the left."""
    words: list[str] = []
    corrections: list[tuple[str, str]] = []
    for word in normalised.words:
        fixed = _known(word)
        if fixed != (word,):
            corrections.append((word, " ".join(fixed)))
        words.extend(fixed)
    return Tokenised(_tokens(tuple(_read_numbers(words, vehicles))), tuple(corrections))


_SUFFIXES = ("s", "es", "ed", "d", "ing", "ly", "er", "ers", "est", "ness", "ful", "ment")


def _is_word(word: str) -> bool:
    """Whether the word, or what it is derived from, stands in a word list."""
    known = vocabulary().words
    if word in known or word in _numbers():
        return True
    stems = (word.removesuffix(suffix) for suffix in _SUFFIXES if word.endswith(suffix))
    return any(len(stem) > 3 and known.get(stem) == PLAIN_RANK for stem in stems)


def _known(word: str) -> tuple[str, ...]:
    if word == BREAK or word.isdigit() or _is_word(word):
        return (word,)
    parts = tuple(part for part in word.split("-") if part)
    if len(parts) > 1:
        return tuple(fixed for part in parts for fixed in _known(part))
    return correct(word) or (word,)


def _read_numbers(words: list[str], vehicles: frozenset[int]) -> list[str]:
    """Number words after a vehicle noun or another number become digits."""
    read: list[str] = []
    homophones = english()["homophones"]
    for index, word in enumerate(words):
        before = read[-1] if read else ""
        value = _numbers().get(word)
        tens = int(before) if before.isdigit() else 0
        if value is not None and (word != "one" or before in _vehicle_nouns() or tens):
            if tens >= 20 and tens % 10 == 0 and value < 10:
                read[-1] = str(tens + value)
            else:
                read.append(str(value))
        elif (
            before == "vehicle" and homophones.get(word) in vehicles and _verb_follows(words, index)
        ):
            read.append(str(homophones[word]))
        else:
            read.append(word)
    return read


def _verb_follows(words: list[str], index: int) -> bool:
    """Whether the next word can only follow a subject: "vehicle to turned left"."""
    following = words[index + 1 : index + 2]
    return bool(following) and vocabulary().forms.get(following[0]) is not None


def _longest(words: tuple[str, ...], start: int) -> tuple[int, tuple[Sense, ...]] | None:
    """The longest phrase that leaves a numbered vehicle whole: "what vehicle 3 did"."""
    find = vocabulary().phrases.longest
    found = find(words, start)
    if found is None or found[0] - start < 2:
        return found
    end = found[0]
    numbered = words[end - 1] in _vehicle_nouns() and words[end : end + 1] and words[end].isdigit()
    return find(words[: end - 1], start) if numbered else found


def _tokens(words: tuple[str, ...]) -> tuple[Token, ...]:
    known = vocabulary()
    tokens: list[Token] = []
    position = 0
    while position < len(words):
        word = words[position]
        found = _longest(words, position)
        if word == BREAK:
            tokens.append(Token("BREAK", word, word))
            position += 1
        elif found is not None:
            end, (sense, *others) = found
            others = [o for o in others if o.terminal not in WEAK]
            text = words[position:end]
            form = next((known.forms[w] for w in text if w in known.forms), "")
            tokens.append(Token(*sense, " ".join(text), form, tuple(others)))
            position = end
        else:
            kind = "NUMBER" if word.isdigit() else "UNKNOWN"
            tokens.append(Token(kind, word, word))
            position += 1
    return tuple(tokens)
