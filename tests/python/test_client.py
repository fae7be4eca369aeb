"""longreach.Client against a running pair."""

import subprocess
import sys
import time
import unittest

import programs

import longreach


class Client(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = programs.running_pair()
        master, slave, cls.site, cls.folder = cls.stack.__enter__()
        cls.addresses = (master, slave)
        cls.client = longreach.Client(master, slave, site=cls.site)
        end = time.monotonic() + 60.0
        while cls.client.pair().master is None or cls.client.pair().slave is None:
            if time.monotonic() > end:
                raise AssertionError(str(cls.client.pair()))
            time.sleep(0.1)

    @classmethod
    def tearDownClass(cls):
        cls.stack.__exit__(None, None, None)

    def test_status_settings_and_link(self):
        client = self.client
        self.assertEqual(client.status('slave')['side'], 'slave')
        self.assertEqual(client.status('slave')['slave_view']['clamps']['force_guard'], False)
        self.assertIn('moved_out_m', client.status('master')['master_view'])
        self.assertIn('was set', client.set('master', {'mapping.scale': 0.5}))
        self.assertIn('0.5', client.get('mapping.scale'))
        client.link(delay='20ms')
        self.assertAlmostEqual(client.status('master')['impairment']['delay_s'], 0.02)
        client.link('lab')

    def test_errors_carry_the_field(self):
        with self.assertRaises(longreach.InputError) as raised:
            self.client.set('master', {'mapping.scale': 7})
        self.assertEqual(raised.exception.field, 'mapping.scale')
        with self.assertRaises(longreach.InputError) as raised:
            self.client.set('slave', {'no.such': 1})
        self.assertEqual(raised.exception.field, 'no.such')
        with self.assertRaises(longreach.InputError):
            self.client.mode('sideways')
        port = programs.free_ports(1)[0]
        for client in (longreach.Client(f'127.0.0.1:{port}', site=self.site, timeout_s=1.0),
                       longreach.Client(*self.addresses, site=self.site + '/none'),
                       longreach.Client(*self.addresses, insecure=True)):
            with self.assertRaises(longreach.NotReachable):
                client.status()

    def test_engages_records_watches_and_stops(self):
        client = self.client
        self.engage()
        with client.record('python', max_mb=50) as files:
            seen = [pair for pair in client.watch(20.0, count=10)]
        self.assertEqual(len(seen), 10)
        self.assertEqual(len(files), 2)
        self.assertGreater(seen[-1].slave['uptime_s'], seen[0].slave['uptime_s'])
        recordings = sorted(self.folder.rglob('*.mcap'))
        self.assertEqual(len(recordings), 2)
        for file in recordings:
            self.assertGreater(len(longreach.read(file)), 0)
        client.stop()
        end = time.monotonic() + 30.0
        while client.status('slave')['state'] != 'Stopped':
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)

    def engage(self):
        """Again where a stall of the machine ended the engagement."""
        for _ in range(5):
            try:
                self.client.engage(wait_s=10.0)
                return
            except longreach.Refused as error:
                print(error)
        raise AssertionError(str(self.client.pair()))

    def test_laboratory_and_client_share_a_process_in_both_orders(self):
        make = {'Lab': 'longreach.Lab(seed=1).run(until=1.0)',
                'Client': f'print(longreach.Client({self.addresses[0]!r}, {self.addresses[1]!r}, site={self.site!r}).status()["side"])'}
        for order in (('Lab', 'Client'), ('Client', 'Lab')):
            script = 'import longreach\n' + '\n'.join(f'from longreach import {name}\n{make[name]}' for name in order)
            done = subprocess.run([sys.executable, '-c', script], capture_output=True, text=True, check=False,
                                  env={'PYTHONPATH': sys.path[0]}, timeout=120)
            self.assertEqual((done.returncode, done.stdout.strip()), (0, 'master'), done.stderr)
