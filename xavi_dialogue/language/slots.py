"""Slots: what the parts of a parse tree mean: actors, actions, clauses."""

from collections.abc import Iterator
from dataclasses import dataclass

import lark

from xavi_dialogue.explain.query import QueryAction
from xavi_dialogue.language.grammar import Tree
from xavi_dialogue.language.tokens import AUXILIARIES

ANAPHOR = "that"  # stands for the actions of an earlier turn, until these are known
STRAIGHT = "straight"  # "go straight", until it is known whether a junction comes first
STRAIGHT_ON = "straight-on"  # "carry straight on": continue, unless a junction is named

TOWARDS = "towards-"  # "right" alone: a lane change beside lane changes, else a turn

#: Which word says most about a vehicle, most first.
_DESCRIBING = ("RELATED", "NUMBER", "COLOUR", "PLACE", "ONLEFT", "ONRIGHT", "KIND", "OTHER", "THAT")
_PRONOUNS = {
    "EGO": "ego",
    "ME": "ego",
    "IT": "vehicle:it",
    "BOTH": "vehicle:both",
    "WHICHCAR": "vehicle:unknown",
}
_SIDES = {"LEFT": "left", "RIGHT": "right", "ONLEFT": "left", "ONRIGHT": "right"}


@dataclass(frozen=True, slots=True)
class Clause:
    """Who does what, in one part of a question."""

    role: str  # the grammar rule: said, denied, contrast, ...
    actor: str | None
    actions: tuple[str, ...]  # query actions, ANAPHOR or STRAIGHT
    underspecified: str | None  # what was left open: "direction", or which "manoeuvre"
    span: tuple[int, int]  # positions of its first and last token


def tokens_in(tree: Tree) -> Iterator[lark.Token]:
    """The tokens of a tree, in order."""
    for child in tree.children:
        if isinstance(child, lark.Token):
            yield child
        else:
            yield from tokens_in(child)


def children(tree: Tree, rule: str) -> Iterator[Tree]:
    """The direct children that are trees of that rule."""
    return (c for c in tree.children if isinstance(c, lark.Tree) and c.data == rule)


def first(tree: Tree, rule: str) -> Tree | None:
    """The first direct child of that rule."""
    return next(children(tree, rule), None)


def terminals(tree: Tree) -> tuple[str, ...]:
    """The types of the direct tokens of a tree."""
    return tuple(c.type for c in tree.children if isinstance(c, lark.Token))


def clause(tree: Tree) -> Clause:
    """Read a clause rule: its own actor and actions, at any depth short of another actor."""
    if "PASSIVE" in terminals(tree):
        return _passive(tree)
    inner = first(tree, "bare") or tree
    listed = first(inner, "actions")
    spoken = [action(a) for a in children(listed, "action")] if listed else []
    who = first(tree, "actor") or first(tree, "number") or first(tree, "pair")
    positions = [t.start_pos for t in tokens_in(tree) if t.start_pos is not None]
    pointing = who is not None and terminals(who) == ("THAT",)
    if pointing and not set(terminals(tree)) & AUXILIARIES:
        who = None  # "the reason for that lane change"
    return Clause(
        role=tree.data,
        actor=actor(who) if who else None,
        actions=tuple(name for name, _ in spoken),
        underspecified=next((left_open for _, left_open in spoken if left_open), None),
        span=(min(positions, default=0), max(positions, default=0)),
    )


def _passive(tree: Tree) -> Clause:
    """Read "overtaken by vehicle 3": who acts comes last."""
    *_, agent = children(tree, "actor")
    (deed,) = (t for t in tree.children if isinstance(t, lark.Token) and t.type == "PASSIVE")
    positions = [t.start_pos for t in tokens_in(tree) if t.start_pos is not None]
    open_side = "direction" if str(deed) == "change" else None
    return Clause(
        role=tree.data,
        actor=actor(agent),
        actions=("change-left" if open_side else str(deed),),
        underspecified=open_side,
        span=(min(positions, default=0), max(positions, default=0)),
    )


def actor(tree: Tree) -> str:
    """Read the rule `actor`: "ego", "vehicle:3", "vehicle:front", ..."""
    by_type = {t.type: str(t) for t in tokens_in(tree)}
    if tree.data == "pair":
        return "vehicle:both"
    for terminal in _DESCRIBING:
        if terminal in by_type and not (terminal == "KIND" and by_type[terminal] == "any"):
            value = by_type[terminal]
            return "ego" if terminal == "NUMBER" and int(value) == 0 else f"vehicle:{value}"
    for terminal, name in _PRONOUNS.items():
        if terminal in by_type:
            return name
    return "ego" if by_type.get("CAR") == "car" else "vehicle:other"


def side(tree: Tree) -> str | None:
    """The direction named in an action, if any."""
    found = [_SIDES[t.type] for t in tokens_in(tree) if t.type in _SIDES]
    return found[-1] if found else None


def action(tree: Tree) -> tuple[str, str | None]:
    """Read the rule `action`: (its name, what it leaves open, if anything)."""
    (inner,) = (c for c in tree.children if isinstance(c, lark.Tree))
    kind = str(inner.data)
    where = side(inner)
    if kind == "heading":
        return (f"change-{where}" if "LANE" in terminals(inner) else f"{TOWARDS}{where}"), None
    undirected = None if where else "direction"
    if kind == "lane_change":
        return f"change-{where or 'left'}", undirected
    if kind == "turn":
        going = where is not None and "GO" in terminals(inner)  # at a junction, or to a lane
        return f"exit-{where or 'left'}", "manoeuvre" if going else undirected
    if kind == "straight":
        going_on = {"CONTINUE", "STAY"} & set(terminals(inner))
        return (STRAIGHT_ON if going_on else STRAIGHT), None
    if kind == "keep":
        return "continue", None
    if kind == "let_pass":
        return "give-way", None
    if kind == "anaphor":
        return ANAPHOR, None
    return str(next(t for t in inner.children if isinstance(t, lark.Token))), None


def settle(
    actions: tuple[str, ...], others: tuple[str, ...], at_junction: bool
) -> tuple[QueryAction, ...]:
    """Decide what "straight" is: exit-straight at a junction, continue beside a lane change."""
    settled: list[QueryAction] = []
    for index, name in enumerate(actions):
        if index and name == actions[index - 1]:
            continue  # "stuck waiting"
        if name in (STRAIGHT, STRAIGHT_ON):
            beside_change = any(o.startswith("change-") for o in others)
            beside_turn = any(o.startswith("exit-") for o in others)
            on = name == STRAIGHT_ON and not beside_turn
            name = "continue" if (beside_change or on) and not at_junction else "exit-straight"
        if name.startswith(TOWARDS):
            beside_change = any(o.startswith("change-") for o in others)
            name = name.replace(TOWARDS, "change-" if beside_change else "exit-")
        if name != ANAPHOR:
            settled.append(name)  # type: ignore[arg-type]
    return tuple(settled)
