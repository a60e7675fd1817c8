"""The open questions about one vehicle: their order and their deadlines."""

import heapq
from dataclasses import dataclass, field

from xavi_dialogue.service.fair_queue import FairQueue
from xavi_dialogue.service.requests import Name, Question

SPENT = 200  # finished questions that may remain in the heap before it is rebuilt


@dataclass
class Scheduler:
    """Open questions, by session and request name."""

    open: dict[Name, Question] = field(default_factory=dict)  # in the order in which they came
    _sessions: dict[str, list[Question]] = field(default_factory=dict)  # the same, by session
    _turns: FairQueue[Question] = field(default_factory=FairQueue)  # those that are ready
    _deadlines: list[tuple[float, int, Question]] = field(default_factory=list)  # a heap
    _taken: int = 0

    def take(self, question: Question) -> None:
        """Add a question; it waits for the record until `let_wait`."""
        self.open[question.name] = question
        self._sessions.setdefault(question.asked.session, []).append(question)
        if len(self._deadlines) > len(self.open) + SPENT:
            self._deadlines = [one for one in self._deadlines if self.has(one[2])]
            heapq.heapify(self._deadlines)
        self._taken += 1
        heapq.heappush(self._deadlines, (question.deadline, self._taken, question))

    def remove(self, name: Name) -> Question | None:
        """Remove a question and return it; None if it is not open."""
        question = self.open.pop(name, None)
        if question is not None:
            session = question.asked.session
            self._sessions[session].remove(question)
            if not self._sessions[session]:
                del self._sessions[session]
        return question

    def has(self, question: Question) -> bool:
        """Check whether it is still open."""
        return self.open.get(question.name) is question

    def of(self, session: str) -> list[Question]:
        """Return the open questions of a session, oldest first."""
        return list(self._sessions.get(session, ()))

    def let_wait(self, question: Question) -> None:
        """Queue a question that from now on only waits for its turn."""
        question.ready = True
        self._turns.put(question.asked.session, question)

    def next_turn(self) -> Question | None:
        """Return the question whose turn is next and remove it; None if none is ready."""
        while self._turns:
            question = self._turns.pop()
            if self.has(question) and question.ready and not question.begun:
                return question
        return None

    @property
    def ready(self) -> int:
        """The number of questions that only wait for their turn."""
        return len(self._turns)

    def overdue(self, now: float) -> Question | None:
        """Return a question whose deadline has passed, each once; None if there is none.

        Args:
            now: [s] on the monotonic clock.
        """
        deadline = self.next_deadline()
        if deadline is None or deadline > now:
            return None
        return heapq.heappop(self._deadlines)[2]

    def next_deadline(self) -> float | None:
        """Return the time [s] on the monotonic clock at which the next question is given up."""
        while self._deadlines and not self.has(self._deadlines[0][2]):
            heapq.heappop(self._deadlines)
        return self._deadlines[0][0] if self._deadlines else None

    def begin_anew(self) -> None:
        """Let every question wait for the record again."""
        self._turns.clear()
        for question in self.open.values():
            question.begun = question.ready = False
