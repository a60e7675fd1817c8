"""`xavi bench recognise`: how early, and how surely, it is known where others will go.

Of every vehicle's approach to a choice of roads (see `approach`), the prediction is taken at
each tenth of the approach, from the track of at most ten seconds that the car has then seen.
Two baselines: every goal is as likely as any other; the road nearest at first, for certain.
"""

import math
from collections.abc import Callable, Sequence

import msgspec

from planner.recognise import Belief
from sim.scenario import load
from xavi_dialogue.app.bench.approach import Approach, approaches
from xavi_dialogue.app.bench.figures import Figure, figure, in_columns
from xavi_dialogue.app.bench.recording import Recording, record
from xavi_dialogue.app.bench.runs import in_processes
from xavi_dialogue.app.bench.stories import Story, tell

SCENARIOS = ("s1", "s2", "s3", "s4", "town")
TENTHS = range(1, 11)
GRID = 2  # predictions are taken at every other sample, so that vehicles share them
ALL = "all"


class Guess(msgspec.Struct, frozen=True):
    """What one method says at one tenth of one approach."""

    probability: float  # of the true road
    right: float  # 1 where the true road is the likeliest, shared where several are
    entropy: float  # of the goals, over that of their uniform distribution


class Seen(msgspec.Struct, frozen=True):
    """One tenth of one approach."""

    tenth: int
    ours: Guess
    uniform: Guess
    nearest: Guess


class Watched(msgspec.Struct, frozen=True):
    """What came of one scenario with one seed."""

    scenario: str
    seed: int
    seen: tuple[Seen, ...] = ()
    story: Story | None = None
    error: str | None = None


class Row(msgspec.Struct, frozen=True):
    """One tenth of all approaches of a scenario, in the mean."""

    scenario: str
    fraction: float  # of the approach
    n: int  # approaches
    ours: Guess
    uniform: Guess
    nearest: Guess


class RecogniseReport(msgspec.Struct, frozen=True):
    """What the benchmark found."""

    bench: str
    figures: tuple[Figure, ...]  # by how much each is known before the ego is committed
    rows: tuple[Row, ...]
    stories: tuple[Story, ...]
    failed: tuple[str, ...]

    def table(self) -> str:
        """The report for people."""
        head = ["", "seen", "n", "P(true)", "top-1", "entropy", "uniform", "nearest"]
        told = ["", "seed", "vehicle", "goal", "known", "started", "committed", "before"]
        parts = [in_columns([head, *map(_row, self.rows)])]
        if self.stories:
            parts.append(in_columns([told, *map(_story, self.stories)]))
        if self.failed:
            parts.append("\n".join(("failed:", *self.failed)))
        return "\n\n".join(parts)


def measure(
    scenarios: Sequence[str], seeds: int, jobs: int, note: Callable[[str], None]
) -> RecogniseReport:
    """Drive scenarios (names or folders) with seeds from 0 on, and watch the others.

    Args:
        scenarios: at least one.
        seeds: how many of each.
        jobs: processes side by side.
        note: is told the progress.
    """
    tasks = [(name, seed) for name in scenarios for seed in range(seeds)]
    found = []
    for one in in_processes(watch, tasks, jobs, lambda t: Watched(*t, error="its process died")):
        found.append(one)
        note(f"{len(found)} of {len(tasks)}: {one.scenario}, seed {one.seed}")
    return report(found)


def watch(task: tuple[str, int]) -> Watched:
    """Drive a scenario with a seed, and watch the others; errors are told in the result."""
    name, seed = task
    try:
        recording = record(load(name), seed)
        seen = [
            tenth
            for approach in approaches(
                recording.roads, recording.scenes, recording.settings.view_radius
            )
            for tenth in tenths(recording, approach)
        ]
        return Watched(name, seed, tuple(seen), tell(name, seed, recording))
    except Exception as error:
        return Watched(name, seed, error=f"{type(error).__name__}: {error}")


