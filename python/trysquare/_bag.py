# SPDX-License-Identifier: Apache-2.0
"""An open bag: its topics, and the messages of them."""

from __future__ import annotations

import os
import threading
import weakref
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trysquare._core import InvalidArgument, IoError

if TYPE_CHECKING:
    from rosbags.highlevel import AnyReader
    from rosbags.interfaces import Connection

_BAG_ENDINGS = (".bag", ".mcap", ".db3")


class Bag:
    """An open bag. One thread at a time reads from it."""

    def __init__(self, path: str | os.PathLike[str] | Sequence[str | os.PathLike[str]]) -> None:
        try:
            from rosbags.highlevel import AnyReader
            from rosbags.typesys import Stores, get_typestore
        except ImportError as error:
            raise ImportError("reading bags needs rosbags: pip install trysquare[bags]") from error
        paths = bag_files(path)
        self.name = str(paths[0])
        try:
            # Bags of ROS 2 before Jazzy do not hold the definitions of their types.
            self.reader: AnyReader = AnyReader(paths, default_typestore=get_typestore(Stores.LATEST))
            self.reader.open()
        except Exception as error:  # whatever the readers of three formats raise
            raise IoError(f"{self.name}: cannot be read as a bag: {error}") from error
        self.topics = self.reader.topics
        self.lock = threading.Lock()
        self._close = weakref.finalize(self, self.reader.close)

    def connections(self, types: Sequence[str], topic: str | None = None) -> list[Connection]:
        """Those of some types, of one topic or of all but /tf_static."""
        return [
            c
            for c in self.reader.connections
            if c.msgtype in types and (c.topic == topic if topic else c.topic != "/tf_static") and c.msgcount
        ]

    def topic(self, argument: str, asked: str | None, types: Sequence[str]) -> str:
        """The topic that was asked for, or the only one of these types."""
        found = sorted({c.topic for c in self.connections(types, asked)})
        if len(found) == 1:
            return found[0]
        candidates = found or sorted({c.topic for c in self.connections(types)}) or sorted(self.topics)
        listed = "".join(f"\n  {t} ({self.topics[t].msgtype}, {self.topics[t].msgcount})" for t in candidates)
        wanted = " or ".join(t.rsplit("/", 1)[1] for t in types)
        if asked is not None:
            raise IoError(
                f"{self.name}: {argument} = {asked} is no topic with messages of {wanted}; there are:{listed}"
            )
        if found:
            raise IoError(f"{self.name}: {len(found)} topics of {wanted}, choose {argument}:{listed}")
        raise IoError(f"{self.name}: no topic of {wanted}; there are:{listed or ' none'}")

    def messages(self, topic: str, types: Sequence[str], at_ns: int | None = None) -> Iterator[tuple[int, Any, str]]:
        """Time of recording [ns], message and type; all of a topic, or those recorded at one time."""
        stop = None if at_ns is None else at_ns + 1
        connections = self.connections(types, topic)
        if not connections:
            return
        try:
            for connection, recorded_ns, raw in self.reader.messages(connections, start=at_ns, stop=stop):
                yield recorded_ns, self.reader.deserialize(raw, connection.msgtype), connection.msgtype
        except GeneratorExit:
            raise
        except Exception as error:  # whatever the readers of three formats raise
            raise IoError(f"{self.name}: {topic}: a message cannot be read: {error}") from error


def bag_files(path: str | os.PathLike[str] | Sequence[str | os.PathLike[str]]) -> list[Path]:
    """The files of one recording; of a folder with metadata.yaml the folder."""
    if not isinstance(path, (str, os.PathLike)):
        if not path:
            raise InvalidArgument("path is an empty list, expected one bag or more")
        return [Path(each) for each in path]
    bag = Path(path)
    if not bag.exists():
        raise IoError(f"{bag}: no such file or folder")
    if not bag.is_dir() or (bag / "metadata.yaml").is_file():
        return [bag]
    files = sorted(file for file in bag.iterdir() if file.suffix in _BAG_ENDINGS)
    if not files:
        raise IoError(f"{bag}: the folder holds no metadata.yaml and no file {' '.join(_BAG_ENDINGS)}")
    return files
