"""Reads recordings into tables."""

from __future__ import annotations

import importlib
import os
from typing import Any, Dict, List, Union

import numpy as np
from numpy.typing import NDArray

from . import _longreach

Column = Union[NDArray[np.float64], NDArray[np.int64], NDArray[np.str_]]


class Table(Dict[str, Column]):
    """The messages of one topic as columns, e.g. table["t_s"].

    A column contains float64 (NaN where a message has no value), int64 or strings. "t_s" is the time since the first
    message of the recording, and "log_time_ns" is the Unix time. Columns of nested messages have names like
    "goal.position.x".
    """

    def to_pandas(self) -> Any:
        """Returns a pandas.DataFrame; requires python3-pandas."""
        return importlib.import_module('pandas').DataFrame(dict(self))


class Recording(Dict[str, Table]):
    """Tables by topic, e.g. recording["/master/command"]["t_s"]."""

    metadata: Dict[str, Dict[str, str]]
    skipped: List[str]  # topics and periods (damaged parts of the file) that could not be read, with the reason
    whole: bool  # False: the file is truncated or still being written


def read(file: Union[str, 'os.PathLike[str]']) -> Recording:
    """Reads an MCAP recording.

    Raises:
        RecordingError: the file cannot be read, or is damaged so that nothing can be read.
    """
    reader = _longreach.RecordingReader(os.fspath(file))
    while reader.read(20000):  # in slices, so that Ctrl-C takes effect
        pass
    recording = Recording()
    for topic, columns in reader.topics().items():
        recording[topic] = Table({name: np.array(values) if isinstance(values, list) else values
                                  for name, values in columns.items()})
    recording.metadata = reader.metadata()
    recording.skipped = reader.skipped()
    recording.whole = reader.whole()
    return recording
