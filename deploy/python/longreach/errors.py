"""Exceptions of longreach. Each message is one sentence: what was read, what is wrong and what is allowed."""

from __future__ import annotations

import re

_FIELD = re.compile(r'(?:^|[\s:"])([a-z][a-z0-9_]*(?:\.[A-Za-z0-9_]+)*)(?:"?) = |\b([a-z][a-z0-9_]*(?:\.[a-z0-9_]+)+)\b')


class LongreachError(Exception):
    """Base of all exceptions of this package.

    Attributes:
        field: path of the setting, or name of the argument, that caused the error, e.g. "mapping.scale"; None if the
            cause is neither a setting nor an argument.
    """

    _field: str | None = None  # the name that the caller used

    @property
    def field(self) -> str | None:
        if self._field is not None:
            return self._field
        match = _FIELD.search(str(self))
        return None if match is None else match.group(1) or match.group(2)


class InputError(LongreachError, ValueError):
    """A setting, an argument or a file is invalid. Nothing was changed."""


class Refused(LongreachError, RuntimeError):
    """A side refuses the request in its current state. Nothing was changed."""


class NotReachable(LongreachError, ConnectionError):
    """A side does not respond, or the TLS handshake failed. The request may or may not have been executed."""


class RecordingError(LongreachError, OSError):
    """A recording cannot be read."""
