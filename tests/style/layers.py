"""The layers, which define the folders that a file may include: its own folder and the folders of lower layers.

A folder of the table includes its subfolders, unless they are in the table themselves. Folders of the same layer may not
include each other. The stages of a side are in the order of the data flow: a stage may include those whose output it uses,
but not those that use its output.
"""

import posixpath

LAYERS = [
    ['common/core', 'common/spatial', 'common/text'],
    ['common/schema'],
    # Structs that proto/structs.cpp writes; in build/PRESET/generated.
    ['schema'],
    ['common/link'],
    ['common/safety', 'common/crypto'],
    ['slave/robot'],
    ['master/config', 'slave/config'],
    # Stages, and the node that connects them.
    ['master/devices/drive', 'slave/simulation/scene', 'slave/kinematics', 'master/safety', 'slave/safety'],
    ['master/devices/delta', 'master/devices/spherical', 'slave/sensing'],
    ['master/devices', 'slave/command', 'slave/simulation'],
    ['master/mapping', 'master/simulation', 'slave/estimation'],
    ['master/rendering'],
    ['master', 'slave'],
    # Bytes, files, threads.
    ['proto'],
    ['common/messages'],
    ['common/wire'],
    ['common/config', 'common/loop'],
    ['master/side', 'slave/side'],
    ['common/recording', 'common/net', 'common/site'],
    ['common/program'],
    ['common/rpc'],
    ['master/recording', 'slave/recording', 'master/drivers', 'slave/drivers', 'master/input'],
    ['master/console'],
    ['master/desk'],
    # Programs. The laboratory also simulates robots in MuJoCo.
    ['deploy/mujoco'],
    ['master/program', 'slave/program', 'deploy/cli', 'deploy/adapters', 'deploy/wire', 'deploy/lab'],
    ['deploy/library'],
    ['deploy/python'],
    ['tests'],
]
LAYER = {folder: number for number, folders in enumerate(LAYERS) for folder in folders}
PURE = {folder for folder, number in LAYER.items() if number <= LAYER['master']}   # no clocks, threads, output or random numbers
BOTH_SIDES = {'deploy/lab', 'deploy/library', 'deploy/python', 'tests'}             # may include master and slave
SHARED = {'master/config', 'slave/config'}       # folders of the sides that common/config may include
# Folders of the sides that the client and longreach-mujoco may include, to describe robots and devices.
DESCRIBED = {'slave/config', 'slave/kinematics', 'master/config', 'master/devices'}
ADAPTER = 'common/link/adapter_datagram.hpp'


def room(path):
    """The folder of the table that contains a file or an included path; None if there is none."""
    folder = posixpath.dirname(path)
    while folder and folder not in LAYER:
        folder = posixpath.dirname(folder)
    return folder or None


def layer(path):
    """The layer of a path; None if the table has no folder for it."""
    return LAYER.get(room(path))


def is_pure(path):
    return room(path) in PURE


def side(path):
    first = path.split('/')[0]
    return first if first in ('master', 'slave') else None


def refused(path, included):
    """Why `path` may not include `included`; None if it may."""
    if included == 'commit.hpp':   # written by the build
        return None
    if path.startswith('deploy/adapters/') and included != ADAPTER:
        return f'is copied by vendors and may include {ADAPTER} alone'
    if layer(path) is None:
        return 'lies in a folder that has no layer'
    if room(path) == 'tests':
        return None
    if layer(included) is None:
        return f'includes {included}, whose folder has no layer'
    other_side = side(included)
    if other_side and side(path) != other_side and room(path) not in BOTH_SIDES:
        if not (room(path) == 'common/config' and room(included) in SHARED
                or room(path) in ('deploy/cli', 'deploy/mujoco') and room(included) in DESCRIBED):
            return f'includes {included} of the {other_side}, which only that side, the laboratory and tests/ may see'
    if room(included) == room(path) or layer(included) < layer(path):
        return None
    return f'is in {room(path)}, layer {layer(path)}, and includes {included} of layer {layer(included)}'
