"""Kinematics of a robot arm that is described by a file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _longreach
from .errors import InputError


@dataclass(frozen=True)
class Joint:
    name: str
    prismatic: bool
    min: float  # rad, or m for a prismatic joint
    max: float
    speed_max: float  # rad/s or m/s


@dataclass(frozen=True)
class Solution:
    """Result of Robot.ik for poses of shape (..., 4, 4), with the same leading dimensions."""

    joints: NDArray[np.float64]  # (..., joints), within the joint limits, rad or m
    status: NDArray[np.str_]  # (...): "found", "nearest" (pose out of reach or beyond the limits) or "singular"
    position_error_m: NDArray[np.float64]  # (...)
    rotation_error_rad: NDArray[np.float64]  # (...)


class Robot:
    """An arm with six joints. W is the frame of the robot base, and E that of the tool; X_WE is the pose of E in W.

    Args:
        file: a .urdf or .txtpb file, or the name of a supplied robot, e.g. "ur5e".
        base_link, tip_link: links at the ends of the arm in a URDF; required if there is more than one candidate.

    Raises:
        InputError: the file is invalid; the message names the file and the line.
    """

    def __init__(self, file: str, *, base_link: str = '', tip_link: str = '') -> None:
        self._arm = _longreach.RobotArm(str(file), base_link, tip_link)
        self.name: str = self._arm.name()
        self.joints: list[Joint] = [Joint(*joint) for joint in self._arm.joints()]
        self.start: NDArray[np.float64] = np.array(self._arm.start())
        self.inverse_kind: str = self._arm.inverse_kind()

    def __repr__(self) -> str:
        return f'<Robot {self.name!r}, {len(self.joints)} joints, inverse: {self.inverse_kind}>'

    def _rows(self, joints: ArrayLike, name: str) -> tuple[NDArray[np.float64], tuple[int, ...]]:
        values = np.asarray(joints, dtype=float)
        if values.ndim == 0 or values.shape[-1] != len(self.joints):
            raise InputError(f'{name} has shape {values.shape}; its last dimension must be {len(self.joints)}, one per '
                             'joint')
        return np.ascontiguousarray(values.reshape(-1, len(self.joints))), values.shape[:-1]

    def fk(self, joints: ArrayLike) -> NDArray[np.float64]:
        """Returns the poses X_WE, shape (..., 4, 4), for joint positions of shape (..., 6), rad (prismatic: m)."""
        rows, shape = self._rows(joints, 'joints')
        return self._arm.forward(rows).reshape(*shape, 4, 4)

    def jacobian(self, joints: ArrayLike) -> NDArray[np.float64]:
        """Returns the Jacobians, shape (..., 6, joints), of the twist of E in W: angular (rad/s), then linear (m/s)."""
        rows, shape = self._rows(joints, 'joints')
        return self._arm.jacobian(rows).reshape(*shape, 6, len(self.joints))

    def _poses(self, X_WE: ArrayLike, near: ArrayLike | None) -> tuple[NDArray[np.float64], NDArray[np.float64],
                                                                       tuple[int, ...]]:
        poses = np.asarray(X_WE, dtype=float)
        if poses.ndim < 2 or poses.shape[-2:] != (4, 4):
            raise InputError(f'X_WE has shape {poses.shape}; its last two dimensions must be 4 and 4')
        shape = poses.shape[:-2]
        start = self.start if near is None else np.asarray(near, dtype=float)
        try:
            starts = np.broadcast_to(start, (*shape, len(self.joints)))
        except ValueError:
            raise InputError(f'near has shape {start.shape}; it must be {(len(self.joints),)} or one row per pose') from None
        return (np.ascontiguousarray(poses.reshape(-1, 4, 4)),
                np.ascontiguousarray(starts.reshape(-1, len(self.joints))), shape)

    def ik(self, X_WE: ArrayLike, near: ArrayLike | None = None) -> Solution:
        """Returns the preferred joint positions within the limits for each pose.

        If a pose is out of reach, returns the joint positions of the nearest pose that the arm can reach.

        Args:
            X_WE: rigid transforms, shape (..., 4, 4).
            near: joint positions that the solution should be close to, shape (6,) or (..., 6); None: `start`.
        """
        poses, starts, shape = self._poses(X_WE, near)
        joints, status, position, rotation = self._arm.nearest(poses, starts)
        return Solution(joints.reshape(*shape, len(self.joints)), np.array(status).reshape(shape),
                        position.reshape(shape), rotation.reshape(shape))

    def ik_all(self, X_WE: ArrayLike, near: ArrayLike | None = None) -> list[NDArray[np.float64]]:
        """Returns one array of shape (M, 6) per pose, with all solutions, even beyond the joint limits.

        The poses are in the flattened order of X_WE. Each angle is shifted by full turns to be as close as possible to
        `near`. If the arm has no closed form, the solutions are those found by a search from 32 starting points.
        """
        poses, starts, _ = self._poses(X_WE, near)
        return list(self._arm.all(poses, starts))
