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
from lark.parsers.lalr_analysis import Shift
from lark.parsers.lalr_interactive_parser import InteractiveParser

from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.tokens import Token
from xavi_dialogue.language.wordlists import vocabulary

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
_END = "$END"
_MAX_ENDS = 3  # parses kept of one rule from one beginning: the longest

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
    terminals = vocabulary().terminals
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


def parses(rule: str, tokens: tuple[Token, ...], begin: int, ends: frozenset[int]) -> list[Parse]:
    """All parses by one start rule from `begin` to one of `ends` or to the end of the tokens."""
    skip = costs().skip
    limit = costs().limits.cost
    parser = grammar().parse_interactive(start=rule)
    fed: list[lark.Token] = []
    found: list[tuple[int, int, float]] = []  # (end, tokens fed, cost)
    cost = 0.0
    for position in range(begin, len(tokens)):
        if position in ends and fed and _fits(parser, _END):
            found.append((position, len(fed), cost))
        token = tokens[position]
        shifted = _shift(parser, token, position)
        if shifted is not None:
            fed.append(shifted)
            continue
        price = min((skip[t] for t in token.terminals if t in skip), default=None)
        if price is None or cost + price > limit:
            break
        cost += price
    else:
        if fed and _fits(parser, _END):
            found.append((len(tokens), len(fed), cost))
    return [
        Parse(rule, _tree(rule, fed[:count]), begin, end, price)
        for end, count, price in found[-_MAX_ENDS:]
    ]


def _shift(parser: InteractiveParser, token: Token, position: int) -> lark.Token | None:
    """Shift the token in the first sense that fits; None, and no change, where none does."""
    for terminal, value in token.senses:
        if _fits(parser, terminal):
            shifted = lark.Token(terminal, value, start_pos=position)
            parser.feed_token(shifted)
            return shifted
    return None


def _fits(parser: InteractiveParser, terminal: str) -> bool:
    """Whether the terminal can be shifted, after the reductions it calls for.

    `InteractiveParser.accepts` says the same of every terminal at once, at a hundred times the
    price; feeding a copy is no way either, as copies share the lists that lark appends to.
    """
    state = parser.parser_state
    end = state.parse_conf.end_state
    table = state.parse_conf.states
    stack = list(state.state_stack)
    while not (terminal == _END and stack[-1] == end):
        entry = table[stack[-1]].get(terminal)
        if entry is None:
            return False
        action, argument = entry
        if action is Shift:
            return True
        if argument.expansion:
            del stack[-len(argument.expansion) :]
        stack.append(table[stack[-1]][argument.origin.name][1])
    return True


def _tree(rule: str, fed: list[lark.Token]) -> Tree:
    """The tree of tokens that are known to be a sentence of the rule."""
    parser = grammar().parse_interactive(start=rule)
    for token in fed:
        parser.feed_token(token)
    tree: Tree = parser.feed_eof()  # type: ignore[no-untyped-call]
    return tree
