"""Run seeds of the simulated world; a seed that fails is run again, shrunk, and shown."""

import argparse
import sys
import time
from pathlib import Path

from tests.simulated.many import outcomes
from tests.simulated.plan import Plan, plan_of
from tests.simulated.shrink import shrink
from tests.simulated.world import Outcome, run

SHOWN = 600  # characters of a problem


def main() -> int:
    """Run the command; 0 where all seeds hold."""
    asked = _parser().parse_args()
    if asked.seed is not None:
        return _show(plan_of(asked.seed))
    began, exempt = time.monotonic(), 0
    done = _done(asked.done)
    failed = [seed for seed, held in done.items() if not held]
    wanted = range(asked.begin, asked.begin + asked.seeds)
    seeds = [seed for seed in wanted if seed not in done]
    if len(seeds) < len(wanted):
        _say(f"{len(wanted) - len(seeds)} seeds were run before, {len(failed)} failed")
    for number, (seed, outcome) in enumerate(outcomes(seeds, asked.jobs), 1):
        exempt += bool(outcome.exempt)
        if outcome.problems:
            failed.append(seed)
            _say(f"seed {seed} fails: {outcome.problems[0][:SHOWN]}")
        _note(asked.done, seed, held=not outcome.problems)
        if number % 500 == 0:
            _say(f"{number} seeds, {len(failed)} failed, {time.monotonic() - began:.0f} s")
    _say(
        f"{len(seeds)} seeds in {time.monotonic() - began:.0f} s: {len(failed)} failed;"
        f" in {exempt} something was lost that may be lost"
    )
    for seed in failed[:3]:
        _show(plan_of(seed))
    return 1 if failed else 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.simulated", description=__doc__)
    add = parser.add_argument
    add("--seeds", type=int, default=1000, help="how many are run")
    add("--begin", type=int, default=0, help="the first of them")
    add("--jobs", type=int, default=2, help="processes that run them")
    add("--done", type=Path, metavar="FILE", help="notes what was run; that is not run again")
    add("--seed", type=int, help="run this one alone, and shrink it if it fails")
    return parser


def _done(file: Path | None) -> dict[int, bool]:
    """Return the seeds that were run before, and whether all held."""
    if file is None or not file.exists():
        return {}
    lines = file.read_text(encoding="ascii").split("\n")[:-1]
    return {int(seed): held == "held" for seed, held in map(str.split, lines)}


def _note(file: Path | None, seed: int, *, held: bool) -> None:
    if file is not None:
        with file.open("a", encoding="ascii") as written:
            written.write(f"{seed} {'held' if held else 'failed'}\n")


def _show(plan: Plan) -> int:
    """Run one plan, and show it, or the shortest one that fails likewise."""
    outcome = run(plan)
    if not outcome.problems:
        _say(_told(plan, outcome))
        return 0
    again = run(plan)
    if again.digest != outcome.digest:
        _say(f"seed {plan.seed} does not replay: {outcome.digest}, then {again.digest}")
    shorter, outcome = shrink(plan, run)
    _say(f"shrunk from {len(plan.faults)} to {len(shorter.faults)} faults:")
    _say(_told(shorter, outcome))
    return 1


def _told(plan: Plan, outcome: Outcome) -> str:
    figures = ", ".join(f"{value:.0f} {name}" for name, value in outcome.figures.items())
    lines = [f"seed {plan.seed}, story {plan.story}: {figures}; digest {outcome.digest}"]
    lines += [f"  {fault}" for fault in plan.faults] or ["  nothing goes wrong"]
    lines += [f"  ! {problem}" for problem in outcome.problems]
    return "\n".join(lines)


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
