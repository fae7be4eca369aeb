"""Compares rendering laws of your own with that of longreach: the force on the hand, and the speed of the hand."""

import numpy as np
from numpy.typing import NDArray

import longreach


class NaiveSpring:
    """A spring with the reported stiffness, without the rules that keep the rendering passive."""

    def force(self, state: longreach.LabState) -> NDArray[np.float64]:
        damping = -2.0 * state.handle_m_per_s
        if not state.surface_known:
            return damping
        depth_m = max(0.0, float(state.inward @ state.handle_m) - state.surface_m)
        return damping - state.stiffness_n_per_m * depth_m * state.inward


class NoForce:
    """The control: no force on the hand."""

    def force(self, state: longreach.LabState) -> NDArray[np.float64]:
        return np.zeros(3)


for name, law in (('longreach', None), ('naive spring', NaiveSpring()), ('no force', NoForce())):
    lab = longreach.Lab({'profile': 'moon'}, seed=1, law=law)
    force_max_n = speed_max = 0.0
    while not lab.done:
        state = lab.step(10)
        force_max_n = max(force_max_n, float(np.linalg.norm(state.force_n)))
        speed_max = max(speed_max, float(np.linalg.norm(state.handle_m_per_s)))
    print(f'{name:13} force on the hand up to {force_max_n:5.2f} N, hand speed up to {speed_max:.2f} m/s, '
          f'force at the tool up to {lab.metrics()["tool_force_peak_n"]:.2f} N')
