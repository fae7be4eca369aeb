"""The programs of the build, for tests that compare with them or drive them."""

import contextlib
import os
import pathlib
import socket
import subprocess
import tempfile

BUILD = pathlib.Path(os.environ['LONGREACH_BUILD'])
SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent


def run(program, *arguments, **options):
    """Output of a program that must succeed."""
    done = subprocess.run([BUILD / 'bin' / program, *map(str, arguments)], capture_output=True, text=True, check=False,
                          timeout=300, **options)
    if done.returncode != 0:
        raise AssertionError(f'{program} {arguments}: status {done.returncode}\n{done.stdout}{done.stderr}')
    return done.stdout


def free_ports(count):
    """Ports that are free at present."""
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(('127.0.0.1', 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


@contextlib.contextmanager
def running_pair():
    """Slave and master with certificates of their own; yields their RPC addresses, the site and the folder of recordings."""
    slave_rpc, master_rpc, link = free_ports(3)
    slave, master = f'127.0.0.1:{slave_rpc}', f'127.0.0.1:{master_rpc}'
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as stack:
        for program, options in (
                ('longreach-slave', ['--set', f'link.listen=127.0.0.1:{link}', '--set', f'rpc.listen={slave}']),
                ('longreach-master', ['--set', f'link.slave=127.0.0.1:{link}', '--set', f'rpc.listen={master}', '--set',
                                      f'link.slave_rpc={slave}', '--operator', 'script'])):
            one = subprocess.Popen([BUILD / 'bin' / program, '--site', f'{folder}/site', '--recordings', f'{folder}/recordings',
                                    *options],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            stack.callback(one.wait)
            stack.callback(one.terminate)
        yield master, slave, f'{folder}/site', pathlib.Path(folder) / 'recordings'
