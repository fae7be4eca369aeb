"""Both sides of longreach and the link between them in virtual time, with parts in Python."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass, field
from typing import Callable, Mapping, Protocol, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _longreach
from ._longreach import LabState
from .errors import InputError

Settings = Union[Sequence[str], Mapping[str, object]]
_SLICE_S = 0.1  # of virtual time between two looks at interrupts


def _zeros() -> NDArray[np.float64]:
    return np.zeros(3)


@dataclass
class Hand:
    """Target of the simulated hand, from the home of the handle, in the frame M of the device."""

    position_m: ArrayLike = field(default_factory=_zeros)
    velocity_m_per_s: ArrayLike = field(default_factory=_zeros)
    rotation_rad: ArrayLike = field(default_factory=_zeros)  # rotation vector
    held: bool = True  # False: no hand is on the handle
    firm: bool = False  # a stiffer hand
    request: str | None = None  # "engage", "hold", "stop", "position", "rate", "open" or "close"


class Operator(Protocol):
    """Replaces the scripted operator: called `operator_hz` times per second of virtual time."""

    def hand(self, state: LabState) -> Union[Hand, ArrayLike]:
        """Returns a Hand, or only its position (3 numbers, m)."""


class Law(Protocol):
    """Replaces the rendering law: called in every tick of the master (1 kHz)."""

    def force(self, state: LabState) -> ArrayLike:
        """Returns the force on the hand in M, 3 numbers, N. It is rendered as it is, without the port guard.

        The law of longreach runs beside it: metrics of displayed stiffness and energy, and spring_n, are its own.
        """


class Estimator(Protocol):
    """Replaces the slave's estimate: called in every tick of the slave (1 kHz) while there is contact."""

    def stiffness(self, state: LabState) -> float | None:
        """Returns the stiffness that the slave reports, N/m; None: as before. 0: not identified yet."""


class RobotModel(Protocol):
    """Replaces the simulated arm: called in every tick of the slave (1 kHz)."""

    def step(self, time_s: float, setpoint: NDArray[np.float64] | None
             ) -> tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike]:
        """Returns joint positions (6, rad or m), joint speeds (6), force and moment on the tool in W (3, N; 3, N m).

        `setpoint`: the joint positions that the slave asked for in the previous tick; None: stay in place.
        """


def settings_of(settings: Settings) -> list[str]:
    """["path=value", ...] from such a list or from a dictionary {path: value}."""
    if isinstance(settings, str):
        raise InputError('settings is a text; give a list of texts "path=value" or a dictionary')
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
    """The experiment `touch` of longreach-lab: the operator touches the scene's wall across the link.

    The same version, settings and seed give the same values, bit for bit those of `longreach-lab run touch`.

    Args:
        settings: a list of "path=value" or a dictionary, as of `longreach-lab run --set`, e.g. {"profile": "moon"}.
            proto/config.proto documents all paths.
        seed: of every random stream.
        operator, law, estimator, robot: objects that replace parts; see the classes Operator, Law, Estimator and
            RobotModel. An exception in one of them ends the step that called it.
        operator_hz: rate at which the operator is asked.

    Raises:
        InputError: names the setting that is wrong.
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
        """A copy of the present state."""
        return self._lab.state()

    @property
    def done(self) -> bool:
        """True at the end of the run: the script has ended, or `duration_s` of the settings has passed."""
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
        """Moves the hand from now on, instead of the scripted operator."""
        self._lab.drive(_vector('position_m', hand.position_m), _vector('velocity_m_per_s', hand.velocity_m_per_s),
                        _vector('rotation_rad', hand.rotation_rad), hand.held, hand.firm)
        if hand.request is not None:
            self.request(hand.request)

    def request(self, what: str) -> None:
        """A request for the next step, as a key of the operator: see Hand.request."""
        known = ('engage', 'hold', 'stop', 'position', 'rate', 'open', 'close')
        if what not in known:
            raise InputError(f'request = {what!r} is not one of {", ".join(known)}')
        self._lab.request(what)

    def run(self, until: float | Callable[[LabState], bool] | None = None, *, progress: bool = False
            ) -> dict[str, float]:
        """Steps to the end of the run and returns the metrics.

        Args:
            until: virtual time to stop at, s, or a function of the state that is asked every 0.1 s of virtual time.
            progress: show a line on stderr.

        Ctrl-C ends it within 0.1 s of virtual time; the laboratory can be stepped further.
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
        """The metrics of `longreach-lab run touch` so far, by name."""
        return dict(self._lab.metrics())

    def trace(self) -> dict[str, NDArray[np.float64]]:
        """The columns of touch.csv so far, shape (N,) each, `trace_hz` rows per second of virtual time."""
        return dict(self._lab.trace())
