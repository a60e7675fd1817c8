"""Parsing: a text becomes readings, sequences of acts in which every word is accounted for.

    text -> sentences -> lattices of words -> leaves of the lexicon -> charts -> units -> acts

Each sentence is read by itself; the readings of all sentences are combined.

Conventions on which other modules rely:

- A macro action contains its side ("exit-left" for a turn to the left, "change-right" for a lane
  change), and `Event.side` is None then; other actions keep the side.
- `Wanted` stands in an event or proposition for what a relative clause or question leaves open:
  "the car that cut in" is doing `Event("cut-in", actor=Wanted())`.
- "at the junction" is a time, `Relative("during", Junction())`; "behind the lorry" stands in
  `Event.where`.
- A verb without a sense is `Event("do", object=Unknown(word))`, and its word is unknown.
- Where nothing was understood, `acts` is empty and every content word is unknown.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice, product
from math import inf

from msgspec import structs

from xavi_dialogue.domain.meaning import Act, Ask, Beyond, Reading
from xavi_dialogue.nlu.compose.acts import NOTHING
from xavi_dialogue.nlu.demands import blames, startles, wants_reason
from xavi_dialogue.nlu.grammar.chart import Budget, Chart, ChartLimitError, Node, Nodes
from xavi_dialogue.nlu.grammar.lexicon import Leaf, leaves, lexicon, without_skips
from xavi_dialogue.nlu.grammar.rules import grammar
from xavi_dialogue.nlu.grammar.subjects import marked, past
from xavi_dialogue.nlu.joining.alternatives import chosen_between
from xavi_dialogue.nlu.joining.demanding import blaming, demanding, may_startle
from xavi_dialogue.nlu.joining.meanwhile import at_same_time, in_its_world
from xavi_dialogue.nlu.joining.outcomes import struck_by
from xavi_dialogue.nlu.joining.sentences import (
    MAX_READINGS,
    SPREAD,
    appended,
    joined,
    sentences,
    unlike,
)
from xavi_dialogue.nlu.joining.topics import fold
from xavi_dialogue.nlu.joining.trips import of_the_way
from xavi_dialogue.nlu.screen import on_screen
from xavi_dialogue.nlu.segments import CLAUSES, RARE, Path, segment
from xavi_dialogue.nlu.shares import shares_of, unknown_shares, unread_of, words_in
from xavi_dialogue.nlu.text.languages import is_foreign
from xavi_dialogue.nlu.text.lattice import HEARD, Lattice, build
from xavi_dialogue.nlu.text.tokens import Typed, tokenise
from xavi_dialogue.nlu.units import ALTERNATIVES, Row, Units
from xavi_dialogue.nlu.unread import OPENERS, unreadable

MAX_STEPS = 6_500  # for a sentence
MOST_STEPS = 9_000  # for a text
SPARED = 600  # steps that are reserved for each sentence that follows
CACHED = 512
LONGEST_TAG = 5  # [tokens]
LONG = 18  # [tokens] minimum length of a text that may be a story with a question at its end
REACH = 24  # [tokens] maximum length of that question
TRIES = 4
FEW = 0.2  # greatest share of unknown words with which a long text counts as understood
DEAR = 1.5  # greatest cost per act with which a long text counts as understood
FOREIGN = 0.5  # cost of taking a text for another language
LOOSE = 1.5  # cost of a topic that no clause takes up
PASSED = 0.25  # cost of words that are unknown
STORY = 1.0  # cost of a story before the question
EASY = 0.42  # cost of an act up to which a reading is taken as it is
EASY_ALONE = 0.62  # the same of an act that is the only one
GAIN = 0.3  # what a reading by ear must be cheaper by than one that leaves words unread ...
GAIN_OF_WHOLE = 0.8  # ... and than one that leaves none
UNSAID = 0.15  # cost of a subject that is left out
ENOUGH = 2  # readings, with which those that cost much more are not looked for
NEAR = 0.5


class Parser:
    """Reads texts."""

    def __init__(self) -> None:
        grammar()
        lexicon()

    def read(self, text: str) -> tuple[Reading, ...]:
        """Return the readings of a text, likeliest first; never empty."""
        return _read(text)


@lru_cache(maxsize=CACHED)
def _read(text: str) -> tuple[Reading, ...]:
    typed = tokenise(text)
    if not typed.tokens:
        return (Reading((), ()),)
    tokens = tuple(token.text for token in typed.tokens)
    if is_foreign(tokens, lexicon().vocabulary):
        act = Beyond("non-english", " ".join(tokens))
        return (Reading((act,), unknown_shares(tokens), FOREIGN),)
    budget = Budget(MOST_STEPS)
    rows: list[tuple[Reading, ...]] = []
    parts = sentences(typed)
    before: Typed | None = None
    ends: list[str] = []
    for index, sentence in enumerate(parts):
        budget.reserve = max(SPARED * (len(parts) - 1 - index), budget.steps - MAX_STEPS)
        if before is not None and before.end != "?" and _is_tag(sentence):
            before = appended(before, sentence)
            rows[-1] = _sentence(before, budget)
        else:
            before = sentence
            rows.append(_of_several(sentence, rows, len(parts), budget))
            ends.append("")
        ends[-1] = before.end
    return joined(rows, ends)


def _of_several(
    typed: Typed, rows: Sequence[tuple[Reading, ...]], count: int, budget: Budget
) -> tuple[Reading, ...]:
    """Read a sentence of a text; what a bare demand is of stands in another one."""
    found = _sentence(typed, budget)
    if blames(typed.tokens):
        found = tuple(map(blaming, found))
    bare = count > 1 and wants_reason(typed)
    if bare or (rows and startles(typed) and may_startle(rows[-1][0])):
        return (demanding(typed), *found)
    return found


def _is_tag(typed: Typed) -> bool:
    """Check whether a sentence is a tag of the sentence before: "isn't it?", "right?"."""
    if len(typed.tokens) > LONGEST_TAG:
        return False
    known = lexicon()
    lattice = build(typed, known.vocabulary, known.nouns)
    found = leaves(lattice)
    whole = [leaf for leaf in found[0].get("TAGWORD", ()) if leaf.end == lattice.size]
    if whole or len(typed.tokens) == 1:
        return bool(whole) and typed.end == "?"
    return lattice.size in Chart(grammar(), found, Budget(LONGEST_TAG * 100)).read("tag", 0)


def _sentence(typed: Typed, budget: Budget) -> tuple[Reading, ...]:
    """Return the readings of one sentence, likeliest first; never empty."""
    other = struck_by(typed) or on_screen(typed)
    if other is not None:
        return (other,)
    stated = marked(typed)
    told = () if stated is None else _as_typed(typed, stated, _whole(stated, budget))
    found = told or _whole(typed, budget)
    stated = None if _plain(found[0]) else past(typed)
    if stated is None:
        return found
    told = _as_typed(typed, stated, _whole(stated, budget))
    return told if told and told[0].cost < found[0].cost else found


def _as_typed(typed: Typed, stated: Typed, found: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """Return the readings of a sentence that was given its subject, without those words' shares."""
    more = len(stated.tokens) - len(typed.tokens)
    pairs = enumerate(zip(typed.tokens, stated.tokens, strict=False))
    at = next(k for k, (one, other) in pairs if one.text != other.text)
    return tuple(
        structs.replace(
            one, shares=(*one.shares[:at], *one.shares[at + more :]), cost=one.cost + UNSAID
        )
        for one in found
        if one.acts and not one.unknown
    )


