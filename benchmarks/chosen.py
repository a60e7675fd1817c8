"""The scenarios and the number of processes for benchmarks, as chosen or by default."""

import os
from collections.abc import Callable


def there(names: list[str]) -> list[str]:
    """Return the scenarios, each of which can be loaded.

    Raises:
        ScenarioError: one cannot.
    """
    from sim.setup.scenario import load

    for name in names:
        load(name)
    return names


def ours(note: Callable[[str], None]) -> tuple[list[str], tuple[str, ...]]:
    """Return the package's scenarios, and those that cannot be driven without netconvert."""
    from sim.setup.scenario import NeedsMaps, available, load

    found, left_out = [], []
    for name in available():
        try:
            load(name)
        except NeedsMaps as error:
            note(f"leaving out {name}: {error}")
            left_out.append(name)
        else:
            found.append(name)
    return found, tuple(left_out)


def processes(asked: int | None) -> int:
    """Return the number of parallel processes; None stands for one per processor."""
    return asked or os.cpu_count() or 1
