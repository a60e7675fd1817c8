"""A queue that is fair: those who wait take turns, however much one of them wants."""

from collections import deque
from dataclasses import dataclass, field
from typing import Generic, TypeVar

Item = TypeVar("Item")


@dataclass
class FairQueue(Generic[Item]):
    """Items by who brought them: one of each in turn, and of the same in their order.

    >>> queue = FairQueue[str]()
    >>> for who, item in (("ann", "a1"), ("ann", "a2"), ("bob", "b1")):
    ...     queue.put(who, item)
    >>> [queue.pop() for _ in range(len(queue))]
    ['a1', 'b1', 'a2']
    """

    _waiting: dict[str, deque[Item]] = field(default_factory=dict)  # whose turn it is comes first
    _size: int = 0

    def put(self, who: str, item: Item) -> None:
        """Add an item."""
        self._waiting.setdefault(who, deque()).append(item)
        self._size += 1

    def pop(self) -> Item:
        """Take the next one out.

        Raises:
            LookupError: there is none.
        """
        if not self._waiting:
            raise LookupError("nobody waits")
        who = next(iter(self._waiting))
        items = self._waiting.pop(who)
        item = items.popleft()
        if items:
            self._waiting[who] = items
        self._size -= 1
        return item

    def clear(self) -> None:
        """Let nobody wait."""
        self._waiting.clear()
        self._size = 0

    def __len__(self) -> int:
        return self._size
