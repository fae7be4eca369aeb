"""A reinforcement learning environment with the interface of Gymnasium, which need not be installed.

The agent moves the hand; the link delays its observations of the robot.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._longreach import LabState
from .errors import InputError
from .lab import Hand, Lab, Settings


@dataclass(frozen=True)
class Box:
    """A set of arrays between two bounds, like gymnasium.spaces.Box."""

    low: NDArray[np.float64]
    high: NDArray[np.float64]

    @property
    def shape(self) -> tuple[int, ...]:
        return self.low.shape

    def contains(self, x: ArrayLike) -> bool:
        value = np.asarray(x, dtype=float)
        return value.shape == self.shape and bool(np.all((value >= self.low) & (value <= self.high)))

    def sample(self, random: np.random.Generator | None = None) -> NDArray[np.float64]:
        return (random or np.random.default_rng()).uniform(self.low, self.high)


def no_reward(state: LabState) -> float:
    return 0.0


class Env:
    """`reset()` and `step(action)` as in Gymnasium.

    action: target of the hand relative to the home position of the handle, 3 numbers, m, in M, within `action_space`.
    observation, shape (14,): current values of the master and values that have arrived from the slave:
        0-2 position of the handle, m, in M; 3-5 force on the hand, N, in M; 6-8 displacement of the tool from the
        anchor, m, in W; 9-11 force on the tool, N, in W; 12 rendered stiffness, N/m; 13 contact, 0 or 1. The link
        delays 6-11 and 13.
    info: {"state": LabState}, the state without delay, for rewards and plots.

    Args:
        settings: as for Lab.
        control_hz: steps per second of virtual time.
        seconds: length of an episode, after which `truncated` is True; at most `duration_s` of the settings.
        reach_m: maximum magnitude of each component of an action.
        reward: function that computes the reward from the state.
    """

    def __init__(self, settings: Settings = (), *, control_hz: float = 50.0, seconds: float = 20.0,
                 reach_m: float = 0.04, reward: Callable[[LabState], float] = no_reward) -> None:
        self._settings = settings
        self._control_hz = control_hz
        self._seconds = seconds
        self._reward = reward
        self._seed = 0
        self._lab: Lab | None = None
        bound = np.full(3, float(reach_m))
        self.action_space = Box(-bound, bound)
        self.observation_space = Box(np.full(14, -np.inf), np.full(14, np.inf))

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None
              ) -> tuple[NDArray[np.float64], dict[str, Any]]:
        """Starts an episode and waits until the robot follows the hand. The default seed is the previous one plus 1."""
        self._seed = self._seed + 1 if seed is None else int(seed)
        lab = Lab(self._settings, self._seed)
        lab.drive(Hand())
        while not lab.done and lab.state.state != 'Engaged':
            lab.step(max(1, round(0.05 / lab.period_s)))
        self._lab = lab
        self._end_s = lab.state.time_s + self._seconds
        return self._observe(lab.state), {'state': lab.state}

    def step(self, action: ArrayLike) -> tuple[NDArray[np.float64], float, bool, bool, dict[str, Any]]:
        """Returns observation, reward, terminated (the robot no longer follows the hand), truncated and info."""
        if self._lab is None:
            raise InputError('step() was called before reset()')
        aim = np.asarray(action, dtype=float)
        if aim.shape != (3,) or not np.all(np.isfinite(aim)):
            raise InputError(f'action = {np.asarray(action).tolist()} does not consist of 3 finite numbers')
        self._lab.drive(Hand(position_m=np.clip(aim, self.action_space.low, self.action_space.high)))
        state = self._lab.step(max(1, round(1.0 / (self._control_hz * self._lab.period_s))))
        terminated = state.state in ('Holding', 'Stopped', 'Fault')
        truncated = self._lab.done or state.time_s >= self._end_s
        return self._observe(state), float(self._reward(state)), terminated, truncated, {'state': state}

    @staticmethod
    def _observe(state: LabState) -> NDArray[np.float64]:
        far = state.far_m - state.anchor_m if np.any(state.far_m) else np.zeros(3)
        rest = np.array((state.stiffness_n_per_m, float(state.far_contact)))
        return np.concatenate((state.handle_m, state.force_n, far, state.far_n, rest), dtype=np.float64)
