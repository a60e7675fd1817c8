"""Options of commands that log: format, level, and whether to log what passengers say."""

import functools
import inspect
import sys
from collections.abc import Callable
from typing import Annotated, Any, Literal

import typer

from xavi_dialogue.cli.commands.common import Streams

Form = Annotated[
    Literal["text", "json", "off"],
    typer.Option("--log", envvar="XAVI_LOG", help="Log to standard error in this format."),
]
Level = Annotated[
    Literal["debug", "info", "warning", "error"],
    typer.Option("--log-level", envvar="XAVI_LOG_LEVEL", help="Log from this level on."),
]
Dialogue = Annotated[
    bool,
    typer.Option(
        "--log-dialogue", envvar="XAVI_LOG_DIALOGUE", help="Also log what passengers say."
    ),
]

_OPTIONS: tuple[tuple[str, Any, object], ...] = (
    ("log", Form, "text"),
    ("log_level", Level, "warning"),
    ("log_dialogue", Dialogue, False),
)


def own_name(shell: Streams) -> Callable[[dict[str, Any]], None]:
    """Return the function that sets the name of a car on the bus; see preflight.own_name."""

    def settle(given: dict[str, Any]) -> None:
        if given["zenoh"] is None:
            return
        from xavi_dialogue.bus.link import Link
        from xavi_dialogue.security.preflight import own_name

        with shell.errors():
            link = Link.to_hub(given["connect"], given["zenoh"])
            given["vehicle"] = own_name(link, given["vehicle"])

    return settle


def logged(
    component: str, settle: Callable[[dict[str, Any]], None] = lambda _: None
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Add log options to a command, and begin to log before it runs.

    Args:
        component: as which it logs: car, service, recorder, ...
        settle: completes the options before anything is logged.
    """

    def give(command: Callable[..., None]) -> Callable[..., None]:
        @functools.wraps(command)
        def run(*arguments: Any, **named: Any) -> None:
            from xavi_dialogue.process.log_setup import LogOptions, begin

            form, level, dialogue = (named.pop(name) for name, _, _ in _OPTIONS)
            settle(named)
            vehicle = named.get("vehicle")
            begin(sys.stderr, LogOptions(form, level, component, vehicle, dialogue))
            command(*arguments, **named)

        # typer reads a command's options off its signature and annotations.
        signature = inspect.signature(command, eval_str=True)
        added = [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=value, annotation=kind)
            for name, kind, value in _OPTIONS
        ]
        parameters = [*signature.parameters.values(), *added]
        run.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
        run.__annotations__ = {one.name: one.annotation for one in parameters}
        return run

    return give
