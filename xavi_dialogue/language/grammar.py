"""Grammar: the tables that lark makes of the question grammar, and what they accept.

The grammar is LALR(1) over whole tokens with one start rule for each query type, so that one
type is deterministic and linear, while several types can still read the same words. A stack of
the automaton is a value here: a search can go on from one in several ways.

Errors::

    GrammarFileError   a grammar file cannot be built; names the file set and lark's reason
"""

import os
from collections.abc import Iterable, Iterator
from functools import cache, lru_cache
from importlib import resources

import lark
from lark.parsers.lalr_analysis import Shift
from platformdirs import user_cache_path

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
CLAUSES = "clauses"  # reads what is said, and not what kind of question it is
_BUILTIN_TERMINALS = frozenset({"BREAK", "NUMBER", "UNKNOWN"})
_END = "$END"

Tree = lark.Tree[lark.Token]


class GrammarFileError(ValueError):
    """A grammar file cannot be built."""


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
            start=[*STARTS, CLAUSES],
            maybe_placeholders=False,
            cache=_cache(),
        )
    except lark.exceptions.LarkError as error:
        raise GrammarFileError(f"grammars/{', '.join(GRAMMAR_FILES)}: {error}") from error


def _cache() -> str | bool:
    """Where lark keeps its tables, which take a second to work out; False: nowhere.

    Lark tells by a digest whether the tables are those of this grammar, and works them out anew
    where they are not, or are damaged.
    """
    try:
        folder = user_cache_path("xavi-dialogue", ensure_exists=True)
    except OSError:
        return False
    return str(folder / "question.lark") if os.access(folder, os.W_OK) else False


class _Tokens(lark.lexer.Lexer):
    """A lexer that does nothing: tokens are fed one by one."""

    def __init__(self, _conf: object) -> None: ...

    def lex(self, *_: object) -> Iterator[lark.Token]:
        return iter(())


Stack = tuple[int, ...]


@cache
def _actions() -> dict[int, dict[str, tuple[int, int, str]]]:
    """The LALR table: by state and terminal (0, state to shift to, "") or (1, length, rule)."""
    table = grammar().parse_interactive(start=STARTS[0]).parser_state.parse_conf.states
    return {
        state: {
            terminal: (0, argument, "")
            if action is Shift
            else (1, len(argument.expansion), argument.origin.name)
            for terminal, (action, argument) in row.items()
        }
        for state, row in table.items()
    }


@cache
def beginning(rule: str) -> Stack:
    """The stack of a start rule before the first token."""
    return tuple(grammar().parse_interactive(start=rule).parser_state.state_stack)


@cache
def _end_state(rule: str) -> int:
    state = grammar().parse_interactive(start=rule).parser_state
    end: int = state.parse_conf.end_state
    return end


@lru_cache(maxsize=1 << 15)
def shift(stack: Stack, terminal: str) -> Stack | None:
    """The stack after the reductions that a terminal calls for and its shift; None: no fit."""
    actions = _actions()
    states = list(stack)
    while True:
        found = actions[states[-1]].get(terminal)
        if found is None:
            return None
        kind, argument, name = found
        if kind == 0:
            return (*states, argument)
        if argument:
            del states[-argument:]
        states.append(actions[states[-1]][name][1])


@lru_cache(maxsize=1 << 12)
def is_sentence(rule: str, stack: Stack) -> bool:
    """Whether the tokens on the stack are all of a sentence of the rule."""
    actions = _actions()
    states = list(stack)
    while states[-1] != _end_state(rule):
        found = actions[states[-1]].get(_END)
        if found is None:
            return False
        _, length, name = found
        if length:
            del states[-length:]
        states.append(actions[states[-1]][name][1])
    return True


def tree_of(rule: str, tokens: Iterable[lark.Token]) -> Tree:
    """The tree of tokens that are known to be a sentence of the rule."""
    parser = grammar().parse_interactive(start=rule)
    for token in tokens:
        parser.feed_token(token)
    tree: Tree = parser.feed_eof()  # type: ignore[no-untyped-call]
    return tree


def rules_of(tree: Tree) -> frozenset[str]:
    """All rules by which a tree was made, those that leave no node of their own in it included.

    Args:
        tree: of a start rule.
    """
    actions, rule = _actions(), str(tree.data)
    states = list(beginning(rule))
    names = set[str]()
    leaves = tree.scan_values(lambda leaf: isinstance(leaf, lark.Token))
    for terminal in (*(leaf.type for leaf in leaves), _END):
        while states[-1] != _end_state(rule):
            kind, argument, name = actions[states[-1]][terminal]
            if kind == 0:
                states.append(argument)
                break
            names.add(name)
            if argument:
                del states[-argument:]
            states.append(actions[states[-1]][name][1])
    return frozenset(names)
