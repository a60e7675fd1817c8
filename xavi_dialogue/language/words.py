"""Words: what was typed, with its spelling corrected and its numbers read."""

from dataclasses import dataclass
from functools import cache

from xavi_dialogue.language.normalise import BREAK, Normalised, expand, is_clock
from xavi_dialogue.language.spelling import correct
from xavi_dialogue.language.wordlists import PLAIN_RANK, english, vocabulary


@dataclass(frozen=True, slots=True)
class Heard:
    """The words of a text as they are read."""

    words: tuple[str, ...]  # clause marks are BREAK
    corrections: tuple[tuple[str, str], ...] = ()  # (as typed, as read)
    tagged: bool = False  # a tag such as "didn't you?" was taken off the end


_HUNDRED = 100
_STATEMENT = 2  # words that a tag follows, at least


@cache
def _numbers() -> dict[str, int]:
    table: dict[str, int] = english()["numbers"]
    return table


@cache
def vehicle_nouns() -> frozenset[str]:
    """Nouns that a vehicle's number follows."""
    return frozenset({"vehicle", "car", "number", "truck"})


def hear(normalised: Normalised, vehicles: frozenset[int]) -> Heard:
    """Correct the spelling and read numbers; vehicles are those that "vehicle to" may name."""
    words: list[str] = []
    corrections: list[tuple[str, str]] = []
    for word in normalised.words:
        fixed = _known(word)
        if fixed != (word,):
            corrections.append((word, " ".join(fixed)))
        words.extend(fixed)
    read = _read_numbers(words, vehicles)
    begin = _tag(read)
    return Heard(tuple(read[:begin]), tuple(corrections), begin < len(read))


def _tag(words: list[str]) -> int:
    """Where a tag begins: after the last clause mark, behind a statement."""
    if words[-2:] in (["or", "what"], ["or", "not"]) and len(words) > _STATEMENT:
        return len(words) - 2
    marks = [index for index, word in enumerate(words) if word == BREAK]
    if not marks or marks[-1] < _STATEMENT or _takes_back(words[: marks[-1]]):
        return len(words)
    tags = {name: frozenset(said.split()) for name, said in english()["tags"].items()}
    match words[marks[-1] + 1 :]:
        case [word] if word in tags["words"]:
            return marks[-1]
        case [auxiliary, "not", pronoun] | [auxiliary, pronoun, "not"] | [auxiliary, pronoun] if (
            auxiliary in tags["auxiliaries"] and pronoun in tags["pronouns"]
        ):
            return marks[-1]
    return len(words)


def _takes_back(words: list[str]) -> bool:
    """Whether they end by taking something back: what stands behind "I mean, right" is no tag."""
    markers = (marker.split() for marker in english()["repairs"]["markers"])
    return any(words[-len(marker) :] == marker for marker in markers)


_SUFFIXES = ("s", "es", "ed", "d", "ing", "ly", "er", "ers", "est", "ness", "ful", "ment")


def _is_word(word: str) -> bool:
    """Whether the word, or what it is derived from, stands in a word list."""
    known = vocabulary().words
    if word in known or word in _numbers():
        return True
    stems = (word.removesuffix(suffix) for suffix in _SUFFIXES if word.endswith(suffix))
    return any(len(stem) > 3 and known.get(stem) == PLAIN_RANK for stem in stems)


def _known(word: str) -> tuple[str, ...]:
    if word == BREAK or is_number(word) or is_clock(word) or _is_word(word):
        return (word,)
    parts = tuple(part for part in word.split("-") if part)
    if len(parts) > 1:
        return tuple(fixed for part in parts for fixed in _known(part))
    return tuple(full for fixed in correct(word) or (word,) for full in expand(fixed))


def _read_numbers(words: list[str], vehicles: frozenset[int]) -> list[str]:
    """Number words after a vehicle noun or another number become digits."""
    read: list[str] = []
    homophones = english()["homophones"]
    for index, said in enumerate(words):
        word = str(int(said)) if is_number(said) else said
        before = read[-1] if read else ""
        value = _numbers().get(word)
        tens = int(before) if is_number(before) else 0
        if word == "hundred" and 0 < tens < _HUNDRED:
            read[-1] = str(tens * _HUNDRED)
        elif value is not None and (word != "one" or before in vehicle_nouns() or tens):
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


def is_number(word: str) -> bool:
    """Whether a word is written in digits, of any script that counts in tens."""
    return word.isdecimal()


def _verb_follows(words: list[str], index: int) -> bool:
    """Whether the next word can only follow a subject: "vehicle to turned left"."""
    following = words[index + 1 : index + 2]
    return bool(following) and vocabulary().forms.get(following[0]) is not None
