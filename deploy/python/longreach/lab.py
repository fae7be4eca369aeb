"""Simulation of both sides of longreach and the link between them in virtual time; parts of it can be in Python."""

from __future__ import annotations

import json
import sys
import time
from dataclasses import dataclass, field
from typing import Any, Callable, Mapping, Protocol, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _longreach
from ._longreach import LabState
from .errors import InputError

Settings = Union[Sequence[str], Mapping[str, object]]
_SLICE_S = 0.1  # virtual time between checks for an interrupt


def _zeros() -> NDArray[np.float64]:
    return np.zeros(3)


@dataclass
class Hand:
    """Target of the simulated hand, relative to the home position of the handle, in the frame M of the device."""

    position_m: ArrayLike = field(default_factory=_zeros)
    velocity_m_per_s: ArrayLike = field(default_factory=_zeros)
    rotation_rad: ArrayLike = field(default_factory=_zeros)  # rotation vector
    held: bool = True  # False: no hand is on the handle
    firm: bool = False  # True: a stiffer grip
    request: str | None = None  # "engage", "hold", "stop", "position", "rate", "open" or "close"


class Operator(Protocol):
    """Replaces the scripted operator; called `operator_hz` times per second of virtual time."""

    def hand(self, state: LabState) -> Union[Hand, ArrayLike]:
        """Returns a Hand, or only the target position (3 numbers, m)."""


class Law(Protocol):
    """Replaces the rendering law; called in every tick of the master (1 kHz)."""

    def force(self, state: LabState) -> ArrayLike:
        """Returns the force on the hand in M, 3 numbers, N. The force is rendered unchanged, without the port guard.

        The law of longreach is still computed; `spring_n` and the metrics of stiffness and energy refer to that law.
        """


class Estimator(Protocol):
    """Replaces the slave's estimate; called in every tick of the slave (1 kHz) during contact."""

    def stiffness(self, state: LabState) -> float | None:
        """Returns the stiffness that the slave reports, N/m. None: the previous value is kept; 0: not identified."""


class RobotModel(Protocol):
    """Replaces the simulated arm; called in every tick of the slave (1 kHz)."""

    def step(self, time_s: float, setpoint: NDArray[np.float64] | None
             ) -> tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike]:
        """Returns joint positions (6, rad or m), joint speeds (6), force and moment on the tool in W (3, N; 3, N m).

        `setpoint`: the joint positions that the slave commanded in the previous tick; None: the arm stays in place.
        Force and moment must contain noise; without it, set `sensing.force_noise_n` and `sensing.moment_noise_nm` to 0.
        """


def settings_of(settings: Settings) -> list[str]:
    """Converts a list of strings "path=value" or a dictionary {path: value} to such a list."""
    if isinstance(settings, str):
        raise InputError('settings is a string; it must be a list of strings "path=value" or a dictionary')
    if not isinstance(settings, Mapping):
        return [str(text) for text in settings]
    texts = []
    for path, value in settings.items():
        if isinstance(value, (list, tuple, np.ndarray)):
            value = ','.join(repr(float(number)) for number in value)
        elif isinstance(value, bool):
            value = str(value).lower()
        texts.append(f'{path}={value}')
    return texts


def _vector(name: str, value: ArrayLike) -> NDArray[np.float64]:
    vector = np.asarray(value, dtype=float)
    if vector.shape != (3,):
        raise InputError(f'{name} = {vector.tolist()} does not consist of 3 numbers')
    return vector


