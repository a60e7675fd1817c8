"""Questions of sessions that were erased: one that comes late or twice begins nothing anew."""

import hashlib
from dataclasses import dataclass, field

REMEMBERED = 30.0  # [s] after which no message is still under way
MAX_NAMES = 5000  # questions, beyond which the oldest are forgotten


@dataclass
class ErasedQuestions:
    """The latest questions by a digest, and those of them whose session was erased."""

    #: Session, and when it came [s] on the monotonic clock.
    _came: dict[bytes, tuple[str, float]] = field(default_factory=dict)
    _gone: dict[bytes, tuple[str, float]] = field(default_factory=dict)  # the same, without session

    def came(self, session: str, request: str, text: str, now: float) -> bool:
        """Take note of a question; return whether it had come before its session was erased."""
        self._drop(now)
        name = hashlib.sha256("\0".join((session, request, text)).encode()).digest()
        if name in self._gone:
            return True
        self._came.pop(name, None)
        self._came[name] = session, now
        return False

    def erase(self, session: str, now: float) -> None:
        """Leave of the questions of a session nothing but what they are known again by."""
        self._drop(now)
        for name in [name for name, (whose, _) in self._came.items() if whose == session]:
            del self._came[name]
            self._gone[name] = "", now

    def _drop(self, now: float) -> None:
        for known in (self._came, self._gone):
            while known:
                oldest = next(iter(known))
                if known[oldest][1] > now - REMEMBERED and len(known) <= MAX_NAMES:
                    break
                del known[oldest]
