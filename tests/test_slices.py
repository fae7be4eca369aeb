#!/usr/bin/env python3
"""Checks that tests/slices resumes after being killed and runs a failed slice again, with tests that record their runs."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

SLICES = pathlib.Path(__file__).resolve().parent / "slices"


def build_of(folder, script):
    """A build with 42 quick tests and two studies. Each test runs `script NAME`."""
    names = [f"quick_{i}" for i in range(42)] + ["study_a", "study_b"]
    lines = [f'add_test({name} "/bin/sh" "{script}" "{name}")' for name in names]
    lines += [f"set_tests_properties({name} PROPERTIES LABELS study)" for name in names[-2:]]
    pathlib.Path(folder, "CTestTestfile.cmake").write_text("\n".join(lines) + "\n")


def main():
    with tempfile.TemporaryDirectory() as text:
        folder = pathlib.Path(text)
        script, ran, wait = folder / "script", folder / "ran", folder / "wait"
        script.write_text(f"echo $1 >> {ran}\n[ $1 != study_b ] || [ ! -e {wait} ] || sleep 60\n"
                          f"[ $1 != quick_41 ] || [ ! -e {folder}/broken ]\n")
        build_of(folder, script)
        wait.touch()
        (folder / "broken").touch()
        command = [str(SLICES), text, str(folder / "passed"), "2"]
        first = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                 start_new_session=True)
        while not ran.exists() or "study_b" not in ran.read_text():
            time.sleep(0.05)
        assert os.getpgid(first.pid) == first.pid, "tests/slices has no process group of its own"
        os.killpg(first.pid, signal.SIGKILL)
        first.wait()
        assert ran.read_text().split() == ["study_a", "study_b"], ran.read_text()
        wait.unlink()
        assert subprocess.run(command, capture_output=True, check=False).returncode == 1
        names = ran.read_text().split()
        assert names.count("study_a") == 1 and names.count("study_b") == 2, "a passed slice was run again"
        assert names.count("quick_0") == 1 and names.count("quick_41") == 1, names
        (folder / "broken").unlink()
        assert subprocess.run(command, capture_output=True, check=False).returncode == 0
        names = ran.read_text().split()
        assert names.count("quick_0") == 1 and names.count("quick_41") == 2, names
        assert subprocess.run(command, capture_output=True, check=False).returncode == 0
        assert ran.read_text().split() == names, "passed slices were run again"
    print("tests/slices resumes")


if __name__ == "__main__":
    sys.exit(main())
