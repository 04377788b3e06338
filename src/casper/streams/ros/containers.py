"""MCAP files, read from beginning to end, whatever is cut off or spoilt of them.

A file that was not closed has no index, so none is used. A chunk that cannot be unpacked is passed over, one that ends
too soon is read up to there; both are told, and so is every message of a kind that is not read.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO

from mcap.data_stream import ReadDataStream
from mcap.exceptions import EndOfFile, InvalidMagic, McapError
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, McapRecord, Message, Schema
from mcap.stream_reader import StreamReader
from mcap_ros2.decoder import DecoderFactory

from casper.kb.errors import CasperError

LARGEST = 2**28  # bytes of a record, and of what a chunk holds when it is unpacked
BROKEN = (McapError, struct.error, ValueError, TypeError, KeyError, IndexError, EOFError, RuntimeError, MemoryError)
"""What the libraries raise about bytes that are none of theirs."""


@dataclass(frozen=True, slots=True)
class Heard:
    """A message: its topic, its type (``tf2_msgs/msg/TFMessage``), when it was logged (seconds), and what it says."""

    topic: str
    kind: str
    logged: float
    said: Any


@dataclass
class Container:
    """One file.

    Args:
        path: where it is.
        kinds: the types that are read, without their package's ``msg``: ``tf2_msgs/TFMessage``.

    Attributes:
        problems: what could not be read, a sentence each. unread: how many messages of each topic and type were not.
    """

    path: Path
    kinds: frozenset[str]
    problems: list[str] = field(default_factory=list)
    unread: dict[tuple[str, str], int] = field(default_factory=dict)
    _schemas: dict[int, Schema] = field(default_factory=dict)
    _channels: dict[int, Channel] = field(default_factory=dict)
    _decoders: dict[int, Callable[[bytes], Any] | None] = field(default_factory=dict)
    _factory: DecoderFactory = field(default_factory=DecoderFactory)
    _spoilt: dict[str, int] = field(default_factory=dict)

    def messages(self) -> Iterator[Heard]:
        """The messages that can be read, in the order in which they were written.

        Raises:
            CasperError: the file cannot be opened, or is no MCAP.
        """
        try:
            with self.path.open("rb") as stream:
                for record in self._records(stream):
                    yield from self._heard(record)
        except OSError as mistake:
            raise CasperError(f"cannot read {self.path} ({mistake.strerror or mistake})") from None
        self.problems += [f"{count} messages of {topic} cannot be decoded" for topic, count in self._spoilt.items()]

    def _records(self, stream: BinaryIO) -> Iterator[McapRecord]:
        reader = StreamReader(stream, emit_chunks=True, record_size_limit=LARGEST)
        chunks = 0
        try:
            for record in reader.records:
                if isinstance(record, Chunk):
                    chunks += 1
                    yield from self._unpacked(record, chunks)
                else:
                    yield record
        except InvalidMagic:
            if chunks or self._channels:
                self.problems.append("its end is spoilt")
                return
            raise CasperError(f"{self.path} is no MCAP file") from None
        except BROKEN as mistake:
            because = "" if isinstance(mistake, EndOfFile) else f" ({mistake or type(mistake).__name__})"
            self.problems.append(f"it is cut off{because}; everything before that was read")

    def _unpacked(self, chunk: Chunk, number: int) -> Iterator[McapRecord]:
        """The records of a chunk, those before the place where it is cut off or spoilt."""
        where = f"chunk {number}"
        try:
            data, is_whole = _content(chunk)
        except BROKEN as mistake:
            self.problems.append(f"{where} cannot be unpacked ({mistake or type(mistake).__name__}); it is passed over")
            return
        if is_whole and chunk.uncompressed_crc and zlib.crc32(data) != chunk.uncompressed_crc:
            self.problems.append(f"{where} is spoilt (its checksum is another); it is passed over")
            return
        if not is_whole:
            share = f"{len(data):,} of its {chunk.uncompressed_size:,} bytes"
            self.problems.append(f"{where} is cut off; {share} were read")
        try:
            yield from _parsed(data)
        except BROKEN as mistake:
            because = mistake or type(mistake).__name__
            self.problems.append(f"{where} is spoilt ({because}); the rest of it is passed over")

    def _heard(self, record: McapRecord) -> Iterator[Heard]:
        if isinstance(record, Schema):
            self._schemas[record.id] = record
        elif isinstance(record, Channel):
            self._channels[record.id] = record
            self._decoders.pop(record.id, None)
        elif isinstance(record, Message):
            channel = self._channels.get(record.channel_id)
            if channel is None:
                self._count("an unknown channel", "")
                return
            schema = self._schemas.get(channel.schema_id)
            kind = "" if schema is None else schema.name
            decode = self._decoder(channel, schema)
            if decode is None:
                self._count(channel.topic, kind or channel.message_encoding)
                return
            try:
                said = decode(record.data)
            except BROKEN:
                self._spoilt[channel.topic] = self._spoilt.get(channel.topic, 0) + 1
                return
            yield Heard(channel.topic, short(kind), record.log_time / 1e9, said)

    def _decoder(self, channel: Channel, schema: Schema | None) -> Callable[[bytes], Any] | None:
        """What reads the messages of a channel; None: they are not read."""
        if channel.id not in self._decoders:
            found = None
            if schema is not None and short(schema.name) in self.kinds:
                try:
                    found = self._factory.decoder_for(channel.message_encoding, schema)
                except BROKEN as mistake:
                    self.problems.append(f"the type of {channel.topic}, {schema.name}, cannot be read ({mistake})")
            self._decoders[channel.id] = found
        return self._decoders[channel.id]

    def _count(self, topic: str, kind: str) -> None:
        self.unread[topic, kind] = self.unread.get((topic, kind), 0) + 1


def short(kind: str) -> str:
    """A type without the part that ROS 2 puts in the middle."""
    return kind.replace("/msg/", "/")


def _content(chunk: Chunk) -> tuple[bytes, bool]:
    """What a chunk holds, and whether that is all of it."""
    size = chunk.uncompressed_size
    if size > LARGEST:
        raise ValueError(f"it would have {size:,} bytes")
    data = _unpackers()[chunk.compression](chunk.data)
    return data[:size], len(data) >= size


def _unpackers() -> Mapping[str, Callable[[bytes], bytes]]:
    import lz4.frame
    import zstandard

    def unzstd(data: bytes) -> bytes:
        try:
            return zstandard.ZstdDecompressor().decompressobj().decompress(data)
        except zstandard.ZstdError as mistake:
            raise ValueError(mistake) from None

    def unlz4(data: bytes) -> bytes:
        return bytes(lz4.frame.LZ4FrameDecompressor().decompress(data, max_length=LARGEST))

    return {"": bytes, "zstd": unzstd, "lz4": unlz4}


def _parsed(data: bytes) -> Iterator[McapRecord]:
    """Records one after the other; a last one that is not whole is left out."""
    at, end = 0, len(data)
    while at + 9 <= end:
        opcode, length = struct.unpack_from("<BQ", data, at)
        at += 9
        if at + length > end:
            return
        stream = ReadDataStream(BytesIO(data[at : at + length]))
        at += length
        if opcode == Opcode.SCHEMA:
            yield Schema.read(stream)
        elif opcode == Opcode.CHANNEL:
            yield Channel.read(stream)
        elif opcode == Opcode.MESSAGE:
            yield Message.read(stream, length)
