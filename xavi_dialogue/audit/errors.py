"""Errors of audits."""

from collections.abc import Iterator
from contextlib import contextmanager

from xavi_dialogue.process.exit_status import RunFault, UsageFault

INSTALL = "pip install 'xavi-dialogue[{extra}]', or {names}"


class AuditError(UsageFault):
    """An audit that cannot be run as it was asked for; the message says how to mend it."""


class AuditFailed(RunFault):
    """An audit that broke off; what is stored is used when it is run again."""


@contextmanager
def needing(extra: str, names: str) -> Iterator[None]:
    """Import what an extra brings, or say how to install it.

    Raises:
        AuditFailed: it is not installed.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        more = INSTALL.format(extra=extra, names=names)
        raise AuditFailed(f"this needs {error.name}, which is not installed: {more}") from error
