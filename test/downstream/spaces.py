"""What a user's shell would do: install what was built, source one space alone, and run commands there."""
import os
import shutil
import signal
import socket
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = 'cabinet_articulation'
BUILD = Path(os.environ['CABINET_ARTICULATION_BUILD'])
DEVEL = Path(os.environ['CABINET_ARTICULATION_DEVEL'])
INSTALL = Path(os.environ['CABINET_ARTICULATION_INSTALL'])
SCRATCH = BUILD / 'downstream'
PATIENCE = 200  # [s]

IN_SPACE = 'for space in /opt/ros/noetic "$0"; do [ ! -f "$space/setup.sh" ] || . "$space/setup.sh"; done; exec "$@"'


def environment(**variables):
    """That of a new shell: nothing of a workspace that is sourced now."""
    kept = {name: os.environ[name] for name in ('HOME', 'LANG', 'TMPDIR') if name in os.environ}
    return dict(kept, PATH='/usr/bin:/bin:/usr/sbin:/sbin', ROS_HOME=str(SCRATCH / 'ros_home'), **variables)


def run(space, *command, cwd=None, status=0, **variables):
    """The output of a command in a space. Raises with all of it if the command ends with another status."""
    result = subprocess.run(['bash', '-c', IN_SPACE, str(space), *map(str, command)], env=environment(**variables), cwd=cwd,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=PATIENCE)
    if result.returncode != status:
        raise AssertionError('%s: exit status %d\n%s' % (' '.join(map(str, command)), result.returncode, result.stdout))
    return result.stdout


def own_master():
    """A port that is free, and the variables by which programs find a master there."""
    with socket.socket() as probe:
        probe.bind(('', 0))
        port = probe.getsockname()[1]
    return port, {'ROS_MASTER_URI': 'http://localhost:%d' % port, 'ROS_HOSTNAME': 'localhost'}


class Running:
    """A command that runs in a space until the end of the block; `output` is all it said by then."""

    def __init__(self, space, *command, **variables):
        self.log = SCRATCH / 'running.log'
        self.arguments = ['bash', '-c', IN_SPACE, str(space), *map(str, command)]
        self.environment = environment(**variables)

    def __enter__(self):
        with self.log.open('w') as log:
            self.process = subprocess.Popen(self.arguments, env=self.environment, stdout=log, stderr=subprocess.STDOUT)
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(60)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise

    @property
    def output(self):
        return self.log.read_text()


class InstalledPackage(unittest.TestCase):
    """Tests that need what `make install` installs. It is removed after them: it lies in the source tree, and roslaunch would
    find two of each launch file there."""

    @classmethod
    def setUpClass(cls):
        cls.tearDownClass()
        SCRATCH.mkdir(exist_ok=True)
        subprocess.run(['cmake', '--install', str(BUILD)], check=True, stdout=subprocess.DEVNULL, env=environment())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(str(INSTALL), ignore_errors=True)
