"""longreach.identify against known contacts, and longreach.read against the CSV export."""

import csv
import math
import pathlib
import subprocess
import tempfile
import time
import unittest

import numpy as np
import programs

import longreach


def press(count, k=3e4, a=0.1, n=1.3, surface_m=0.01, noise_n=0.02, seed=1):
    """Time, position and force of a press that oscillates: F = k x^n (1 + a v)."""
    t = np.arange(count) * 1e-3
    x = surface_m - 0.002 + 0.006 * (1.0 - np.cos(2.0 * t)) / 2.0 + 0.001 * np.sin(9.0 * t)
    v = np.gradient(x, t)
    depth = np.maximum(x - surface_m, 0.0)
    f = np.maximum(k * depth**n * (1.0 + a * v), 0.0)
    return t, x, f + noise_n * np.random.default_rng(seed).standard_normal(count)


class Identify(unittest.TestCase):
    def test_parameters_are_found_within_their_uncertainty(self):
        contact = longreach.identify(*press(8000))
        self.assertTrue(contact.valid and contact.law_fits)
        for name, truth in (('k', 3e4), ('lambda_', 3e3), ('n', 1.3), ('surface', 0.01)):
            parameter = getattr(contact, name)
            with self.subTest(name, value=parameter.value, sd=parameter.sd):
                self.assertLess(abs(parameter.value - truth), 4.0 * parameter.sd + 0.01 * truth)
        self.assertTrue(contact.n.identified)
        depth = contact.depth_m
        self.assertAlmostEqual(contact.force(depth) / (3e4 * depth**1.3), 1.0, delta=0.02)

    def test_a_known_surface_and_depth_are_used(self):
        contact = longreach.identify(*press(4000), surface=0.01, depth=0.002)
        self.assertEqual(contact.surface.value, 0.01)
        self.assertEqual(contact.depth_m, 0.002)
        self.assertAlmostEqual(contact.tangent.value / (3e4 * 1.3 * 0.002**0.3), 1.0, delta=0.05)

    def test_too_little_is_no_result(self):
        t = np.arange(50) * 1e-3
        contact = longreach.identify(t, np.zeros(50), np.zeros(50))
        self.assertEqual(contact.k.verdict, 'too few samples')

    def test_bad_arrays_are_refused(self):
        t, x, f = press(100)
        for arguments, why in (((t, x[:-1], f), 'must be equal'), ((t[::-1], x, f), 'not later'),
                               ((t, x, f.reshape(10, 10)), '2 dimensions'), ((t[:2], x[:2], f[:2]), 'at least three')):
            with self.subTest(why), self.assertRaisesRegex(longreach.InputError, why):
                longreach.identify(*arguments)
        x[7] = math.nan
        with self.assertRaisesRegex(longreach.InputError, 'sample 7 is not finite'):
            longreach.identify(t, x, f)
        with self.assertRaises(longreach.InputError) as raised:
            longreach.identify(*press(100), force_noise=-1.0)
        self.assertEqual(raised.exception.field, 'force_noise_n')

    def test_a_million_samples_take_at_most_1_5_times_the_time_of_cpp(self):
        count = 1_000_000
        t, x, f = press(count)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / 'samples'
            np.stack((t, x, f)).tofile(file)
            answer = subprocess.run([programs.BUILD / 'bin' / 'identify_time', file, str(count)], capture_output=True,
                                    text=True, check=True).stdout.split()
        times = []
        for _ in range(3):
            start = time.process_time()
            contact = longreach.identify(t, x, f)
            times.append(time.process_time() - start)
        print(f'C++ {float(answer[0]):.3f} s, Python {min(times):.3f} s: {min(times) / float(answer[0]):.2f} times')
        self.assertEqual(float(answer[1]), contact.k.value)
        self.assertLess(min(times), 1.5 * float(answer[0]))


class Read(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        programs.run('longreach-lab', 'run', 'touch', '--record', '--out', cls.folder.name, '--quiet')
        cls.file = pathlib.Path(cls.folder.name) / 'touch.mcap'
        cls.recording = longreach.read(cls.file)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_tables_are_those_of_the_csv_export(self):
        out = pathlib.Path(self.folder.name) / 'tables'
        programs.run('longreach', 'record', 'export', self.file, '--out', out)
        files = {file.stem: file for file in out.rglob('*.csv')}
        self.assertTrue(self.recording.whole)
        self.assertEqual(len(files), len(self.recording))
        for topic, table in self.recording.items():
            with self.subTest(topic), open(files[topic.lstrip('/').replace('/', '_')], encoding='utf-8') as file:
                rows = list(csv.DictReader(file))
                self.assertEqual(set(rows[0]), set(table))
                self.assertEqual(len(rows), len(table['t_s']))
                for name, column in table.items():
                    for row, value in list(zip(rows, column))[::501]:
                        if column.dtype.kind == 'U':
                            self.assertEqual(row[name], str(value))
                        elif row[name] == '':
                            self.assertTrue(math.isnan(value))
                        else:
                            self.assertEqual(float(row[name]), float(value))

    def test_pandas_gets_a_frame(self):
        table = next(iter(self.recording.values()))
        frame = table.to_pandas()
        self.assertEqual(len(frame), len(table['t_s']))

    def test_what_is_no_recording_is_refused(self):
        with self.assertRaises(longreach.RecordingError):
            longreach.read(__file__)
        with self.assertRaises(longreach.RecordingError):
            longreach.read('/nowhere.mcap')
