"""Mutations: random changes to questions, and arbitrary texts."""

import unicodedata
from collections.abc import Callable, Sequence
from functools import cache
from random import Random

from xavi_dialogue.nlu.grammar.lexicon import lexicon

MOST_CHANGES = 4  # greatest number of changes to one text
_LIKE = dict(
    zip(
        "aceiopsxyACEHKMOPTXdhu0123l'\"-",
        "асеіорѕхуАСЕНКМОРТХԁһս０１２３ⅼ’”—",
        strict=True,
    )
)
_ODD = (
    *("\x00", "\x07", "\x1b", "\x1b[2J", "\x1b]0;title\x07", "\x9b31m", "\x7f", "\r\n", "\t"),
    *("\n", "\u200b", "\u200d", "\u202e", "\u2066", "\ufeff", "\ufffd", "\u0301", "\u0300" * 9),
    *("\u00a0", "\u2028", "\u3000", "ﬁ", "ß", "İ", "ŉ", "ǆ", "½", "²", "Ⅳ", "٣", "㎞", "❶", "👍🏽"),
    *("\ud800", "\udfff", "'", "''", "n't", "'d", "'ve", "-", "--", "...", "?!", "(", ")", '"'),
    *("\\", "%s", "{}", "<b>"),
)
_HIGHEST = 0x110000


def mutated(rng: Random, questions: Sequence[str]) -> str:
    """Return one of the questions with a few random changes."""
    text = rng.choice(questions)
    for _ in range(rng.randint(1, MOST_CHANGES)):
        text = rng.choice(_CHANGES)(rng, text, questions)
    return text


def anything(rng: Random) -> str:
    """Return random words, characters of any script, and pieces that are hard for parsers."""
    make = rng.choice((_word, _odd, _character, _word, _likely))
    mixed = rng.random() < 0.5
    makers = (_word, _odd, _character, _number)
    size = rng.choice((1, 3, 8, 20, 60, 300))
    joint = rng.choice((" ", " ", " ", "", ", ", "-", "\n"))
    count = rng.randint(1, size)
    return joint.join((rng.choice(makers) if mixed else make)(rng) for _ in range(count))


def _word(rng: Random) -> str:
    return rng.choice(_known())


@cache
def _known() -> tuple[str, ...]:
    return tuple(sorted(lexicon().vocabulary.words))


def _odd(rng: Random) -> str:
    return rng.choice(_ODD)


def _number(rng: Random) -> str:
    return str(rng.choice((rng.randrange(10), rng.randrange(10**6), 10 ** rng.randrange(80))))


def _character(rng: Random) -> str:
    return chr(rng.randrange(rng.choice((0x80, 0x250, 0x3000, _HIGHEST))))


def _likely(rng: Random) -> str:
    """Return a character that is a letter, a mark or a digit somewhere."""
    letter = chr(rng.randrange(0xD800))
    return letter if unicodedata.category(letter)[0] in "LMN" else "a"


def _cut(rng: Random, text: str, _: Sequence[str]) -> str:
    at = rng.randint(0, len(text))
    return text[:at] + text[at + rng.randint(1, 3) :]


def _insert(rng: Random, text: str, _: Sequence[str]) -> str:
    at = rng.randint(0, len(text))
    make = rng.choice((_odd, _character, _word, _number, _likely))
    return text[:at] + make(rng) + text[at:]


def _swap(rng: Random, text: str, _: Sequence[str]) -> str:
    at = rng.randint(0, max(0, len(text) - 2))
    return text[:at] + text[at : at + 2][::-1] + text[at + 2 :]


def _double(rng: Random, text: str, _: Sequence[str]) -> str:
    at, long = rng.randint(0, len(text)), rng.randint(1, 12)
    return text[:at] + text[at : at + long] * rng.randint(2, 5) + text[at + long :]


def _of_words(change: Callable[[Random, list[str]], list[str]]) -> "Change":
    def changed(rng: Random, text: str, _: Sequence[str]) -> str:
        return " ".join(change(rng, text.split(" ")))

    return changed


def _shuffled(rng: Random, words: list[str]) -> list[str]:
    one, other = rng.randrange(len(words)), rng.randrange(len(words))
    words[one], words[other] = words[other], words[one]
    return words


def _dropped(rng: Random, words: list[str]) -> list[str]:
    at = rng.randrange(len(words))
    return words[:at] + words[at + 1 :]


def _repeated(rng: Random, words: list[str]) -> list[str]:
    at = rng.randrange(len(words))
    return words[:at] + words[at : at + 1] * rng.choice((2, 2, 3, 30)) + words[at + 1 :]


def _exchanged(rng: Random, words: list[str]) -> list[str]:
    words[rng.randrange(len(words))] = _word(rng)
    return words


def _joined(rng: Random, words: list[str]) -> list[str]:
    at = rng.randrange(len(words))
    return [*words[:at], "".join(words[at : at + 2]), *words[at + 2 :]]


def _splice(rng: Random, text: str, questions: Sequence[str]) -> str:
    other = rng.choice(questions)
    joint = rng.choice(("", " ", ", ", " and ", "? ", " if ", " not "))
    return text[: rng.randint(0, len(text))] + joint + other[rng.randint(0, len(other)) :]


def _cased(rng: Random, text: str, _: Sequence[str]) -> str:
    return rng.choice((str.upper, str.title, str.swapcase, str.casefold))(text)


def _alike(rng: Random, text: str, _: Sequence[str]) -> str:
    share = rng.random()
    return "".join(_LIKE.get(c, c) if rng.random() < share else c for c in text)


def _decomposed(rng: Random, text: str, _: Sequence[str]) -> str:
    return unicodedata.normalize("NFKD", text) + rng.choice(("", "\u0301"))


Change = Callable[[Random, str, Sequence[str]], str]
_CHANGES: tuple[Change, ...] = (
    *(_cut, _insert, _insert, _swap, _double, _splice, _splice, _cased, _alike, _decomposed),
    *map(_of_words, (_shuffled, _dropped, _repeated, _exchanged, _joined)),
)
