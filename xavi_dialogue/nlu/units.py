"""Units: the readings of the units of one sentence, with the words that have no part in them.

What costs little is done first: a unit is composed when its least cost is asked for, and its words
are tested only when it is read.
"""

from xavi_dialogue.domain.meaning import Act
from xavi_dialogue.nlu.compose.acts import Composer
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.evidence import LOST, missing
from xavi_dialogue.nlu.grammar.chart import Budget, Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf
from xavi_dialogue.nlu.honesty import is_dear, well_typed
from xavi_dialogue.nlu.idle import idle
from xavi_dialogue.nlu.ignored import PASSED_OVER, asks_nothing, changes, ignored
from xavi_dialogue.nlu.plausible import oddity
from xavi_dialogue.nlu.shares import is_unknown
from xavi_dialogue.nlu.text.lattice import Lattice
from xavi_dialogue.nlu.unread import unread_cost

ALTERNATIVES = 3  # greatest number of readings of a unit
DROPPED = 1.2  # cost of a clause after "and" that no act was made from
IDLE = 0.03  # cost of a word that makes no difference to the acts
_TESTED = 4  # readings, the cheapest, whose words are tested

#: Acts, their cost, words without a part in them, words that make no difference, clauses.
Row = tuple[tuple[Act, ...], float, tuple[Leaf, ...], tuple[Leaf, ...], tuple[Node, ...]]
#: Acts, their cost without that of words, informative words that are not in them.
_Draft = tuple[tuple[Act, ...], float, tuple[Leaf, ...]]


class Units:
    """Reads the units of one sentence, each of them once."""

    def __init__(self, lattice: Lattice, budget: Budget) -> None:
        self._lattice = lattice
        self._budget = budget
        self._drafts: dict[int, tuple[list[_Draft], list[Leaf], bool]] = {}
        self._rows: dict[int, list[Row]] = {}

    def read(self, unit: Node) -> tuple[list[Row], list[Leaf]]:
        """Give the readings of a unit, cheapest first, and its words without a sense."""
        drafts, unknown, strange = self._composed(unit)
        if id(unit) not in self._rows:
            rows = [] if strange else self._tested(unit, drafts)
            self._rows[id(unit)] = rows or [((), _unread(unit), (), (), ())]
        return self._rows[id(unit)], unknown

    def least(self, unit: Node) -> float:
        """Give the cost below which no reading of a unit can be."""
        drafts, *_ = self._composed(unit)
        return min([_unread(unit), *map(_cost, drafts)])

    def _composed(self, unit: Node) -> tuple[list[_Draft], list[Leaf], bool]:
        """Compose a unit; say also whether it has words without a sense and no others."""
        if id(unit) not in self._drafts:
            composer = Composer(self._budget, self._mark(unit))
            read = composer.compose(unit)
            notes = composer.notes
            lost = DROPPED * sum(id(c) not in notes.taken for c in notes.chained)
            lost += sum(max(0.0, cost) for cost in notes.inner.values())
            drafts = [(acts, cost + lost + sum(map(oddity, acts)), missing(unit, acts))
                      for acts, cost in read]  # fmt: skip
            drafts.sort(key=_cost)
            strange = is_unknown(unit, notes.unknown)
            self._drafts[id(unit)] = (drafts[:_TESTED], notes.unknown, strange)
        return self._drafts[id(unit)]

    def _tested(self, unit: Node, drafts: list[_Draft]) -> list[Row]:
        """Test the words of drafts that do not cost too much to be answered anyway."""
        mark = self._mark(unit)
        good = [draft for draft in drafts if not is_dear(unit, draft[1])]
        words = iter(idle(unit, [acts for acts, *_ in good], mark))
        rows = []
        for draft in drafts:
            acts, cost, lacking = draft
            core, beside = next(words) if draft in good else ((), ())
            leaves = tuple(dict.fromkeys((*lacking, *core)))
            rows.append((acts, cost + LOST * len(leaves) + IDLE * len(beside), leaves, beside))
        rows.sort(key=lambda entry: entry[1])
        found = [_row(unit, *row, mark) for row in rows[:ALTERNATIVES]]
        return sorted(found, key=lambda entry: entry[1])

    def _mark(self, unit: Node) -> str:
        lattice = self._lattice
        return lattice.end_mark if unit.end >= lattice.size else lattice.marks.get(unit.end, "")


def _cost(draft: _Draft) -> float:
    return draft[1] + LOST * len(draft[2])


def _row(
    unit: Node, acts: tuple[Act, ...], cost: float, leaves: tuple[Leaf, ...],
    idle_: tuple[Leaf, ...], mark: str,
) -> Row:  # fmt: skip
    """Leave out acts that cost too much or have no sense; list the clauses passed over."""
    row = () if is_dear(unit, cost) else well_typed(acts)
    acts, cost = row, cost if row or not acts else max(cost, _unread(unit))
    if (clauses := ignored(unit, acts, mark)) and asks_nothing(acts):
        return (), _unread(unit), leaves, (), ()
    idle_ = tuple(leaf for leaf in idle_ if not any(leaf in c.leaves for c in clauses))
    told = tuple(clause for clause in clauses if changes(clause))
    return acts, cost + PASSED_OVER * len(clauses), leaves, idle_, told


def _unread(unit: Node) -> float:
    """Say what a unit costs of which nothing is made: the more, the longer it is."""
    return unread_cost(len({token for leaf in leaves_of(unit) for token in leaf.tokens}))
