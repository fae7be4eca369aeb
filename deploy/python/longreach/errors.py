"""Exceptions of longreach. Each message is one sentence: what was read, what is wrong, what is allowed."""

from __future__ import annotations

import re

_FIELD = re.compile(r'(?:^|[\s:"])([a-z][a-z0-9_]*(?:\.[A-Za-z0-9_]+)*)(?:"?) = |\b([a-z][a-z0-9_]*(?:\.[a-z0-9_]+)+)\b')


class LongreachError(Exception):
    """Base of all exceptions of this package.

    Attributes:
        field: path of the setting or name of the argument that the message is about, e.g. "mapping.scale";
            None if it is about none.
    """

    _field: str | None = None  # as the caller knows it

    @property
    def field(self) -> str | None:
        if self._field is not None:
            return self._field
        match = _FIELD.search(str(self))
        return None if match is None else match.group(1) or match.group(2)


class InputError(LongreachError, ValueError):
    """A setting, an argument or a file is not valid. Nothing has been changed."""


class Refused(LongreachError, RuntimeError):
    """A side does not do this in its present state. Nothing has been changed."""


class NotReachable(LongreachError, ConnectionError):
    """A side does not respond or does not trust this program. The request may or may not have been carried out."""


class RecordingError(LongreachError, OSError):
    """A recording cannot be read."""
