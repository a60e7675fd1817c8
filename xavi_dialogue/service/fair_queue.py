"""A fair queue: clients take turns, no matter how many items each of them adds."""

from collections import deque
from dataclasses import dataclass, field
from typing import Generic, TypeVar

Item = TypeVar("Item")


@dataclass
class FairQueue(Generic[Item]):
    """Items by client: clients take turns, and the items of one client keep their order.

    >>> queue = FairQueue[str]()
    >>> for who, item in (("ann", "a1"), ("ann", "a2"), ("bob", "b1")):
    ...     queue.put(who, item)
    >>> [queue.pop() for _ in range(len(queue))]
    ['a1', 'b1', 'a2']
    """

    _waiting: dict[str, deque[Item]] = field(default_factory=dict)  # next turn first
    _size: int = 0

    def put(self, who: str, item: Item) -> None:
        """Add an item."""
        self._waiting.setdefault(who, deque()).append(item)
        self._size += 1

    def pop(self) -> Item:
        """Remove the next item and return it.

        Raises:
            LookupError: the queue is empty.
        """
        if not self._waiting:
            raise LookupError("the queue is empty")
        who = next(iter(self._waiting))
        items = self._waiting.pop(who)
        item = items.popleft()
        if items:
            self._waiting[who] = items
        self._size -= 1
        return item

    def clear(self) -> None:
        """Empty the queue."""
        self._waiting.clear()
        self._size = 0

    def __len__(self) -> int:
        return self._size
