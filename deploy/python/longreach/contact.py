"""Identification of a contact from measured motion and force."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _longreach


@dataclass(frozen=True)
class Parameter:
    """A value, its standard deviation in the same unit, and a verdict.

    verdict: "identified", "too few samples", "not identifiable" (more samples of this kind do not help) or
        "no power law".
    """

    value: float
    sd: float
    verdict: str

    @property
    def identified(self) -> bool:
        return self.verdict == 'identified'


@dataclass(frozen=True)
class Contact:
    """The law F = k x^n + lambda x^n v (Hunt and Crossley 1975) with the depth x behind the surface and its rate v."""

    valid: bool  # False: no fit was found, and all values are zero
    k: Parameter  # N/m^n
    lambda_: Parameter  # N s/m^(n+1)
    n: Parameter  # exponent
    tangent: Parameter  # dF/dx of the elastic force at depth_m, N/m
    secant: Parameter  # elastic force over depth at depth_m, N/m
    surface: Parameter  # position of the surface, m
    depth_m: float  # depth at which tangent and secant are evaluated
    force_sd_n: float  # standard deviation of a force sample
    changes: int  # how often a different object was detected under the tool; the result refers to the last object
    law_fits: bool  # False: no power law fits the force

    def force(self, depth_m: ArrayLike, speed_m_per_s: ArrayLike = 0.0) -> NDArray[np.float64]:
        """Returns the force of this law, N, for depths (m) and speeds (m/s) of equal or broadcastable shapes."""
        depth = np.maximum(np.asarray(depth_m, dtype=float), 0.0)
        return depth**self.n.value * (self.k.value + self.lambda_.value * np.asarray(speed_m_per_s, dtype=float))


def identify(time: ArrayLike, position: ArrayLike, force: ArrayLike, *, surface: float | None = None,
             force_noise: float = 0.0, position_noise: float = 0.0, depth: float | None = None) -> Contact:
    """Identifies a contact by maximum likelihood, as longreach-slave does.

    Args:
        time: strictly increasing times, s, shape (N,) with N >= 3. Arrays of float64 are not copied.
        position: position of the tool along the inward normal, relative to any fixed point, m, shape (N,). Samples from
            before the touch help to locate the surface.
        force: force on the tool along the outward normal, N, shape (N,).
        surface: position of the surface if known, m; None: the surface is identified.
        force_noise, position_noise: standard deviations of the noise, N and m; 0: estimated from the samples.
        depth: depth at which tangent and secant are evaluated, m; None: the largest depth, where the
            tool pressed hardest.

    Returns:
        The parameters with their uncertainties and verdicts.

    Raises:
        InputError: the sizes differ, there are fewer than three samples, a value is not finite, or a time does not
            increase.
    """
    values: dict[str, Any] = _longreach.identify(np.asarray(time, dtype=float), np.asarray(position, dtype=float),
                                                 np.asarray(force, dtype=float), surface, force_noise, position_noise,
                                                 depth)
    for name in ('k', 'lambda_', 'n', 'tangent', 'secant', 'surface'):
        values[name] = Parameter(*values[name])
    return Contact(**values)