def _whole(typed: Typed, budget: Budget) -> tuple[Reading, ...]:
    """Return the readings of one sentence as it stands, likeliest first; never empty."""
    known = lexicon()
    lattice = build(typed, known.vocabulary, known.nouns)
    readings = _understood(lattice, budget)
    if len(typed.tokens) > LONG and not _asks(readings):
        readings = _ending(typed, budget) or readings
    if not readings or not _plain(readings[0]):
        readings = _by_ear(typed, lattice, readings, budget) + readings
    if not readings:
        return (unreadable(typed),)
    return tuple(readings)


def _understood(lattice: Lattice, budget: Budget, limit: float = inf) -> list[Reading]:
    """Read a lattice strictly; if that costs much, also skip words and try rarer units.

    Args:
        lattice: the words.
        budget: the remaining steps.
        limit: cost from which a reading is of no use.
    """
    found = leaves(lattice)
    readings: list[Reading] = []
    nodes: Nodes = {}
    units = Units(lattice, budget)
    try:
        strict = Chart(grammar(), without_skips(found), budget, nodes)
        paths = segment(strict, lattice, found, CLAUSES)
        readings = _readings(paths, lattice, units, limit)
        if not readings or not _plain(readings[0]):
            loose = Chart(grammar(), found, budget, nodes)
            paths = segment(loose, lattice, found, CLAUSES + RARE)
            others = _readings(paths, lattice, units, limit)
            readings = unlike([*readings, *others])
    except ChartLimitError:
        pass
    return readings


def _by_ear(typed: Typed, lattice: Lattice, plain: list[Reading], budget: Budget) -> list[Reading]:
    """Read a sentence as it sounds; the result has to be complete, and much cheaper.

    Args:
        typed: the sentence.
        lattice: its words as they were typed.
        plain: the readings of those words.
        budget: the remaining steps.
    """
    limit = NOTHING
    if plain:
        limit = plain[0].cost - (GAIN if plain[0].unknown or plain[0].unread else GAIN_OF_WHOLE)
    known = lexicon()
    heard = build(typed, known.vocabulary, known.nouns, by_ear=True)
    if limit <= HEARD or heard.edges == lattice.edges:
        return []  # nothing by ear can be cheap enough, or no word sounds like another
    found = _understood(heard, budget, limit)
    return [r for r in found[:1] if r.acts and not r.unknown and not r.unread and r.cost < limit]


