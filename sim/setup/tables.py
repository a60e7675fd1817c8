"""Tables of a TOML file, read key by key with strict types.

The only error is TableError.
"""

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from sim.errors import SimError


class TableError(SimError):
    """A configuration file is wrong: file, key, problem, remedy."""

    def __init__(self, file: Path, key: str | None, problem: str, remedy: str) -> None:
        self.file, self.key, self.problem, self.remedy = file, key, problem, remedy
        where = f"{file}: {key}" if key else str(file)
        super().__init__(f"{where}: {problem}; {remedy}")


@dataclass(frozen=True, slots=True)
class Table:
    """A table of the TOML file, read key by key with strict types."""

    file: Path
    prefix: str  # of its keys in error messages
    values: Mapping[str, object]

    def wrong(self, key: str, problem: str, remedy: str) -> TableError:
        return TableError(self.file, self.prefix + key, problem, remedy)

    def only(self, known: tuple[str, ...]) -> None:
        for key in self.values:
            if key not in known:
                raise self.wrong(key, "unknown key", f"remove it; known are {', '.join(known)}")

    def value(self, key: str, what: str) -> object:
        if key not in self.values:
            raise self.wrong(key, "missing", f"add it: {what}")
        return self.values[key]

    def text(self, key: str) -> str:
        value = self.value(key, "a text")
        if not isinstance(value, str) or not value.strip():
            raise self.wrong(key, f"{value!r} is not text", "write it in quotes")
        return value

    def number(
        self,
        key: str,
        *,
        default: float | None = None,
        least: float = 0.0,
        most: float = math.inf,
    ) -> float:
        value = default if default is not None and key not in self.values else None
        if value is None:
            value = self.check(key, self.value(key, "a number"))
        if not least <= value <= most:
            limits = f"at least {least:g}" + ("" if math.isinf(most) else f", at most {most:g}")
            raise self.wrong(key, f"{value:g} is out of range", f"it must be {limits}")
        return value

    def check(self, key: str, value: object) -> float:
        """Return a value as a finite number.

        Raises:
            TableError: it is none.
        """
        if isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value):
            return float(value)
        raise self.wrong(key, f"{value!r} is not a number", "write a finite number, unquoted")

    def integer(self, key: str, *, default: int | None = None, most: int = 2**31 - 1) -> int:
        value = self.values.get(key, default)
        if value is None:
            value = self.value(key, "a whole number")
        if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value <= most:
            remedy = f"write a whole number from 0 to {most}"
            raise self.wrong(key, f"{value!r} is not a whole number in range", remedy)
        return value

    def path(self, key: str, folder: Path) -> Path:
        path = folder / self.text(key)
        if not path.is_file():
            raise self.wrong(key, f"there is no file {path}", "put it there or correct the name")
        return path

    def table(self, key: str, *, required: bool = False) -> "Table":
        value = self.value(key, f"a table [{key}]") if required else self.values.get(key, {})
        if not isinstance(value, dict):
            raise self.wrong(key, f"{value!r} is not a table", f"write it as [{key}]")
        return Table(self.file, f"{self.prefix}{key}.", value)


def read_toml(file: Path) -> Table:
    """Return the top table of a TOML file.

    Raises:
        TableError: the file cannot be read, or is not TOML.
    """
    try:
        return Table(file, "", tomllib.loads(file.read_text(encoding="utf-8")))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise TableError(file, None, f"not TOML: {error}", "correct the syntax there") from error
    except OSError as error:
        raise TableError(file, None, str(error.strerror), "make it readable") from error
