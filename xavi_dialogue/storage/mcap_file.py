"""Recordings as MCAP files (https://mcap.dev/spec): the only module that knows the format.

The file is complete at any time. The latest chunk is followed by an end without an index, which
the next chunk overwrites, so a recorder that is killed leaves a file that can be opened. The index
is written when the file is closed.
"""

import os
import struct
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from types import TracebackType
from typing import IO, Any, Self

import msgspec
import zstandard
from mcap.data_stream import RecordBuilder
from mcap.exceptions import EndOfFile, McapError
from mcap.records import (
    Attachment,
    Channel,
    Chunk,
    DataEnd,
    Footer,
    Header,
    McapRecord,
    Message,
    Metadata,
)
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.writer import MCAP0_MAGIC, CompressionType, Writer

from xavi_dialogue.bus.messages import schema_name
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.storage.growing_file import create, write_at
from xavi_dialogue.storage.message_format import MessageFormat, schema_to_view
from xavi_dialogue.storage.recording_format import (
    EXPORT,
    MIB,
    PROFILE,
    AttachedFile,
    Entry,
    FileThere,
    ForViewers,
    NotARecording,
    Piece,
    Truncation,
    Unwritable,
    kind_of,
)

CHUNK = MIB  # greatest number of bytes of messages that are compressed together
MAX_RECORD = 64 * MIB  # greatest number of bytes of a part that is read, also when unpacked
MAX_CHANNELS = 1000
MAX_KEY = 512  # characters
MAX_TIME = 2**63 - 1  # [ns] greatest time that every reader accepts
MAX_SEQUENCE = 2**32 - 1
GZIP = "application/gzip"


def _ending() -> bytes:
    """Return the end of a file without an index."""
    builder = RecordBuilder()
    DataEnd(0).write(builder)
    Footer(0, 0, 0).write(builder)
    return bytes(builder.end()) + MCAP0_MAGIC  # type: ignore[no-untyped-call]


ENDING = _ending()


class _Spool(BytesIO):
    """A buffer of bytes not in the file yet; offsets count from the start of the file."""

    taken = 0

    def tell(self) -> int:
        return self.taken + super().tell()

    def take(self) -> bytes:
        """Return and remove all bytes."""
        data = self.getvalue()
        self.taken += len(data)
        self.seek(0)
        self.truncate()
        return data


class McapWriter:
    """A writer of recordings."""

    def __init__(self, path: Path, version: str, *, overwrite: bool = False) -> None:
        """Create the file; only its owner may read it.

        Args:
            path: of the file.
            version: of the program.
            overwrite: replace an existing file.

        Raises:
            FileThere: there is a file, and it must not be overwritten.
            Unwritable: the file cannot be created.
        """
        self.size = 0  # bytes of the file without its end
        self.messages = 0
        self._path = path
        try:
            self._file = create(path, overwrite)
        except FileExistsError:
            raise FileThere(f"{path} is there already; --force overwrites it") from None
        except OSError as error:
            raise Unwritable(f"cannot write {path}: {error.strerror}") from error
        self._open = True
        self._spool = _Spool()
        self._writer = Writer(self._spool, CHUNK, CompressionType.ZSTD)
        self._writer.start(PROFILE, f"xavi-dialogue {version}")
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}
        self.flush()

    def add(self, entry: Entry) -> bool:
        """Write a message; return False if there are too many keys for it.

        Raises:
            ValueError: messages of this key are not recorded.
        """
        channel = self._channels.get(entry.key)
        if channel is None:
            if len(self._channels) >= MAX_CHANNELS:
                return False
            channel = self._channel(entry.key)
        self._writer.add_message(
            channel,
            _within(entry.logged, MAX_TIME),
            entry.payload,
            _within(entry.published, MAX_TIME),
            _within(entry.seq, MAX_SEQUENCE),
        )
        self.messages += 1
        return True

    def add_other(self, topic: str, form: MessageFormat, data: bytes, now: int) -> None:
        """Write a message that is not of the bus.

        Args:
            topic: of the message.
            form: of all messages of this topic.
            data: the message.
            now: [ns since 1970]
        """
        channel = self._channels.get(topic)
        if channel is None:
            if form.name not in self._schemas:
                self._schemas[form.name] = self._writer.register_schema(
                    form.name, form.encoding, form.schema
                )
            number = self._schemas[form.name]
            channel = self._writer.register_channel(topic, form.encoding, number)
            self._channels[topic] = channel
        now = _within(now, MAX_TIME)
        self._writer.add_message(channel, now, data, now)
        self.messages += 1

    def attach(self, name: str, data: bytes, now: int) -> None:
        """Add a gzipped file; `now` is in nanoseconds since 1970."""
        self._writer.add_attachment(0, _within(now, MAX_TIME), name, GZIP, data)

    def describe(self, name: str, facts: Mapping[str, str]) -> None:
        """Add facts under a name."""
        self._writer.add_metadata(name, dict(facts))

    def flush(self) -> None:
        """Write the buffered messages; after that the file can be read.

        Raises:
            Unwritable: the disk is full, or fails; what was written before can be read.
        """
        self._writer.flush()  # type: ignore[no-untyped-call]
        data = self._spool.take()
        if data:
            self._write(data, ENDING)

    def close(self) -> None:
        """Write the rest and the index; closing twice does nothing.

        Raises:
            Unwritable: see `flush`.
        """
        if self._open:
            self._writer.finish()  # type: ignore[no-untyped-call]
            self._write(self._spool.take(), b"")
            self._shut()

    def _channel(self, key: str) -> int:
        kind = kind_of(key)
        if kind is None:
            raise ValueError(f"{key} is not recorded")
        name = schema_name(kind)
        if name not in self._schemas:
            document = msgspec.json.encode(schema_to_view(kind))
            self._schemas[name] = self._writer.register_schema(name, "jsonschema", document)
        self._channels[key] = self._writer.register_channel(key, "json", self._schemas[name])
        return self._channels[key]

    def _write(self, data: bytes, ending: bytes) -> None:
        try:
            write_at(self._file, self.size, data + ending)
        except OSError as error:
            with suppress(OSError):
                os.ftruncate(self._file, self.size)
                write_at(self._file, self.size, ENDING)
            self._shut()
            raise Unwritable(
                f"cannot write {self._path} any further: {error.strerror};"
                f" what was recorded up to then is in it"
            ) from error
        self.size += len(data)

    def _shut(self) -> None:
        self._open = False
        os.close(self._file)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()


