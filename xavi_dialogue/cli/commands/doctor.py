"""The command `xavi doctor`: finds problems and says how to solve them."""

import sys
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

import typer

from xavi_dialogue.cli.commands.common import (
    AsJson,
    Connect,
    StoreFile,
    Streams,
    ZenohFile,
    to_json,
)
from xavi_dialogue.cli.commands.sessions import store_file
from xavi_dialogue.process.exit_status import ExitStatus

if TYPE_CHECKING:
    from xavi_dialogue.cli.host_checks import Finding


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the command."""
    app.command("doctor")(_doctor(shell))


def _doctor(shell: Streams) -> Callable[..., None]:
    def doctor(
        context: typer.Context,
        connect: Connect = None,
        zenoh: ZenohFile = None,
        store: StoreFile = None,
        as_json: AsJson = False,
    ) -> None:
        """Find problems of this machine or of a bus; say how to solve them."""
        from datetime import UTC, datetime

        from xavi_dialogue.bus.link import Link
        from xavi_dialogue.cli.bus_checks import examine, told
        from xavi_dialogue.cli.host_checks import CheckedSystem
        from xavi_dialogue.process import config

        with shell.errors():
            mistake = context.obj  # errors in the settings, see __main__
            given = (context.parent or context).params.get("config")
            patient = CheckedSystem(
                store=store_file(store),
                settings=given or config.default_path(),
                mistake=None if mistake is None else str(mistake),
            )
            link = Link.to_hub(connect, zenoh) if connect or zenoh else None
            findings: list[Finding] = []
            if as_json:
                findings.extend(examine(patient, link, datetime.now(UTC)))
                shell.write(to_json(findings))
            else:
                for line in told(_kept(examine(patient, link, datetime.now(UTC)), findings)):
                    shell.write(_printable(line))
        if any(finding.verdict == "fault" for finding in findings):
            raise typer.Exit(ExitStatus.FAILED)

    return doctor


def _printable(text: str) -> str:
    """Convert a text to the encoding of standard output, which may be the problem."""
    encoding = sys.stdout.encoding or "ascii"
    return text.encode(encoding, errors="backslashreplace").decode(encoding)


def _kept(coming: "Iterable[Finding]", findings: "list[Finding]") -> "Iterator[Finding]":
    """Yield each finding as soon as it is known, and collect it in a list."""
    for finding in coming:
        findings.append(finding)
        yield finding
