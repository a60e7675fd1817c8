"""Parse: a text becomes readings, each a row of acts in which every word is accounted for.

    text -> tokens -> lattice of words -> leaves of the lexicon -> chart -> units -> acts

Conventions that others rely on:

- A macro action holds its side ("exit-left" for a turn to the left, "change-right" for a lane
  change), and `Event.side` is None then; other actions keep the side.
- What a relative clause or a question leaves open is `Wanted` in the event or proposition:
  "the car that cut in" is doing `Event("cut-in", actor=Wanted())`.
- "at the junction" is a time, `Relative("during", Junction())`; "behind the lorry" stands in
  `Event.where`.
- A verb without a sense is `Event("do", object=Unknown(word))`, and its word is unknown.
- Where nothing was understood, `acts` is empty and every content word is unknown.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import islice, product

from xavi_dialogue.domain.meaning import Act, Ask, Beyond, Reading, TokenShare
from xavi_dialogue.nlu.compose.acts import NOTHING, Composer
from xavi_dialogue.nlu.grammar.chart import Budget, Chart, ChartLimitError, Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf, leaves, lexicon, without_skips
from xavi_dialogue.nlu.grammar.rules import grammar
from xavi_dialogue.nlu.honesty import is_dear
from xavi_dialogue.nlu.plausible import oddity
from xavi_dialogue.nlu.segments import CLAUSES, RARE, Path, segment
from xavi_dialogue.nlu.shares import is_unknown, shares_of, unknown_shares
from xavi_dialogue.nlu.text.languages import is_foreign
from xavi_dialogue.nlu.text.lattice import Lattice, build
from xavi_dialogue.nlu.text.tokens import Typed, tokenise
from xavi_dialogue.nlu.topics import fold

MAX_READINGS = 6
MAX_STEPS = 6_500
CACHED = 512
LONG = 18  # [tokens] from which on a text may be a story with a question at its end
REACH = 24  # [tokens] how long that question may be
TRIES = 4
FEW = 0.2  # share of unknown words with which a long text counts as understood
DEAR = 1.5  # cost of an act from which on a long text does not count as understood
FOREIGN = 0.5  # cost of taking a text for another language
STORY = 1.0  # cost of a story before the question
_OPENERS = frozenset(
    ["so", "but", "why", "what", "how", "can", "could", "would", "tell", "explain", "when"]
)
EASY = 0.42  # cost of an act up to which a reading is taken as it is
_SPREAD = 1.5  # readings that cost this much more than the best are not offered
_ALTERNATIVES = 3

Composed = tuple[list[tuple[tuple[Act, ...], float]], list[Leaf]]


class Parser:
    """Reads texts."""

    def __init__(self) -> None:
        grammar()
        lexicon()

    def read(self, text: str) -> tuple[Reading, ...]:
        """Give the readings of a text, likeliest first; at least one, whatever the text."""
        return _read(text)


@lru_cache(maxsize=CACHED)
def _read(text: str) -> tuple[Reading, ...]:
    typed = tokenise(text)
    if not typed.tokens:
        return (Reading((), ()),)
    known = lexicon()
    lattice = build(typed, known.vocabulary, known.nouns)
    if is_foreign(lattice.tokens, known.vocabulary):
        act = Beyond("non-english", " ".join(lattice.tokens))
        return (Reading((act,), unknown_shares(lattice), FOREIGN),)
    budget = Budget(MAX_STEPS)
    readings = _understood(lattice, budget)
    if len(typed.tokens) > LONG and not _asks(readings):
        readings = _ending(typed, budget) or readings
    if not readings:
        return (Reading((), unknown_shares(lattice), NOTHING * len(typed.tokens)),)
    return tuple(readings)


def _understood(lattice: Lattice, budget: Budget) -> list[Reading]:
    """Read a lattice: first strictly, then words are read past and rarer units are tried."""
    found = leaves(lattice)
    readings: list[Reading] = []
    try:
        strict = Chart(grammar(), without_skips(found), budget)
        readings = _readings(segment(strict, lattice, found, CLAUSES), lattice, budget)
        if not readings or not _plain(readings[0]):
            loose = Chart(grammar(), found, budget)
            others = _readings(segment(loose, lattice, found, CLAUSES + RARE), lattice, budget)
            readings = others or readings
    except ChartLimitError:
        pass
    return readings


def _asks(readings: list[Reading]) -> bool:
    """Say whether most of a text was understood."""
    if not readings or not readings[0].acts:
        return False
    best = readings[0]
    cheap = best.cost <= DEAR * len(best.acts)
    return cheap and len(best.unknown) <= FEW * len(best.shares)


def _ending(typed: Typed, budget: Budget) -> list[Reading]:
    """Read the end of a long story by itself; what leads up to it is not understood."""
    tokens = typed.tokens
    starts = [
        index for index, token in enumerate(tokens)
        if index >= len(tokens) - REACH and (token.mark or token.text in _OPENERS)
    ]  # fmt: skip
    known = lexicon()
    for start in starts[:TRIES]:
        rest = Typed(tokens[start:], typed.end)
        lattice = build(rest, known.vocabulary, known.nouns)
        found = [reading for reading in _understood(lattice, budget) if reading.acts]
        if found and isinstance(found[0].acts[-1], Ask) and not found[0].unknown:
            before = tuple(TokenShare(t.text, t.text, "unknown") for t in tokens[:start])
            return [Reading(r.acts, (*before, *r.shares), r.cost + STORY) for r in found]
    return []


def _plain(reading: Reading) -> bool:
    """Say whether a reading is so cheap that rarer kinds of units need not be tried."""
    return bool(reading.acts) and not reading.unknown and reading.cost <= EASY * len(reading.acts)


def _readings(paths: list[Path], lattice: Lattice, budget: Budget) -> list[Reading]:
    composed: dict[int, Composed] = {}
    found: list[_Draft] = []
    best = float("inf")
    for path in paths:
        if path.cost > best + _SPREAD:
            break
        try:
            drafts = _along(path, lattice, composed, budget)
        except ChartLimitError:
            break
        found += drafts
        best = min(best, *(draft.cost for draft in drafts))
    found.sort(key=lambda draft: draft.cost)
    kept: list[_Draft] = []
    for draft in found:
        if best + _SPREAD < draft.cost or len(kept) == MAX_READINGS:
            break
        if all(draft.acts != other.acts for other in kept):
            kept.append(draft)
    return [draft.reading(lattice) for draft in kept]


@dataclass(frozen=True, slots=True)
class _Draft:
    """A reading whose words are not yet accounted for."""

    acts: tuple[Act, ...]
    cost: float
    units: tuple[Node, ...]
    owners: tuple[int | None, ...]
    unknown: tuple[Leaf, ...]

    def reading(self, lattice: Lattice) -> Reading:
        """Account for the words."""
        shares = shares_of(self.units, list(self.owners), list(self.unknown), lattice)
        return Reading(self.acts, shares, round(self.cost, 3))


def _along(
    path: Path, lattice: Lattice, composed: dict[int, Composed], budget: Budget
) -> list[_Draft]:
    """Compose the units of a path, in each way that they can be read."""
    choices: list[list[tuple[tuple[Act, ...], float]]] = []
    unknown: list[Leaf] = []
    for unit in path.units:
        alternatives, left = _composed(unit, lattice, composed, budget)
        unknown += left
        choices.append(alternatives[:_ALTERNATIVES])
    found: list[_Draft] = []
    for combination in islice(product(*choices), _ALTERNATIVES * 2):
        owners: list[int | None] = []
        acts: list[Act] = []
        for unit, (row, extra) in zip(path.units, combination, strict=True):
            if is_dear(unit, extra):
                row = ()
            owners.append(len(acts) if row else None)
            acts.extend(row)
        acts, owners = fold(acts, owners)
        cost = path.cost + sum(extra for _, extra in combination)
        found.append(_Draft(tuple(acts), cost, path.units, tuple(owners), tuple(unknown)))
    return found


def _composed(
    unit: Node, lattice: Lattice, composed: dict[int, Composed], budget: Budget
) -> Composed:
    key = id(unit)
    if key not in composed:
        last = unit.end >= lattice.size
        composer = Composer(budget, lattice.end_mark if last else lattice.marks.get(unit.end, ""))
        found = [(acts, cost + sum(map(oddity, acts))) for acts, cost in composer.compose(unit)]
        found.sort(key=lambda entry: entry[1])
        if not found or is_unknown(unit, composer.notes.unknown):
            found = [((), NOTHING)]
        composed[key] = (found, composer.notes.unknown)
    return composed[key]
