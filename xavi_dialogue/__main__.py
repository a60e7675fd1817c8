"""The command line `xavi`.

Commands import what they need when they run, so that the small ones start fast.
"""

import contextlib
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer
from typer.core import TyperGroup

from xavi_dialogue.cli.commands import (
    audit,
    chat,
    dashboard,
    doctor,
    keys,
    record,
    report,
    serve,
    sessions,
    traces,
)
from xavi_dialogue.cli.commands import inspect as looking
from xavi_dialogue.cli.commands.common import Streams, to_json
from xavi_dialogue.process.exit_status import ExitStatus
from xavi_dialogue.process.kernel_cache import find_place
from xavi_dialogue.process.termination import end_on_signals


class _Commands(TyperGroup):
    """The commands; an error in a value from the file of settings names its place there."""

    def invoke(self, context: Any) -> Any:
        try:
            return super().invoke(context)
        except typer.BadParameter as error:
            _place(context, error)
            raise


def _place(context: Any, error: typer.BadParameter) -> None:
    """Add the place where a value was set to an error, if a file of settings set it."""
    from xavi_dialogue.process import config as settings

    command, parameter = error.ctx, error.param
    if command is None or parameter is None or parameter.name is None:
        return
    source = command.get_parameter_source(parameter.name)
    if source is not None and source.name == "DEFAULT_MAP":
        option = max(parameter.opts, key=len)
        path = context.params.get("config") or settings.default_path()
        where = settings.place_in(path, option.removeprefix("--"), str(command.info_name))
        error.param_hint = f"'{option}' in {where}"


app = typer.Typer(
    name="xavi",
    cls=_Commands,
    help="A car that drives in SUMO and answers its passengers.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        _write(f"xavi {version('xavi-dialogue')}")
        raise typer.Exit


@app.callback()
def _options(
    context: typer.Context,
    config: Annotated[
        Path | None,
        typer.Option(
            envvar="XAVI_CONFIG",
            metavar="FILE",
            help="File of settings (TOML). Default: the user's, if there is one.",
        ),
    ] = None,
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    from xavi_dialogue.process.config import SettingsError

    with _errors():
        try:
            context.default_map = _settings(context, config)
        except SettingsError as error:
            if context.invoked_subcommand != "doctor":
                raise
            context.obj = error  # it continues, and reports this among its findings


def _settings(context: typer.Context, given: Path | None) -> dict[str, Any]:
    """Return the options that the file of settings sets, if there is one."""
    from xavi_dialogue.process import config as settings

    path = settings.default_path() if given is None else given
    if given is None and not path.exists():
        return {}
    commands = context.command.commands  # type: ignore[attr-defined]
    return settings.read(path, {name: _long_options(one) for name, one in commands.items()})


def _long_options(command: Any) -> dict[str, str]:
    """Return the options of a command that a file may set, by name, with their parameters."""
    return {
        option.removeprefix("--"): str(parameter.name)
        for parameter in command.params
        if not getattr(parameter, "hidden", False)
        for option in parameter.opts
        if option.startswith("--") and option != "--help"
    }


def _add_benchmarks() -> None:
    """Add the commands that only a checkout has."""
    top = Path(__file__).parents[1]
    if not (top / "pyproject.toml").exists():
        return
    if str(top) not in sys.path:
        sys.path.append(str(top))
    from benchmarks.commands import commands
    from benchmarks.reproduce.command import command as reproduce

    if TYPE_CHECKING:
        from benchmarks.figures import Measure

    def measured(measure: "Measure", as_json: bool) -> None:
        with _errors():
            found = measure(_note)
        _write(to_json(found) if as_json else found.table())

    app.add_typer(commands(measured), name="bench")
    app.command("reproduce")(reproduce(measured))


_add_benchmarks()


@contextlib.contextmanager
def _errors() -> Iterator[None]:
    """Report errors in one line and exit with a status; internal errors pass unchanged."""
    try:
        yield
    except Exception as error:
        from xavi_dialogue.cli.errors import failure

        known = failure(error)
        if known is None:
            raise
        _note(known.message)
        raise typer.Exit(known.status) from None


def _lines() -> Iterator[str]:
    """Yield lines of standard input, even if they have invalid bytes."""
    sys.stdin.reconfigure(encoding="utf-8", errors="replace")  # type: ignore[union-attr]
    yield from iter(sys.stdin.readline, "")


def _write(text: str) -> None:
    print(text, flush=True)


def _note(text: str) -> None:
    line = f"xavi: {text}"
    if sys.stderr.isatty():
        from shutil import get_terminal_size

        from xavi_dialogue.terminal.slash_commands import wrapper

        line = wrapper(get_terminal_size().columns).fill(line)
    print(f"{line}\n", end="", file=sys.stderr, flush=True)  # one write, so that it stays whole


def _warn(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: object = None,
    line: str | None = None,
) -> None:
    """Tell a warning to the user in one line; those to programmers stay as they are."""
    if issubclass(category, UserWarning) and category.__module__ == "builtins":
        from xavi_dialogue.bus.sanitize import one_line

        _note(f"warning: {one_line(str(message))}")
    else:
        sys.stderr.write(warnings.formatwarning(message, category, filename, lineno, line))


SHELL = Streams(_errors, _write, _note, _lines)
ROOMS = (chat, dashboard, serve, record, report, looking, traces, audit, sessions, keys, doctor)
for room in ROOMS:
    room.add(app, SHELL)


def main() -> NoReturn:
    """Run the command line; signals end it like an exception, so that resources are released."""
    end_on_signals()
    find_place()
    warnings.showwarning = _warn
    app()
    sys.exit(ExitStatus.ANSWERED)


if __name__ == "__main__":
    main()
