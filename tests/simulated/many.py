"""Many seeds of the simulated world, in several processes.

Processes that are started anew cannot import `__main__` of a package, hence this module.
"""

import multiprocessing
from collections.abc import Iterator, Sequence

from tests.simulated.plan import plan_of
from tests.simulated.world import Outcome, run

RUNS = 400  # of one process; crashed processes of the world may leave cycles of greenlets behind


def outcomes(seeds: Sequence[int], jobs: int) -> Iterator[tuple[int, Outcome]]:
    """Run seeds in some processes, or in this one; yield each as soon as it has ended."""
    if jobs == 1:
        yield from map(_one, seeds)
        return
    context = multiprocessing.get_context("spawn")
    with context.Pool(jobs, maxtasksperchild=RUNS) as pool:
        yield from pool.imap_unordered(_one, seeds, chunksize=5)


def _one(seed: int) -> tuple[int, Outcome]:
    return seed, run(plan_of(seed))
