"""User settings: a file that sets options of commands.

An option is taken from the command line, else from an environment variable, else from the file,
else it has its default. The file is TOML. An option at the top level is for every command that has
it, and one in a table is for the command of that name:

    vehicle = "shuttle-3"

    [serve]
    listen = "tcp/0.0.0.0:7447"
"""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias

from xavi_dialogue.process.exit_status import UsageFault

Options: TypeAlias = Mapping[str, Mapping[str, str]]  # by command: options and their parameters


class SettingsError(UsageFault):
    """A file of settings that cannot be used."""


def default_path() -> Path:
    """Return the file of this user."""
    # Imported late, since few commands need it.
    from platformdirs import user_config_path

    return user_config_path("xavi-dialogue") / "config.toml"


def read(path: Path, options: Options) -> dict[str, dict[str, Any]]:
    """Return the options that a file sets, by command and parameter.

    Args:
        path: of the file.
        options: of every command, all options by name, with their parameters.

    Raises:
        SettingsError: it cannot be read, or sets an unknown option.
    """
    try:
        said = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise SettingsError(f"the settings in {path} cannot be read: {error}") from error
    everywhere = {name: value for name, value in said.items() if not isinstance(value, dict)}
    tables = {name: value for name, value in said.items() if isinstance(value, dict)}
    for name in tables:
        if name not in options:
            raise SettingsError(
                f"{path}: [{name}] is not a command; the commands are {_listed(options)}"
            )
    known = {option for of_command in options.values() for option in of_command}
    _check(path, "", everywhere, known)
    found: dict[str, dict[str, Any]] = {}
    for command, of_command in options.items():
        _check(path, command, tables.get(command, {}), set(of_command))
        chosen = {name: value for name, value in everywhere.items() if name in of_command}
        chosen.update(tables.get(command, {}))
        found[command] = {of_command[name]: value for name, value in chosen.items()}
    return found


def place_in(path: Path, name: str, command: str) -> str:
    """Describe where a file sets an option of a command."""
    said = tomllib.loads(path.read_text(encoding="utf-8"))
    return f"{path}, [{command}]" if name in said.get(command, {}) else str(path)


def _check(path: Path, command: str, said: Mapping[str, Any], known: set[str]) -> None:
    where = f" of [{command}]" if command else ""
    for name, value in said.items():
        if name not in known:
            raise SettingsError(
                f"{path}: {name}{where} is not an option; {_nearest(name, known)}"
                f"xavi {command or 'COMMAND'} --help lists all"
            )
        if not isinstance(value, (str, int, float, list)):
            raise SettingsError(
                f"{path}: {name}{where} has to be a text, a number, true, false or a list"
            )


def _nearest(name: str, known: set[str]) -> str:
    """Return the beginning of a sentence that names the most similar option; empty if none is."""
    # Imported late, since few files have a mistake.
    from rapidfuzz.distance import OSA

    found = min(sorted(known), key=lambda one: OSA.distance(name, one))
    alike = OSA.distance(name, found) <= len(name) // 2
    return f"the nearest is {found}, and " if alike else ""


def _listed(names: set[str] | Options) -> str:
    return ", ".join(sorted(names))
