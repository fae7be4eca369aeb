"""The floors: which folder may include which. A file includes its own folder and lower floors only.

Within the stages of a side the order is that of the flow, so a stage sees the stages whose output it takes and none of
those that it feeds. A haptic device is built from its drives upwards. At the slave that is the way of the force: what
the scene presses, the sensor feels and the robot meets; command and estimation work on the robot's state. Within floor 4: bytes,
then configuration, then recordings, then I/O, then what a program shows and serves.
"""

import posixpath
import re

FOLDERS = {
    'common/core': 0, 'common/spatial': 0,
    'common/link': 1, 'common/crypto': 1,
    'master/devices/drive': 2.0, 'master/devices/delta': 2.01, 'master/devices/spherical': 2.01,
    'master/devices': 2.02, 'master/mapping': 2.1, 'master/rendering': 2.2,
    'slave/scene': 2.0, 'slave/robot': 2.1, 'slave/command': 2.2, 'slave/sensing': 2.05, 'slave/estimation': 2.4,
    'slave/comparison': 2.4,
    'master': 3, 'slave': 3,
    'proto': 4.0, 'common/wire': 4.1, 'common/config': 4.2, 'common/io/clock': 4.05, 'common/io/recording': 4.25, 'common/io/manual': 4.25,
    'common/io': 4.3, 'master/console': 4.4,
    'master/drivers': 4.35, 'slave/drivers': 4.35,
    'deploy/cli': 5, 'deploy/adapters': 5, 'tests': 6,
}
SERVICE, PROGRAM = 4.4, 5
PURE_BELOW = 4   # floors 0 to 3
ADAPTER = 'common/link/adapter_datagram.hpp'


def floor(path):
    """Floor of a file or of an included path; none where the table does not know its folder."""
    name = posixpath.basename(path)
    folder = posixpath.dirname(path)
    if path == 'commit.hpp':   # written by the build
        return 0
    if folder in ('master', 'slave'):
        if name == 'main.cpp' or name.startswith(('housekeeping.', 'hand_poll.')):
            return PROGRAM
        if re.search(r'_(service|shell|tape)\.[ch]pp$', name):
            return SERVICE
    while folder and folder not in FOLDERS:
        folder = posixpath.dirname(folder)
    return FOLDERS.get(folder)


def side(path):
    first = path.split('/')[0]
    return first if first in ('master', 'slave') else None


def is_config(path):
    return path.endswith('_config.hpp')


def refused(path, included):
    """Why `path` may not include `included`; none if it may."""
    mine, theirs = floor(path), floor(included)
    if path.startswith('deploy/adapters/') and included != ADAPTER:
        return f'is copied by vendors and may include {ADAPTER} alone'
    if mine is None:
        return 'lies in a folder that has no floor'
    if path.startswith('tests/'):
        return None
    if theirs is None:
        return f'includes {included}, whose folder has no floor'
    own_side, other_side = side(path), side(included)
    if other_side and own_side != other_side:
        if not (path.startswith('common/config/') and is_config(included)):
            return f'includes {included} of the {other_side}, which only that side and tests/ may see'
    same_folder = posixpath.dirname(path) == posixpath.dirname(included)
    # Configuration is plain values: every stage may read that of its side.
    plain = own_side == other_side and 2 <= mine < 3 and 2 <= theirs <= 3 and is_config(included)
    if theirs < mine or (same_folder and theirs <= mine) or plain:
        return None
    return f'is on floor {mine:g} and includes {included} of floor {theirs:g}'
