"""Grammar: tokens -> parse trees, reading past words that carry no meaning.

The grammar is LALR(1) over whole tokens with one start rule for each query type, so that one
type is deterministic and linear, while several types can still read the same words. Where a
token does not fit and the cost table allows it, the token is read past at its cost.

Errors::

    GrammarFileError   a grammar file cannot be built; names the file set and lark's reason
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib import resources

import lark
from lark.parsers.lalr_interactive_parser import InteractiveParser

from xavi_dialogue.language.tokens import Token
from xavi_dialogue.language.wordlists import load, vocabulary

GRAMMAR_FILES = ("question.lark", "actors.lark", "actions.lark")
STARTS = (
    "why",
    "why_not",
    "what_if",
    "what",
    "how",
    "how_avoid",
    "where_goal",
    "when",
    "confidence",
    "compare",
    "sensitivity",
    "smalltalk",
    "help",
    "command",
    "more",
    "less",
    "again",
    "replace",
    "correction",
)
_BUILTIN_TERMINALS = frozenset({"BREAK", "NUMBER", "UNKNOWN"})
_NOT_IN_GRAMMAR = frozenset({"NOISE"})

Tree = lark.Tree[lark.Token]


class GrammarFileError(ValueError):
    """A grammar file cannot be built."""


@dataclass(frozen=True, slots=True)
class Parse:
    """One way to read the tokens `begin:end` as a question."""

    rule: str  # the start rule
    tree: Tree
    begin: int
    end: int
    cost: float  # of the words read past inside it


@cache
def grammar() -> lark.Lark:
    """The question grammar, built once.

    Raises:
        GrammarFileError: lark cannot build it.
    """
    files = resources.files("grammars")
    source = [files.joinpath(name).read_text(encoding="utf-8") for name in GRAMMAR_FILES]
    terminals = {phrase.sense.terminal for phrase in vocabulary().phrases} - _NOT_IN_GRAMMAR
    declared = "%declare " + " ".join(sorted(terminals | _BUILTIN_TERMINALS))
    try:
        return lark.Lark(
            "\n".join([*source, declared]),
            parser="lalr",
            lexer=_Tokens,
            start=list(STARTS),
            maybe_placeholders=False,
        )
    except lark.exceptions.LarkError as error:
        raise GrammarFileError(f"grammars/{', '.join(GRAMMAR_FILES)}: {error}") from error


class _Tokens(lark.lexer.Lexer):
    """A lexer that does nothing: tokens are fed one by one."""

    def __init__(self, _conf: object) -> None: ...

    def lex(self, *_: object) -> Iterator[lark.Token]:
        return iter(())


@cache
def settings() -> dict[str, dict[str, float]]:
    """The cost tables of parse.toml."""
    return load("parse.toml")


def parses(rule: str, tokens: tuple[Token, ...], begin: int, ends: frozenset[int]) -> list[Parse]:
    """All parses by one start rule that begin at `begin` and end at one of `ends`."""
    skip = settings()["skip"]
    limit = settings()["limits"]["cost"]
    parser = grammar().parse_interactive(start=rule)
    found: list[Parse] = []
    cost = 0.0
    for position in range(begin, len(tokens)):
        if position in ends and position > begin:
            found.extend(_finished(rule, parser, begin, position, cost))
        token = tokens[position]
        price = skip.get(token.terminal)
        before = parser.copy(deepcopy_values=False) if price is not None else None
        try:
            parser.feed_token(lark.Token(token.terminal, token.value, start_pos=position))
        except lark.exceptions.UnexpectedToken:
            if price is None or before is None or cost + price > limit:
                return found
            parser, cost = before, cost + price
    found.extend(_finished(rule, parser, begin, len(tokens), cost))
    return found


def _finished(
    rule: str, parser: InteractiveParser, begin: int, end: int, cost: float
) -> Iterator[Parse]:
    try:
        tree = parser.copy(deepcopy_values=False).feed_eof()
    except lark.exceptions.UnexpectedToken:
        return
    yield Parse(rule, tree, begin, end, cost)
