"""Builds the extension module with CMake: pip install --no-build-isolation --no-deps ./deploy/python

LONGREACH_BUILD names a build folder to use (default: build/python in the source tree); what is built there is not built again.
"""

import os
import pathlib
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent


class CMakeBuild(build_ext):
    """Builds the target longreach_python and copies it, and the files that a user edits, next to the Python files."""

    def build_extension(self, ext):
        build = pathlib.Path(os.environ.get('LONGREACH_BUILD', SOURCE / 'build' / 'python'))
        if not (build / 'CMakeCache.txt').exists():
            subprocess.run(['cmake', '-S', SOURCE, '-B', build, '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release',
                            '-DBUILD_TESTING=OFF', '-DLONGREACH_PYTHON=ON', f'-DPython_EXECUTABLE={sys.executable}'],
                           check=True)
        subprocess.run(['cmake', '--build', build, '--target', 'longreach_python', '-j2'], check=True)
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(next((build / 'python' / 'longreach').glob('_longreach*.so')), target)
        for folder in ('config', 'devices', 'links', 'robots', 'scenes'):
            shutil.copytree(SOURCE / 'deploy' / folder, target.parent / 'share' / 'longreach' / folder,
                            dirs_exist_ok=True)


setup(ext_modules=[Extension('longreach._longreach', sources=[])], cmdclass={'build_ext': CMakeBuild})
