"""Hostile texts, as hard to parse as the limits on input allow, in families, drawn by seed."""

from collections.abc import Callable, Sequence
from functools import cache
from itertools import accumulate, combinations_with_replacement, takewhile
from random import Random

from xavi_dialogue.nlu.grammar.lexicon import lexicon
from xavi_dialogue.nlu.text.tokens import MAX_CHARACTERS, MAX_TOKENS

#: Phrases to repeat: words of questions, conditions and negation, and words that join actions.
FRAMES = (
    *("why", "if", "not", "what if", "why not", "stop and", "turn left and", "instead of", "or"),
    *("stop and stop and not", "because", "you", "vehicle 1", "did you not", "would it be", "than"),
    *("why if", "had", "when you", "left right", "the car", "so", "without", "why did you stop"),
)
_DEEDS = ("stop", "turn left", "slow down", "change lanes", "go on", "overtake it", "give way")
_LETTERS = "abcdefghijklmnopqrstuvwxyz"
_SCRIPTS = (0x0370, 0x0400, 0x05D0, 0x0620, 0x0905, 0x3042, 0x4E00, 0xAC00, 0x1D400, 0x1F600)
_SCRIPT_WIDTH = 40  # characters taken from each script
_MARKS = ",.;:!?-()"
CLASSES = 3  # least number of word classes of an ambiguous word
PAIRS = 200  # pairs of ambiguous words that are drawn
WORDS = 300  # words that are drawn to be repeated

Family = Callable[[Random], list[str]]  # texts drawn by a generator


def families() -> dict[str, Family]:
    """Return the families by name; their texts are within the limits, and mostly reach them."""
    return {
        "frames repeated": lambda _: [repeated(frame) for frame in FRAMES],
        "each word repeated": lambda rng: [repeated(word) for word in rng.sample(known(), WORDS)],
        "ambiguous pairs": lambda rng: rng.sample(_pairs(), PAIRS),
        "coordination": _coordination,
        "random words": lambda rng: _drawn(rng, known(), 200),
        "ambiguous words": lambda rng: _drawn(rng, ambiguous(), 150),
        "joined words": _joined,
        "unknown words": _unknown,
        "long words": lambda rng: [_letters(rng, MAX_CHARACTERS) for _ in range(50)],
        "digits": lambda rng: _drawn(rng, ("1", "0", "42", "one", "vehicle", "twenty"), 150),
        "clause marks": _marks,
        "other scripts": _scripts,
    }


@cache
def known() -> tuple[str, ...]:
    """Return the words that have a sense."""
    words = lexicon().vocabulary.words
    return tuple(sorted(word for word, rank in words.items() if rank == 0))


@cache
def ambiguous() -> tuple[str, ...]:
    """Return words that stand for phrases of several word classes."""
    following = lexicon().trie.following
    found = ((w, {e.category for e in following[w].entries}) for w in known() if w in following)
    return tuple(word for word, classes in found if len(classes) >= CLASSES)


def repeated(phrase: str) -> str:
    """Return a phrase repeated up to the limits."""
    return capped(phrase.split() * MAX_TOKENS)


def capped(words: Sequence[str]) -> str:
    """Return as many of the words as the limits allow."""
    lengths = accumulate(len(word) + 1 for word in words[:MAX_TOKENS])
    return " ".join(words[: sum(1 for _ in takewhile(lambda n: n <= MAX_CHARACTERS + 1, lengths))])


def half(text: str) -> str:
    """Return the first half of a text's words, or of its characters if it is one word."""
    words = text.split()
    return " ".join(words[: len(words) // 2]) if len(words) > 1 else text[: len(text) // 2]


@cache
def _pairs() -> tuple[str, ...]:
    pairs = combinations_with_replacement(ambiguous(), 2)
    return tuple(repeated(f"{one} {other}") for one, other in pairs)


def _drawn(rng: Random, among: Sequence[str], texts: int) -> list[str]:
    return [capped([rng.choice(among) for _ in range(MAX_TOKENS)]) for _ in range(texts)]


def _coordination(rng: Random) -> list[str]:
    found = []
    for _ in range(150):
        lead = rng.choice(("why did you", "what if you", "you should", "if you", ""))
        joint = rng.choice((" and ", " or ", ", ", " and not ", " instead of ", " then "))
        said = joint.join(rng.choice(_DEEDS) for _ in range(MAX_TOKENS))
        found.append(capped(f"{lead} {said}".split()))
    return found


def _joined(rng: Random) -> list[str]:
    words = [word for word in known() if len(word) > 1]

    def joined() -> str:
        return "".join(rng.choice(words) for _ in range(rng.randint(2, 4)))

    return [capped([joined() for _ in range(MAX_TOKENS)]) for _ in range(150)]


def _letters(rng: Random, length: int) -> str:
    return "".join(rng.choice(_LETTERS) for _ in range(length))


def _unknown(rng: Random) -> list[str]:
    """Draw words of random letters; short ones may be corrected to many known words."""
    lengths = [rng.randint(3, 9) for _ in range(150)]  # at most, in a text
    return [
        capped([_letters(rng, rng.randint(1, most)) for _ in range(MAX_TOKENS)]) for most in lengths
    ]


def _marks(rng: Random) -> list[str]:
    pieces = (*_MARKS, "why", "stop", "if")
    glued = ["".join(rng.choice(pieces) for _ in range(MAX_CHARACTERS)) for _ in range(50)]
    return [text[:MAX_CHARACTERS] for text in glued] + _drawn(rng, pieces, 100)


def _scripts(rng: Random) -> list[str]:
    def word() -> str:
        first = rng.choice(_SCRIPTS)
        return "".join(chr(first + rng.randrange(_SCRIPT_WIDTH)) for _ in range(rng.randint(1, 6)))

    return [capped([word() for _ in range(MAX_TOKENS)]) for _ in range(100)]
