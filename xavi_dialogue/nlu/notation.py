"""Notation: readings in one line, for developers and tests."""

import msgspec

from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.meaning import Act, Reading
from xavi_dialogue.domain.terms import Unsaid


def compact(value: object) -> str:
    """Write a term as a call; leave out fields that have their default."""
    if isinstance(value, Value):
        fields = msgspec.structs.fields(type(value))
        parts: list[str] = []
        positional = True
        for field in fields:
            inner = getattr(value, field.name)
            default = field.default if field.default is not msgspec.NODEFAULT else None
            if field.default is not msgspec.NODEFAULT and inner == default:
                positional = False
                continue
            if isinstance(inner, Unsaid):
                positional = False
                continue
            text = compact(inner)
            parts.append(text if positional else f"{field.name}={text}")
        name = type(value).__name__
        return f"{name}({', '.join(parts)})" if parts else name
    if isinstance(value, tuple):
        return "[" + ", ".join(compact(item) for item in value) + "]"
    if isinstance(value, float) and value == int(value):
        return str(int(value))
    return str(value)


def acts_line(acts: tuple[Act, ...]) -> str:
    """Write a sequence of acts in one line."""
    return "; ".join(compact(act) for act in acts) or "-"


def reading_line(reading: Reading) -> str:
    """Write a reading in one line: cost, acts, unknown words."""
    unknown = f"  ?{' '.join(reading.unknown)}" if reading.unknown else ""
    return f"{reading.cost:.2f}  {acts_line(reading.acts)}{unknown}"
