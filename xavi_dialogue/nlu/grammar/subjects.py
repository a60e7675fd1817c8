"""Subjects: the one that a sentence leaves out, as in "didn't even slow down", "nearly hit him".

Typed remarks often begin with the verb. What one sees or knows is said of oneself, other things of
the car, and what is in the third person of the vehicle that is spoken of.
"""

from typing import Final

from xavi_dialogue.nlu.grammar.lexicon import lexicon
from xavi_dialogue.nlu.text.tokens import Token, Typed

#: Negated auxiliaries without their apostrophe, and whose they are.
NEGATED: Final = {
    "didnt": "you", "hadnt": "you", "havent": "you", "couldnt": "you", "wouldnt": "you",
    "cant": "you", "cannot": "you", "wont": "you", "hasnt": "it", "wasnt": "it", "isnt": "it",
    "doesnt": "it",
}  # fmt: skip
OPENERS: Final = frozenset(
    ("and", "but", "so", "oh", "ooh", "wow", "woah", "whoa", "ok", "okay", "well", "still", "yeah",
     "blimey", "bloody", "omg", "hey", "hm", "hmm", "god", "jesus", "christ", "ha", "again")
)  # fmt: skip
ADVERBS: Final = frozenset(
    ("even", "really", "quite", "ever", "exactly", "just", "actually", "properly", "fully", "only")
)  # fmt: skip
NEARLY: Final = frozenset(("nearly", "almost", "barely", "practically"))
#: Verbs of what passengers perceive or think themselves.
PERCEIVING: Final = frozenset(
    ("see", "saw", "hear", "heard", "tell", "feel", "felt", "know", "knew", "understand", "believe",
     "notice", "noticed", "think", "thought", "remember", "get")
)  # fmt: skip
#: Words that begin what is asked or said of us as a whole: "stuck at red?", "going to make it?".
OURS: Final = {
    "stuck": ("we", "are"), "gonna": ("are", "we"), "gunna": ("are", "we"),
    "going to": ("are", "we"),
}  # fmt: skip
#: Verbs of what we are asked to think: "reckon he'll stop?".
THINKING: Final = frozenset(("reckon", "think"))
FINITE: Final = frozenset(("VPAST",))
AMBIGUOUS: Final = frozenset(("V", "SIDE", "KIND", "EVN", "ADJ", "P", "BEARING"))
AUXILIARIES: Final = frozenset(("did", "had", "was", "were"))
NOUNS: Final = frozenset(("ABS", "MEAS", "KIND", "EVN"))
VERBS: Final = frozenset(("V", "VPAST", "VED", "VING"))


def marked(typed: Typed) -> Typed | None:
    """Return a statement that lacks its subject, as its first words show, with that subject.

    It begins with a negated auxiliary ("didn't stop"), or with "nearly" and a verb in the past.
    None if it does not, or if its subject follows: "didn't you stop".
    """
    words = _words(typed)
    verb = _past(words, (first := _past(words, 0, OPENERS)), NEARLY)
    ours = OURS.get(words[first]) if first < len(words) - 1 else None
    ours = ours or OURS.get(" ".join(words[first : first + 2]))
    if typed.end == "?" and words[first : first + 1] and words[first] in THINKING:
        ours = ("do", "you")
    if ours is not None and len(words) > first + 2:
        return _with(typed, first, *ours)
    if first < verb < len(words) - 1 and _is(words[verb], FINITE):
        return _with(typed, first, "you")
    at = _past(words, 0, OPENERS)
    end = at + 1
    if words[at : at + 2] == ["did", "not"]:
        owner, end = "you", at + 2
    else:
        owner = NEGATED.get(words[at], "") if at < len(words) else ""
    verb = _past(words, end, ADVERBS)
    if not owner or typed.end == "?" or verb >= len(words) or not _is(words[verb], VERBS):
        return None
    return _with(typed, at, "i" if owner == "you" and words[verb] in PERCEIVING else owner)


def past(typed: Typed) -> Typed | None:
    """Return a statement that begins with a verb in the past, with its subject; else None."""
    words = _words(typed)
    at = _past(words, 0, OPENERS)
    verb = _past(words, at, ADVERBS)
    if verb >= len(words) - 1 or not _is(words[verb], FINITE):
        return None
    if _is(words[verb], AMBIGUOUS) or words[verb] in AUXILIARIES:
        return None  # "hit the brakes" is a request, "left again" names a turn, "did it" asks
    if _names(words[verb], words[verb + 1]):
        return None  # "predicted path of vehicle 1?" is a noun
    if words[verb : verb + 2] == ["felt", "like"]:
        return _with(typed, at, "it")  # "felt like we nearly hit him" is of us, and no feeling
    return _with(typed, at, "i" if words[verb] in PERCEIVING else "you")


def _words(typed: Typed) -> list[str]:
    return [token.text.replace("'", "") for token in typed.tokens]


def _past(words: list[str], at: int, passed: frozenset[str]) -> int:
    while at < len(words) and words[at] in passed:
        at += 1
    return at


def _is(word: str, categories: frozenset[str]) -> bool:
    known = lexicon().trie.following.get(word)
    return known is not None and any(e.category in categories for e in known.entries)


def _names(word: str, later: str) -> bool:
    """Check whether two words are a noun together."""
    known = lexicon().trie.following.get(word)
    both = None if known is None else known.following.get(later)
    return both is not None and any(e.category in NOUNS for e in both.entries)


def _with(typed: Typed, at: int, *said: str) -> Typed:
    first = typed.tokens[at]
    rest = (Token(first.text), *typed.tokens[at + 1 :])
    unsaid = (Token(said[0], first.mark), *map(Token, said[1:]))
    return Typed((*typed.tokens[:at], *unsaid, *rest), typed.end)