def _within(number: int, limit: int) -> int:
    return min(max(number, 0), limit)


class _Capped:
    """A file that refuses to read more at once than a record may have."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file

    def read(self, size: int) -> bytes:
        if not 0 <= size <= MAX_RECORD:
            raise McapError(f"a part of {size} bytes")
        data = self._file.read(size)
        if len(data) < size:
            raise EndOfFile
        return data


def read(path: Path) -> Iterator[Piece]:
    """Yield the contents of a recording in order, as far as it is intact.

    Raises:
        NotARecording: it cannot be opened, or was not made by this program.
    """
    try:
        with path.open("rb") as file:
            if file.read(len(MCAP0_MAGIC)) != MCAP0_MAGIC:
                raise NotARecording(f"{path} is not an MCAP file")
            file.seek(0)
            source: Any = _Capped(file)
            records = StreamReader(source, emit_chunks=True, record_size_limit=MAX_RECORD).records
            _check_header(path, records)
            yield from _pieces(records)
    except OSError as error:
        raise NotARecording(f"cannot read {path}: {error.strerror}") from error


_DAMAGE = (McapError, struct.error, ValueError, OverflowError, zstandard.ZstdError)


def _check_header(path: Path, records: Iterator[McapRecord]) -> None:
    try:
        header = next(records)
    except _DAMAGE as error:
        raise NotARecording(f"{path} is damaged at its beginning") from error
    if not isinstance(header, Header):
        raise NotARecording(f"{path} is damaged: it begins without a header")
    if header.profile != PROFILE:
        profile = one_line(header.profile)[:64]
        raise NotARecording(f"{path} was not recorded by xavi: its profile is {profile!r}")


def _pieces(records: Iterator[McapRecord]) -> Iterator[Piece]:
    keys: dict[int, str] = {}
    ended = False
    try:
        for outer in records:
            ended = ended or isinstance(outer, DataEnd)
            if ended:
                continue  # only copies follow, for readers that seek
            for record in _inner(outer):
                match record:
                    case Channel(id=number, topic=topic):
                        keys[number] = topic[:MAX_KEY]
                    case Message():
                        yield _entry(record, keys)
                    case Attachment(name=name, data=data):
                        yield AttachedFile(name, data)
                    case Metadata(name=name) if name == EXPORT:
                        yield ForViewers()
    except EndOfFile:
        yield Truncation("it was cut off while it was written")
    except _DAMAGE as error:
        yield Truncation(f"it is damaged: {one_line(str(error)) or type(error).__name__}")


def _inner(record: McapRecord) -> list[McapRecord]:
    return _unpacked(record) if isinstance(record, Chunk) else [record]


def _entry(message: Message, keys: Mapping[int, str]) -> Entry:
    key = keys.get(message.channel_id)
    if key is None:
        raise McapError(f"a message of channel {message.channel_id}, which there is not")
    return Entry(key, message.data, message.sequence, message.publish_time, message.log_time)


def _unpacked(chunk: Chunk) -> list[McapRecord]:
    """Return the records of a chunk; its size in memory is declared and limited.

    Raises:
        McapError: it is too large, or not as declared.
    """
    size = chunk.uncompressed_size
    if size > MAX_RECORD:
        raise McapError(f"a chunk of {size} bytes")
    data = chunk.data
    if chunk.compression == "zstd":
        inflater = zstandard.ZstdDecompressor(max_window_size=MAX_RECORD)
        data = inflater.stream_reader(data).read(size + 1)
    elif chunk.compression:
        raise McapError(f"a chunk packed by {one_line(chunk.compression)[:64]!r}")
    if len(data) != size:
        raise McapError("a chunk of another size than it says")
    return breakup_chunk(replace(chunk, compression="", data=data), validate_crc=True)
