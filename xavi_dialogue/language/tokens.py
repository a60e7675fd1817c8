"""Tokens: what words and phrases stand for in the grammar.

Lark never sees characters: words are found before, so a word can only match as a whole.
"""

from dataclasses import dataclass

from xavi_dialogue.language.phrases import Sense

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


def merged(one: Token, other: Token) -> Token:
    """Neighbouring auxiliaries as one token, named after the first."""
    return Token(one.terminal, f"{one.value} {other.value}", f"{one.text} {other.text}", other.form)
