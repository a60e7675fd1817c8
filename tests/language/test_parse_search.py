"""Cutting and searching: every cut is there, and none is cheaper than the one found."""

import random
from itertools import product

import pytest

from tests.language.annotated import query
from xavi_dialogue.language.beam import Budget, Prices, _Hypothesis, _steps, search
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.grammar import STARTS, beginning, is_sentence
from xavi_dialogue.language.lattice import Lattice, build

WORDS = ("why", "did", "you", "not", "turn", "left", "right", "stop", "if", "what", "vehicle", "1",
         "instead", "of", "going", "straight", "that", "lane", "and", "would", "in")  # fmt: skip


def cut(text: str) -> Lattice:
    return build(tuple(text.split()))


def cheapest(rule: str, lattice: Lattice, prices: Prices) -> float | None:
    """The lowest cost of all ways to read the whole text, each of them tried."""
    end = len(lattice.edges)
    best: list[float] = []

    def follow(position: int, now: _Hypothesis) -> None:
        if position == end:
            if now.path is not None and is_sentence(rule, now.stack):
                best.append(now.cost)
            return
        for edge in lattice.edges[position]:
            for cost, stack, path in _steps(now, edge, prices):
                if cost <= prices.limit:
                    follow(edge.end, _Hypothesis(cost, 0, stack, path))

    follow(0, _Hypothesis(0.0, 0, beginning(rule), None))
    return min(best, default=None)


def test_nothing_is_cheaper_than_what_the_beam_finds() -> None:
    draw = random.Random(5)
    prices = Prices(costs().skip, None, costs().limits.cost)
    compared = 0
    for _ in range(150):
        lattice = cut(" ".join(draw.choices(WORDS, k=draw.randint(2, 7))))
        ends = frozenset({len(lattice.edges)})
        for rule in STARTS:
            found = search(rule, lattice, 0, ends, prices, Budget(10_000))
            wanted = cheapest(rule, lattice, prices)
            assert min((f.cost for f in found), default=None) == wanted
            compared += wanted is not None
    assert compared > 40


def test_every_cut_of_a_text_is_in_its_lattice() -> None:
    lattice = cut("what is stopping you")
    cuts = {(start, e.end) for start, edges in enumerate(lattice.edges) for e in edges}
    assert {(0, 3), (0, 1), (1, 2), (2, 3), (3, 4)} <= cuts
    assert [edge.end for _, edge in lattice.main()] == [3, 4]


def test_a_vehicle_keeps_its_number() -> None:
    ends = [edge.end for _, edge in cut("what vehicle 3 did").main()]
    assert ends[0] == 1


def test_a_spent_budget_ends_the_search() -> None:
    lattice = cut("why did you stop")
    prices = Prices(costs().skip, None, costs().limits.cost)
    budget = Budget(3)
    assert search("why", lattice, 0, frozenset({4}), prices, budget) == []
    assert budget.steps == 0


@pytest.mark.parametrize("held", sorted(costs().boundary.held))
def test_what_turns_a_meaning_round_is_never_read_past(held: str) -> None:
    assert held not in costs().skip


FRAMES = (
    "{} , can you tell me?",
    "I would love to hear {}",
    "{} , please",
    "so , {}",
    "um {} then",
)
ASKED = (
    ("why you turned left", "why", "ego", ("exit-left",)),
    ("what if vehicle 2 had stopped", "what_if", "vehicle:2", ("stop",)),
    ("why the truck slowed down", "why", "vehicle:truck", ("slow-down",)),
)


@pytest.mark.parametrize(("frame", "asked"), list(product(FRAMES, ASKED)))
def test_frames_do_not_change_what_is_asked(
    frame: str, asked: tuple[str, str, str, tuple[str, ...]]
) -> None:
    text, kind, actor, actions = asked
    found = query(frame.format(text))
    assert (found.type, found.actor, found.factual or found.counterfactual) == (
        kind,
        actor,
        actions,
    )