class Lab:
    """The experiment `touch` of longreach-lab: the operator touches the wall of the scene over the link.

    The same version, settings and seed always give the same values, identical to those of `longreach-lab run touch`.

    Args:
        settings: a list of strings "path=value", as for `longreach-lab run --set`, or a dictionary, e.g.
            {"profile": "moon"}. proto/config_*.proto document all paths.
        seed: seed of all random streams.
        operator, law, estimator, robot: objects that replace parts of the simulation; see the classes Operator, Law,
            Estimator and RobotModel. If an object raises an exception, step() raises it again.
        operator_hz: how often the method of `operator` is called per second of virtual time.

    Raises:
        InputError: a setting is invalid; the message names it.
    """

    def __init__(self, settings: Settings = (), seed: int = 1, *, operator: Operator | None = None,
                 law: Law | None = None, estimator: Estimator | None = None, robot: RobotModel | None = None,
                 operator_hz: float = 100.0) -> None:
        for part, method, name in ((operator, 'hand', 'operator'), (law, 'force', 'law'),
                                   (estimator, 'stiffness', 'estimator'), (robot, 'step', 'robot')):
            if part is not None and not callable(getattr(part, method, None)):
                raise InputError(f'{name} has no method {method}()')
        self._lab = _longreach.Lab(settings_of(settings), seed, law, estimator, robot)
        self._operator = operator
        self.period_s: float = self._lab.period_s()
        if not 0.0 < operator_hz <= 1.0 / self.period_s + 1e-9:
            raise InputError(f'operator_hz = {operator_hz:g} is outside 0 to {1.0 / self.period_s:g}')
        self._ticks_per_call = max(1, round(1.0 / (operator_hz * self.period_s)))
        self._tick = 0
        self._done = False

    @property
    def state(self) -> LabState:
        """A copy of the current state."""
        return self._lab.state()

    def values(self, side: str = 'master') -> dict[str, Any]:
        """Returns all values of a side, as nested dictionaries with the names of proto/state_master.proto or
        state_slave.proto; `longreach status --all` shows the same of the programs."""
        if side not in ('master', 'slave'):
            raise InputError(f'side = {side!r} is neither "master" nor "slave"')
        return dict(json.loads(self._lab.values(side)))

    @property
    def done(self) -> bool:
        """True if the run has ended: the script is complete, or `duration_s` of the settings has elapsed."""
        return self._done

    def step(self, ticks: int = 1) -> LabState:
        """Advances both sides by up to `ticks` periods (1 ms unless loop.rate_hz is set) and returns the state."""
        left = int(ticks)
        while left > 0 and not self._done:
            if self._operator is None:
                count = left
            else:
                if self._tick % self._ticks_per_call == 0:
                    self._ask_operator()
                count = min(left, self._ticks_per_call - self._tick % self._ticks_per_call)
            self._done = self._lab.step(count)
            self._tick += count
            left -= count
        return self._lab.state()

    def _ask_operator(self) -> None:
        assert self._operator is not None
        answer = self._operator.hand(self._lab.state())
        self.drive(answer if isinstance(answer, Hand) else Hand(position_m=answer))

    def drive(self, hand: Hand) -> None:
        """Sets the target of the hand. From now on, the scripted operator no longer moves the hand."""
        self._lab.drive(_vector('position_m', hand.position_m), _vector('velocity_m_per_s', hand.velocity_m_per_s),
                        _vector('rotation_rad', hand.rotation_rad), hand.held, hand.firm)
        if hand.request is not None:
            self.request(hand.request)

    def request(self, what: str) -> None:
        """Makes a request in the next step, like a key press of the operator. Hand.request lists the values."""
        known = ('engage', 'hold', 'stop', 'position', 'rate', 'open', 'close')
        if what not in known:
            raise InputError(f'request = {what!r} is not one of {", ".join(known)}')
        self._lab.request(what)

    def run(self, until: float | Callable[[LabState], bool] | None = None, *, progress: bool = False
            ) -> dict[str, float]:
        """Runs to the end, or as far as `until` specifies, and returns the metrics.

        Args:
            until: virtual time at which to stop, s, or a function that is called with the state every 0.1 s of virtual
                time and returns True to stop.
            progress: shows the progress on stderr.

        Ctrl-C interrupts the run within 0.1 s of virtual time; step() or run() can then continue it.
        """
        slice_ticks = max(1, round(_SLICE_S / self.period_s))
        shown = time.monotonic()
        while not self._done:
            ticks = slice_ticks
            if isinstance(until, (int, float)):
                ticks = min(ticks, round((until - self._lab.state().time_s) / self.period_s))
                if ticks <= 0:
                    break
            state = self.step(ticks)
            if callable(until) and until(state):
                break
            if progress and time.monotonic() - shown > 0.2:
                shown = time.monotonic()
                sys.stderr.write(f'\r{state.time_s:.1f} s of virtual time, {100.0 * self._lab.completed():.0f} %')
                sys.stderr.flush()
        if progress:
            sys.stderr.write('\n')
        return self.metrics()

    def metrics(self) -> dict[str, float]:
        """Returns the current metrics of the run by name; they are those of `longreach-lab run touch`."""
        return dict(self._lab.metrics())

    def trace(self) -> dict[str, NDArray[np.float64]]:
        """Returns the columns of touch.csv so far, shape (N,), with `trace_hz` rows per second of virtual time."""
        return dict(self._lab.trace())
