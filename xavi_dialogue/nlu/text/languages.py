"""Languages: whether a text is in another language than English."""

from functools import cache

from xavi_dialogue.nlu.text.spelling import Vocabulary
from xavi_dialogue.nlu.text.tables import load

_WORDS = 2  # foreign words that tell a language
_SHARE = 0.5  # of the words that must be foreign or unknown


@cache
def _function_words() -> dict[str, frozenset[str]]:
    table: dict[str, str] = load("nlu_text.toml")["languages"]
    return {name: frozenset(words.split()) for name, words in table.items()}


def is_foreign(tokens: tuple[str, ...], vocabulary: Vocabulary) -> bool:
    """Say whether the words of a text are those of another language."""
    if not tokens:
        return False
    if sum(not _latin(token) for token in tokens) * 2 > len(tokens):
        return True
    typed = load("nlu_text.toml")["phone"]  # "r", "wat"
    strange = [t for t in tokens if t not in vocabulary.words and t not in typed]
    for words in _function_words().values():
        found = [token for token in tokens if token in words]
        odd = {token for token in found if token in strange}
        either = len(set(found) | set(strange))
        if len(found) >= _WORDS and odd and either >= _SHARE * len(set(tokens)):
            return True
    return False


def _latin(token: str) -> bool:
    return all(ord(character) < 0x250 for character in token)
