"""Which tests run which lines, and how long each takes: measured once, with nothing broken."""

import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    import coverage

Line: TypeAlias = tuple[str, int]  # path from the top folder, and number


@dataclass
class Reach:
    """What a run of all tests showed."""

    seconds: dict[str, float] = field(default_factory=dict)  # by test, with its fixtures
    tests: dict[Line, list[str]] = field(default_factory=dict)  # that run a line
    loading: set[Line] = field(default_factory=set)  # run when modules and tests are loaded
    failed: list[str] = field(default_factory=list)

    def of(self, path: str, first: int, last: int) -> set[str]:
        """Which tests run any of these lines."""
        return {t for line in range(first, last + 1) for t in self.tests.get((path, line), ())}

    def of_module(self, path: str) -> set[str]:
        """Which tests run any line of a module's functions."""
        return {test for line, tests in self.tests.items() if line[0] == path for test in tests}

    def loads(self, path: str, first: int, last: int) -> bool:
        """Whether any of these lines is run when things are loaded."""
        return any((path, line) in self.loading for line in range(first, last + 1))


def watch(files: Iterable[str]) -> "coverage.Coverage":
    """Make what records the lines of these files that are run."""
    import coverage

    return coverage.Coverage(data_file=None, include=list(files), config_file=False)


def lines_of(seen: "coverage.Coverage", root: str) -> dict[Line, list[str]]:
    """Tell the lines that were run, each with its contexts."""
    data = seen.get_data()
    return {
        (path.removeprefix(root + "/"), line): contexts
        for path in data.measured_files()
        for line, contexts in data.contexts_by_lineno(path).items()
    }


def measure(
    tests: list[str], run: Callable[[int], bool], seen: "coverage.Coverage", root: str
) -> Reach:
    """Run all tests, each by its number, and record what each of them runs."""
    reach = Reach()
    seen.start()
    for number, test in enumerate(tests):
        seen.switch_context(test)
        begun = time.process_time()
        if not run(number):
            reach.failed.append(test)
        reach.seconds[test] = time.process_time() - begun
    seen.stop()
    reach.tests = lines_of(seen, root)
    return reach


def by_file(tests: Iterable[str]) -> dict[str, list[str]]:
    """Group tests by the file that holds them."""
    found: dict[str, list[str]] = defaultdict(list)
    for test in tests:
        found[test.partition("::")[0]].append(test)
    return found


def in_order(tests: set[str], reach: Reach) -> list[str]:
    """Put tests in the order in which they are tried: quick files first, in them quick tests."""
    files = by_file(tests)
    cost = {name: sum(reach.seconds[t] for t in files[name]) for name in files}
    return [
        test
        for name in sorted(files, key=lambda name: (cost[name], name))
        for test in sorted(files[name], key=lambda t: (reach.seconds[t], t))
    ]


def within(tests: Sequence[str], reach: Reach, fast: float, budget: float) -> list[str]:
    """Keep the tests that take at most `fast` [s] each and `budget` [s] together."""
    found, left = [], budget
    for test in tests:
        seconds = reach.seconds[test]
        if seconds <= min(fast, left):
            found.append(test)
            left -= seconds
    return found


def joined(one: Reach, other: Reach) -> Reach:
    """Put two runs of different tests together."""
    return Reach(
        one.seconds | other.seconds,
        {
            line: [*one.tests.get(line, ()), *other.tests.get(line, ())]
            for line in one.tests.keys() | other.tests.keys()
        },
        one.loading | other.loading,
        [*one.failed, *other.failed],
    )
