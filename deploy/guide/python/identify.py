"""Identifies the first contact in a recording of a slave; without a file, records the experiment touch first."""

import argparse
import subprocess
import tempfile

import numpy as np

import longreach

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument('file', nargs='?', help='recording; default: a new recording of the experiment touch')
parser.add_argument('--robot', default='space_arm', help='name or file of the robot')
options = parser.parse_args()

if options.file is None:
    folder = tempfile.mkdtemp()
    subprocess.run(['longreach-lab', 'run', 'touch', '--record', '--out', folder, '--quiet'], check=True)
    options.file = folder + '/touch.mcap'

recording = longreach.read(options.file)
print('topics:', ', '.join(sorted(recording)))
ticks = recording['/slave/tick']
time = ticks['t_s']
joints = np.stack([ticks[f'input.robot.joint_rad.joint{i}'] for i in range(1, 7)], axis=1)
tool = longreach.Robot(options.robot).fk(joints)[:, :3, 3]
force = np.stack([ticks[f'input.robot.wrench.force_n.{axis}'] for axis in 'xyz'], axis=1).astype(float)

# The first contact: from 0.2 s before the touch until the force vanishes for at least 0.1 s.
touched = np.flatnonzero(np.linalg.norm(force, axis=1) > 1.0)
gaps = np.flatnonzero(np.diff(touched) > 100)
last = int(touched[gaps[0]]) if len(gaps) > 0 else int(touched[-1])
press = slice(max(0, int(touched[0]) - 200), last)
outward = force[press].sum(axis=0)
outward /= np.linalg.norm(outward)
contact = longreach.identify(time[press], -(tool[press] - tool[press][0]) @ outward, force[press] @ outward)

for name in ('k', 'lambda_', 'n', 'tangent'):
    parameter = getattr(contact, name)
    print(f'{name:8} {parameter.value:10.4g} +- {parameter.sd:.2g}  {parameter.verdict}')
print(f'depth of the tangent: {1e3 * contact.depth_m:.2f} mm')
