"""Dashboards as processes, as their users start them."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from tests.drills.processes import Crew, Process, until

UP = re.compile(r"dashboard at (http://\S+)")
S1 = ("--scenario", "s1", "--seed", "1", "--keep-days", "0")


@dataclass(frozen=True)
class Dashboard:
    """One that is up."""

    process: Process
    address: str  # of its page; with the token, if it has one

    @property
    def port(self) -> int:
        found = re.search(r":(\d+)/", self.address)
        assert found is not None
        return int(found[1])


def dashboard(
    crew: Crew,
    *arguments: str,
    listen: str = "127.0.0.1:0",
    extra: Mapping[str, str] | None = None,
) -> Dashboard:
    """Start one, and wait until it is up."""
    process = crew.xavi("dashboard", *arguments, "--listen", listen, "--no-open", extra=extra)
    assert until(lambda: UP.search(process.said) or process.popen.poll() is not None), process.said
    told = UP.search(process.said)
    assert told is not None, process.said
    return Dashboard(process, told[1])
