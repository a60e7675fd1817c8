"""Completion of words with the Tab key."""

from collections.abc import Callable, Iterable, Iterator

from prompt_toolkit.completion import CompleteEvent, Completer, Completion
from prompt_toolkit.document import Document


class Words(Completer):
    """A completer of the last words of the line to words of the live scene."""

    def __init__(self, words: Callable[[], tuple[str, ...]]) -> None:
        self._words = words

    def get_completions(self, document: Document, _: CompleteEvent) -> Iterable[Completion]:
        """See Completer."""
        line = document.text_before_cursor.lstrip()
        for word in self._words():
            for typed in _tails(line):
                if word.lower().startswith(typed.lower()) and word.lower() != typed.lower():
                    yield Completion(word, start_position=-len(typed))
                    break


def _tails(line: str) -> Iterator[str]:
    """Yield the last words of the line, from all of them to one."""
    words = line.split(" ")
    for first in range(len(words)):
        tail = " ".join(words[first:])
        if tail:
            yield tail
