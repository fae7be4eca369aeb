"""Access to a running master and slave over gRPC: state, settings and requests, as in the command-line client."""

from __future__ import annotations

import contextlib
import json
import time
from dataclasses import dataclass
from typing import Any, Dict, Iterator, Mapping

from . import _longreach
from .errors import InputError, LongreachError, NotReachable, Refused

Status = Dict[str, Any]


@dataclass(frozen=True)
class Pair:
    """Status of both sides at the same time. The keys are the fields of message Status in proto/control.proto."""

    master: Status | None  # None: the side did not respond; see master_error
    slave: Status | None
    master_error: str = ''
    slave_error: str = ''


def _text(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (list, tuple)):
        return ','.join(repr(float(number)) for number in value)
    return str(value)


class Client:
    """Client of a master and a slave.

    Args:
        master, slave: addresses HOST:PORT of their RPC servers.
        timeout_s: timeout of each call, including the time to connect, s; None: it follows the link, up to a round
            trip of 10 s. The first call to a side connects, which takes three round trips more.
        site: folder with the certificates; empty: the default folder of this user ($XDG_CONFIG_HOME/longreach).
        insecure: disables encryption; only for programs on this machine that were started with --insecure.

    Every method may raise NotReachable, Refused or InputError; `error.field` is the path of the invalid setting.
    """

    def __init__(self, master: str = '127.0.0.1:47010', slave: str = '127.0.0.1:47020', *, timeout_s: float | None = None,
                 site: str = '', insecure: bool = False) -> None:
        self._client = _longreach.Client(master, slave, timeout_s, site, insecure)

    @staticmethod
    def _side(side: str) -> str:
        if side not in ('master', 'slave'):
            raise InputError(f'side = {side!r} is neither "master" nor "slave"')
        return side

    def _run(self, side: str, action: Mapping[str, object]) -> str:
        """Carries out an Action of proto/control.proto."""
        return str(self._client.run(side, json.dumps(action)))

    def status(self, side: str = 'master') -> Status:
        """Returns the status of one side, e.g. status()["state"] == "Engaged"."""
        return dict(json.loads(self._client.status(self._side(side))))

    def pair(self) -> Pair:
        """Returns the status of both sides. The status of a side that does not respond is None."""
        found: dict[str, Any] = {}
        for side in ('master', 'slave'):
            try:
                found[side] = self.status(side)
            except LongreachError as error:
                found[side] = None
                found[side + '_error'] = str(error)
        return Pair(**found)

    def watch(self, rate_hz: float = 10.0, *, count: int | None = None) -> Iterator[Pair]:
        """Yields the status of both sides `rate_hz` times per second, `count` times in total (None: without end)."""
        if not 0.1 <= rate_hz <= 60.0:
            raise InputError(f'rate_hz = {rate_hz:g} is outside 0.1 to 60')
        due = time.monotonic()
        shown = 0
        while count is None or shown < count:
            yield self.pair()
            shown += 1
            due = max(due + 1.0 / rate_hz, time.monotonic())
            time.sleep(max(0.0, due - time.monotonic()))

    def get(self, path: str = '', side: str = 'master', *, origin: bool = False) -> str:
        """Returns the effective configuration, or the part of it at `path`, as text.

        With `origin`, a comment behind each value names where it comes from.
        """
        return str(self._client.get(self._side(side), path, origin))

    def set(self, side: str = 'master', fields: Mapping[str, object] | None = None, **named: object) -> str:
        """Sets all given fields or none, e.g. client.set("master", {"mapping.scale": 0.5}). Returns the changes."""
        all_fields = {**(fields or {}), **named}
        if not all_fields:
            raise InputError('no field is given')
        assignments = [(path, _text(value)) for path, value in all_fields.items()]
        try:
            return str(self._client.set(self._side(side), assignments))
        except InputError as error:
            named_there = [path for path in all_fields if path in str(error)] or list(all_fields)
            if len(named_there) == 1:
                error._field = named_there[0]
            raise

    def link(self, profile: str | None = None, *, direction: str = 'both', **fields: object) -> str:
        """Sets the simulated impairment, e.g. link("moon") or link(delay="650ms", loss=0.01). Returns the changes."""
        if direction not in ('up', 'down', 'both'):
            raise InputError(f'direction = {direction!r} is not one of up, down, both')
        names = {'delay': 'delay_s', 'jitter': 'jitter_s'}
        pairs = [(names.get(name, name), _text(value)) for name, value in fields.items()]
        return str(self._client.set_link(direction, profile, pairs))

    def mode(self, name: str) -> str:
        """Sets the mode, "position" or "rate"."""
        if name not in ('position', 'rate'):
            raise InputError(f'name = {name!r} is neither "position" nor "rate"')
        return self._run('master', {'mode': name.upper()})

    def scale(self, value: float) -> str:
        return self._run('master', {'scale': float(value)})

    def kv(self, value: float) -> str:
        """Sets the speed per deflection in rate mode, 1/s. That of rotation changes by the same factor."""
        return self._run('master', {'kv_per_s': float(value)})

    def engage(self, *, wait_s: float = 0.0) -> str:
        """Requests an engagement. With `wait_s`, waits up to that time until the request is accepted and the robot
        follows.

        Raises:
            Refused: with the reason, if the request is refused or the robot does not follow in time.
        """
        end = time.monotonic() + wait_s
        answer = ''
        while True:
            try:
                answer = answer or self._run('master', {'engage': {}})
            except Refused:
                if time.monotonic() >= end:
                    raise
            if answer and wait_s <= 0.0:
                return answer
            status = self.status('master')
            if answer and status.get('state') == 'Engaged':
                return answer
            if time.monotonic() >= end:
                raise Refused(f'not engaged after {wait_s:g} s: {status.get("refusal") or status.get("cause")}')
            time.sleep(0.1)

    def stop(self) -> str:
        """Stops the robot until the next engagement. Succeeds if at least one side has responded."""
        return str(self._client.stop())

    @contextlib.contextmanager
    def record(self, name: str = '', *, max_mb: float = 4096.0, sides: tuple[str, ...] = ('master', 'slave')
               ) -> Iterator[list[str]]:
        """Records while a with block runs: `with client.record("press") as files:`. Each side writes to its own folder.

        `files` contains one response per side, which names the file that this side writes.
        """
        started: list[str] = []
        answers: list[str] = []
        try:
            for side in sides:
                recording = {'name': name, 'max_mb': float(max_mb)}
                answers.append(self._run(self._side(side), {'start_recording': recording}))
                started.append(side)
            yield answers
        finally:
            for side in started:
                with contextlib.suppress(NotReachable):
                    self._run(side, {'stop_recording': {}})
