"""Malformed: what a text lacks that the grammar cannot read, found by example.

`grammars/malformed.toml` holds texts that lack something. Lark compares the state in which its
parser stopped on the text with those in which it stops on the examples
(`UnexpectedInput.match_examples`).
"""

from functools import cache

import lark
from lark.exceptions import UnexpectedToken

from xavi_dialogue.language.grammar import STARTS, Tree, beginning, grammar, shift
from xavi_dialogue.language.lattice import Lattice, build
from xavi_dialogue.language.normalise import normalise
from xavi_dialogue.language.tokens import AUXILIARIES, Token, merged
from xavi_dialogue.language.wordlists import load
from xavi_dialogue.language.words import hear

FILE = "malformed.toml"


def lacking(lattice: Lattice) -> str | None:
    """What a text lacks, as a key of malformed.toml; None where it stops like no example."""
    stopped = _stopped(lattice)
    if stopped is None:
        return None
    found: str | None = stopped.match_examples(_raise_for, load(FILE), use_accepts=False)
    return found


def _raise_for(text: str) -> Tree:
    """Parse an example as lark expects it: it raises where the text stops the parser."""
    error = _example(text)
    if error is not None:
        raise error
    return lark.Tree("whole", [])


@cache
def _example(text: str) -> UnexpectedToken | None:
    words = hear(normalise(text), frozenset(range(6))).words
    return _stopped(build(words))


def _stopped(lattice: Lattice) -> UnexpectedToken | None:
    """Where the start rule that gets furthest with the likeliest cut stops."""
    tokens = _tokens(lattice)
    depths = {rule: _depth(rule, tokens) for rule in STARTS}
    rule = max(STARTS, key=lambda r: depths[r])
    if depths[rule] == 0:
        return None
    parser = grammar().parse_interactive(start=rule)
    try:
        for token in tokens:
            parser.feed_token(lark.Token(token.terminal, token.value))
        parser.feed_eof()  # type: ignore[no-untyped-call]
    except UnexpectedToken as error:
        return error
    return None


def _tokens(lattice: Lattice) -> list[Token]:
    """What the grammar is to read: no noise, neighbouring auxiliaries as one."""
    tokens: list[Token] = []
    for _, edge in lattice.main():
        if edge.is_noise:
            continue
        if tokens and {tokens[-1].terminal, edge.token.terminal} <= AUXILIARIES:
            tokens[-1] = merged(tokens[-1], edge.token)
        else:
            tokens.append(edge.token)
    return tokens


def _depth(rule: str, tokens: list[Token]) -> int:
    """How many tokens a start rule takes before it stops."""
    stack = beginning(rule)
    for depth, token in enumerate(tokens):
        following = shift(stack, token.terminal)
        if following is None:
            return depth
        stack = following
    return len(tokens)
