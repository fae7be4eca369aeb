"""Engages, monitors and records a running demo. First start `longreach demo`, or both programs."""

import argparse

import longreach

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument('--master', default='127.0.0.1:47010')
parser.add_argument('--slave', default='127.0.0.1:47020')
parser.add_argument('--site', default='')
parser.add_argument('--seconds', type=float, default=5.0)
options = parser.parse_args()

client = longreach.Client(options.master, options.slave, site=options.site)
print(client.engage(wait_s=30.0))
print(client.scale(0.5))
try:
    client.set('master', {'mapping.scale': 7})
except longreach.InputError as error:
    print(f'refused, field {error.field}: {error}')

with client.record('drive') as files:
    for pair in client.watch(10.0, count=int(10 * options.seconds)):
        master, slave = pair.master or {}, pair.slave or {}
        print(f'{master.get("state", "?"):10} hand {1e3 * master["hand_m"][0]:6.1f} mm, '
              f'force {master["force_n"]:5.2f} N, stiffness {slave.get("stiffness_n_per_m", 0.0):7.1f} N/m')
print(*files, sep='\n')
print(client.stop())