def tenths(recording: Recording, approach: Approach) -> tuple[Seen, ...]:
    """An approach, tenth by tenth."""
    roads = [goal.target.edge for goal in approach.choices if goal.target is not None]
    even = 1.0 / len(approach.choices)
    uniform = Guess(even, even, 1.0)
    hit = float(approach.nearest == approach.truth)
    nearest = Guess(hit, hit, 0.0)
    found = []
    for tenth in TENTHS:
        sample = max(approach.first, approach.sample(tenth) // GRID * GRID)
        beliefs = recording.beliefs(sample)[approach.vehicle]
        ours = guess(beliefs, approach.truth, max(len(roads) + 1, len(beliefs)))
        found.append(Seen(tenth, ours, uniform, nearest))
    return tuple(found)


def guess(beliefs: Sequence[Belief], truth: str, goals: int) -> Guess:
    """What beliefs say of the true road.

    Args:
        beliefs: of one vehicle; their probabilities sum to 1.
        truth: edge of the road that it takes.
        goals: how many goals there were to choose from, at least two.
    """
    best = max(belief.probability for belief in beliefs) - 1e-9
    likeliest = [_leads_to(belief, truth) for belief in beliefs if belief.probability >= best]
    known = sum(belief.probability for belief in beliefs if _leads_to(belief, truth))
    shares = [belief.probability for belief in beliefs if belief.probability > 0.0]
    entropy = -sum(share * math.log(share) for share in shares)
    return Guess(known, sum(likeliest) / len(likeliest), max(entropy, 0.0) / math.log(goals))


def _leads_to(belief: Belief, edge: str) -> bool:
    return belief.goal.target is not None and belief.goal.target.edge == edge


def report(watched: Sequence[Watched]) -> RecogniseReport:
    """What was watched, by scenario in the order of its first run, and over all."""
    names = list(dict.fromkeys(one.scenario for one in watched))
    rows: list[Row] = []
    for name in (*names, ALL):
        seen = [s for one in watched if name in (one.scenario, ALL) for s in one.seen]
        rows += (_mean(name, tenth, [s for s in seen if s.tenth == tenth]) for tenth in TENTHS)
    stories = [one.story for one in watched if one.story is not None]
    return RecogniseReport(
        bench="recognise",
        figures=_ahead(stories),
        rows=tuple(row for row in rows if row.n),
        stories=tuple(stories),
        failed=tuple(
            f"{one.error}\n    xavi drive --scenario {one.scenario} --seed {one.seed}"
            for one in watched
            if one.error is not None
        ),
    )


def _ahead(stories: Sequence[Story]) -> tuple[Figure, ...]:
    found: dict[str, list[float]] = {}
    for story in stories:
        if story.known is not None and story.committed is not None:
            found.setdefault(story.scenario, []).append(story.committed - story.known)
    return tuple(figure(f"{name} known ahead", "s", ahead) for name, ahead in found.items())


def _mean(name: str, tenth: int, seen: Sequence[Seen]) -> Row:
    methods = ([s.ours for s in seen], [s.uniform for s in seen], [s.nearest for s in seen])
    return Row(name, tenth / 10.0, len(seen), *(_average(guesses) for guesses in methods))


def _average(guesses: Sequence[Guess]) -> Guess:
    count = max(len(guesses), 1)
    sums = (
        sum(g.probability for g in guesses),
        sum(g.right for g in guesses),
        sum(g.entropy for g in guesses),
    )
    return Guess(*(round(total / count, 4) for total in sums))


def _row(row: Row) -> list[str]:
    ours = row.ours
    mine = (ours.probability, ours.right, ours.entropy)
    theirs = (row.uniform.probability, row.nearest.probability)
    shown = [f"{value:.3f}" for value in (*mine, *theirs)]
    return [row.scenario, f"{row.fraction:.1f}", str(row.n), *shown]


def _story(story: Story) -> list[str]:
    times = (story.known, story.started, story.committed)
    shown = ["never" if time is None else f"{time:.1f} s" for time in times]
    who = [story.scenario, str(story.seed), str(story.vehicle), story.kind]
    return [*who, *shown, "yes" if story.before else "no"]