def _asks(readings: list[Reading]) -> bool:
    """Check whether most of a text was understood."""
    if not readings or not readings[0].acts:
        return False
    best = readings[0]
    cheap = best.cost <= DEAR * len(best.acts)
    return cheap and len(best.unknown) <= FEW * len(best.shares)


def _ending(typed: Typed, budget: Budget) -> list[Reading]:
    """Read the end of a long story by itself; the text before it stays unread."""
    tokens = typed.tokens
    starts = [
        index for index, token in enumerate(tokens)
        if index and index >= len(tokens) - REACH and (token.mark or token.text in OPENERS)
    ]  # fmt: skip
    known = lexicon()
    for start in starts[:TRIES]:
        rest = Typed(tokens[start:], typed.end)
        lattice = build(rest, known.vocabulary, known.nouns)
        found = [reading for reading in _understood(lattice, budget) if reading.acts]
        if found and isinstance(found[0].acts[-1], Ask) and not found[0].unknown:
            before = unreadable(Typed(tokens[:start]))
            return [
                Reading(r.acts, (*before.shares, *r.shares), r.cost + STORY,
                        (*before.unread, *r.unread))
                for r in found
            ]  # fmt: skip
    return []


def _plain(reading: Reading) -> bool:
    """Check whether a reading is so cheap that rarer kinds of units need not be tried."""
    count = len(reading.acts)
    limit = EASY_ALONE if count == 1 else EASY * count
    return bool(count) and not reading.unknown and reading.cost <= limit


def _readings(
    paths: list[Path], lattice: Lattice, units: Units, limit: float
) -> list[Reading]:  # fmt: skip
    found: list[_Draft] = []
    best = inf
    for path in paths:
        most = min(best + (SPREAD if len(found) < ENOUGH else NEAR), limit)
        if path.cost > most:
            break
        try:
            if path.cost + sum(map(units.least, path.units)) > most:
                continue
            drafts = _along(path, units)
        except ChartLimitError:
            break
        found += drafts
        best = min(best, *(draft.cost for draft in drafts))
    found.sort(key=lambda draft: draft.cost)
    kept: list[_Draft] = []
    for draft in found:
        if best + SPREAD < draft.cost or len(kept) == MAX_READINGS:
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
    idle: tuple[Leaf, ...]
    ignored: tuple[Node, ...]

    def reading(self, lattice: Lattice) -> Reading:
        """Account for the words."""
        shares = shares_of(self.units, list(self.owners), self.unknown, lattice, self.idle)
        unread = unread_of(self.units, list(self.owners), shares)
        cost = max(0.0, self.cost - lattice.misspelling)
        passed = tuple(words_in(clause, lattice) for clause in self.ignored)
        return Reading(self.acts, shares, round(cost, 3), unread, ignored=passed)


def _along(path: Path, units: Units) -> list[_Draft]:
    """Compose the units of a path; return a draft for each combination of their readings."""
    choices: list[list[Row]] = []
    unknown: list[Leaf] = []
    for unit in path.units:
        alternatives, left = units.read(unit)
        unknown += left
        choices.append(alternatives)
    found: list[_Draft] = []
    for combination in islice(product(*choices), ALTERNATIVES * 2):
        owners: list[int | None] = []
        acts: list[Act] = []
        pairs = [(acts, extra) for acts, extra, *_ in combination]
        without = [*unknown, *(leaf for _, _, leaves, *_ in combination for leaf in leaves)]
        idle_ = tuple(leaf for *_, leaves, _ in combination for leaf in leaves)
        passed = tuple(clause for *_, clauses in combination for clause in clauses)
        rows = at_same_time(path.units, chosen_between(path.units, pairs))
        for row in of_the_way(path.units, in_its_world(path.units, rows)):
            owners.append(len(acts) - (row is None) if row or row is None else None)
            acts.extend(row or ())
        named = sum(unit.name == "topic" for unit in path.units)
        loose = named - len(acts) if named else 0
        acts, owners = fold(acts, owners)
        loose = max(loose + len(acts), 0) if named else 0  # topics that no unit takes up
        cost = path.cost + sum(extra for _, extra in pairs) + LOOSE * loose
        cost += PASSED * bool(unknown)
        read = (path.units, tuple(owners), tuple(without), idle_, passed)
        found.append(_Draft(tuple(acts), cost, *read))
    return found
