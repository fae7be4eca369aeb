"""The type hints of the package and of the scripts of the guide are right."""

import inspect
import subprocess
import sys
import unittest

import programs

import longreach


class Types(unittest.TestCase):
    def check(self, *files):
        done = subprocess.run([sys.executable, '-m', 'mypy', '--strict', '--cache-dir', '/dev/null', *files], capture_output=True,
                              text=True, check=False, cwd=programs.SOURCE, env={'MYPYPATH': sys.path[0], 'HOME': '/tmp'})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_package(self):
        self.check('-p', 'longreach')

    def test_guide(self):
        for file in sorted((programs.SOURCE / 'deploy' / 'guide' / 'python').glob('*.py')):
            with self.subTest(file.name):
                self.check('--ignore-missing-imports', file)

    def test_stubs_name_what_the_module_has(self):
        from longreach import _longreach

        stub = (programs.SOURCE / 'deploy' / 'python' / 'longreach' / '_longreach.pyi').read_text()
        for name, member in inspect.getmembers(_longreach):
            if name.startswith('_') and name != '__version__':
                continue
            self.assertIn(name, stub)
            if not inspect.isclass(member):
                continue
            for method in vars(member):
                if not method.startswith('_'):
                    self.assertIn(f'def {method}(', stub, f'{name}.{method}')

    def test_everything_has_a_docstring(self):
        for name in longreach.__all__:
            member = getattr(longreach, name)
            if inspect.isclass(member) and not name.startswith('_') and name not in ('Joint', 'LabState', 'Status'):
                self.assertTrue(inspect.getdoc(member), name)
