"""longreach: teleoperation of a robot with haptic devices over a delayed link.

Lab       both sides and the link in virtual time, with operator, law, estimator or robot in Python
Env       the same as a task in the form of Gymnasium
identify  stiffness, damping and exponent of a contact from measurements
Robot     kinematics of an arm from a URDF or a robot file
Client    a running master and slave
read      a recording as numpy tables
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
