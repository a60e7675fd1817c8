"""The commands `xavi sessions` and `xavi forget`; what they need is imported when they run."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from xavi_dialogue.cli.commands.common import AsJson, StoreFile, Streams

if TYPE_CHECKING:
    from xavi_dialogue.storage.turn_log import Retention

Command: TypeAlias = Callable[..., None]


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the commands."""
    app.command("sessions")(_sessions(shell))
    app.command("forget")(_forget(shell))


def keeping_in(store: Path | None, days: int) -> "Retention | None":
    """Return where and how long turns are stored, if at all."""
    from xavi_dialogue.storage.turn_log import Retention

    return Retention(store_file(store), days) if days else None


def store_file(given: Path | None) -> Path:
    """Return the given file, else the user's default."""
    from xavi_dialogue.storage.turn_log import default_path

    return default_path() if given is None else given


def _sessions(shell: Streams) -> Command:
    def sessions(
        session: Annotated[
            str | None, typer.Argument(help="Conversation to print. Default: a list of all.")
        ] = None,
        export: Annotated[
            bool, typer.Option("--export", help="Print all stored data as lines of JSON.")
        ] = False,
        as_json: AsJson = False,
        store: StoreFile = None,
    ) -> None:
        """List the conversations that are kept, or print them."""
        from datetime import datetime

        import msgspec

        from xavi_dialogue.cli import session_admin

        with shell.errors():
            if export:
                for line in session_admin.export(store_file(store), session):
                    shell.write(line)
                return
            found = session_admin.kept(store_file(store), session)
            if as_json:
                shell.write(msgspec.json.encode(found).decode())
            else:
                shell.write(
                    session_admin.table(found, lambda at: datetime.fromtimestamp(at).astimezone())
                )

    return sessions


def _forget(shell: Streams) -> Command:
    def forget(
        session: Annotated[str | None, typer.Argument(help="Which to forget.")] = None,
        everything: Annotated[bool, typer.Option("--all", help="Forget all.")] = False,
        older_than: Annotated[
            float | None, typer.Option(min=0.0, metavar="DAYS", help="Only older conversations.")
        ] = None,
        yes: Annotated[bool, typer.Option("--yes", help="Do not ask.")] = False,
        store: StoreFile = None,
    ) -> None:
        """Erase conversations from the disk."""
        import time

        from xavi_dialogue.cli import session_admin

        with shell.errors():
            wanted = session_admin.ForgetOptions(session, everything, older_than)
            agreed = _agreed if not yes else lambda _: True
            shell.write(
                session_admin.forget(store_file(store), wanted, time.time(), agreed, _Typed())
            )

    return forget


def typed_file() -> Path:
    """Return the file of typed lines, for the arrow keys."""
    from platformdirs import user_state_path

    return user_state_path("xavi-dialogue") / "history"


class _Typed:
    """The file of typed lines; importing its reader takes a quarter of a second."""

    def sessions(self) -> frozenset[str]:
        """See InputHistoryFile."""
        if not typed_file().exists():
            return frozenset()
        from xavi_dialogue.storage import input_history

        return input_history.sessions(typed_file())

    def erase(self, session: str | None, before: float | None) -> None:
        """See InputHistoryFile."""
        if not typed_file().exists():
            return
        from datetime import datetime

        from xavi_dialogue.storage import input_history

        moment = None if before is None else datetime.fromtimestamp(max(before, 0.0))
        input_history.erase(typed_file(), session, moment)


def _agreed(question: str) -> bool:
    """Ask the user to confirm.

    Raises:
        UsageFault: there is no terminal to ask at.
    """
    from xavi_dialogue.process.exit_status import UsageFault

    if not sys.stdin.isatty():
        raise UsageFault("without a terminal, confirm with --yes")
    return typer.prompt(f"{question} y/n", err=True).strip().lower() in {"y", "yes"}
