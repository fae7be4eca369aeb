"""Prints the displayed stiffness of a wall at round-trip times from 0 to 5 s, and plots it with python3-matplotlib."""

import sys

import longreach

FILE = sys.argv[1] if len(sys.argv) > 1 else 'delay.svg'

round_trips, displayed = [], []
for delay_ms in (0, 250, 650, 1300, 2500):
    lab = longreach.Lab({'slave.link.impairment.delay_s': f'{delay_ms}ms',
                         'master.link.impairment.delay_s': f'{delay_ms}ms'}, seed=3)
    metrics = lab.run(progress=sys.stderr.isatty())
    round_trips.append(metrics['rtt_s'])
    displayed.append(metrics['displayed_stiffness_n_per_m'])
    print(f'round trip {round_trips[-1]:5.2f} s: displayed {displayed[-1]:7.1f} N/m, '
          f'{100 * metrics["displayed_stiffness_error"]:.2f} % off')

try:
    import matplotlib

    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
except ImportError:
    print('install python3-matplotlib to get a plot')
else:
    plt.plot(round_trips, displayed, 'o-', label='displayed')
    plt.axhline(metrics['reference_stiffness_n_per_m'], color='gray', linestyle='--', label='the wall')
    plt.xlabel('round-trip time (s)')
    plt.ylabel('stiffness (N/m)')
    plt.ylim(bottom=0)
    plt.legend()
    plt.grid(True, alpha=0.3)
    plt.tight_layout()
    plt.savefig(FILE)
    print(f'plot: {FILE}')
