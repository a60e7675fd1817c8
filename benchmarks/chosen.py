"""What benchmarks run on: scenarios and processes, as named or all that there are."""

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
    """Return our scenarios, and those among them that cannot be driven for want of netconvert."""
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
    """Return how many processes work side by side: one per processor, where not told."""
    return asked or os.cpu_count() or 1
