"""longreach: teleoperation of a robot with haptic devices over a delayed link.

Lab       both sides and the link in virtual time; the operator, law, estimator and robot can be Python objects
Env       the same simulation as an environment with the interface of Gymnasium
identify  estimates the stiffness, damping and exponent of a contact from measurements
Robot     kinematics of an arm from a URDF or a robot file
Client    access to a running master and slave
read      reads a recording into tables of numpy arrays
"""

from ._longreach import LabState, __version__
from .client import Client, Pair, Status
from .contact import Contact, Parameter, identify
from .env import Box, Env
from .errors import InputError, LongreachError, NotReachable, RecordingError, Refused
from .lab import Estimator, Hand, Lab, Law, Operator, RobotModel
from .recording import Recording, Table, read
from .robot import Joint, Robot, Solution

__all__ = ['Box', 'Client', 'Contact', 'Env', 'Estimator', 'Hand', 'InputError', 'Joint', 'Lab', 'LabState', 'Law',
           'LongreachError', 'NotReachable', 'Operator', 'Pair', 'Parameter', 'Recording', 'RecordingError', 'Refused',
           'Robot', 'RobotModel', 'Solution', 'Status', 'Table', '__version__', 'identify', 'read']
