"""The scripts of the guide run."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import programs

GUIDE = programs.SOURCE / 'deploy' / 'guide' / 'python'


class Guide(unittest.TestCase):
    def script(self, name, *arguments):
        environment = {**os.environ, 'PYTHONPATH': sys.path[0],
                       'PATH': f'{programs.BUILD / "bin"}:{os.environ["PATH"]}'}
        done = subprocess.run([sys.executable, GUIDE / name, *map(str, arguments)], capture_output=True, text=True,
                              check=False, env=environment, timeout=240)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        print(done.stdout)
        return done.stdout

    def test_delay(self):
        with tempfile.TemporaryDirectory() as folder:
            plot = pathlib.Path(folder) / 'delay.svg'
            said = self.script('delay.py', plot)
            self.assertEqual(said.count('displayed'), 5)
            self.assertTrue(plot.read_text(encoding='utf-8').startswith('<?xml'))

    def test_identify(self):
        said = self.script('identify.py')
        tangent = next(line.split() for line in said.splitlines() if line.startswith('tangent'))
        self.assertAlmostEqual(float(tangent[1]), 1000.0, delta=60.0)

    def test_own_law(self):
        said = {line[:13].strip(): line for line in self.script('own_law.py').splitlines()}
        force = {name: float(line.split('up to')[1].split()[0]) for name, line in said.items()}
        self.assertGreater(force['longreach'], 0.5)
        self.assertGreater(force['naive spring'], 0.5)
        self.assertEqual(force['no force'], 0.0)

    def test_drive(self):
        with programs.running_pair() as (master, slave, site, _):
            said = self.script('drive.py', '--master', master, '--slave', slave, '--site', site, '--seconds', 2)
        self.assertIn('field mapping.scale', said)
        self.assertEqual(said.count('stiffness'), 20)
