#!/usr/bin/python3
"""All that is installed works from the install space alone, without the source tree, the build and the devel space."""
import re
import unittest
from pathlib import Path

from spaces import BUILD, DEVEL, INSTALL, PACKAGE, ROOT, SCRATCH, InstalledPackage, Running, own_master, run

SHARE = INSTALL / 'share' / PACKAGE
PROGRAMS = INSTALL / 'lib' / PACKAGE
ELF = b'\x7fELF'

# Waits for a joint that was seen often enough to be kept, by what was installed for Python.
WATCH = '''
import threading
import rospy
from cabinet_articulation.msg import ArticulationModelArray
known = threading.Event()
def look(message):
    for model in message.models:
        if model.support > 0 and model.observations >= 10 and not known.is_set():
            print('type %d' % model.type)
            known.set()
rospy.init_node('watch')
rospy.Subscriber('/cabinet/models', ArticulationModelArray, look)
known.wait()
'''


def here(*command, **options):
    return run(INSTALL, *command, **options)


def rosrun(program, *arguments, **options):
    return here('rosrun', PACKAGE, program, *arguments, cwd=str(SCRATCH), **options)


def installed(*folders):
    found = [path for folder in folders for path in sorted((INSTALL / folder).rglob('*')) if path.is_file()]
    assert found, folders
    return found


class InstallSpace(InstalledPackage):
    def test_nothing_refers_to_the_source_tree(self):
        trees = '|'.join(re.escape(str(tree)) for tree in (ROOT, BUILD, DEVEL))
        named = re.compile((r'(?:%s)(?![\w.-])[\w./+-]*' % trees).encode())
        wrong = []
        for path in installed('.'):
            # The generator of messages compiles them in the devel space, and Python keeps that name for backtraces.
            if path.suffix == '.pyc':
                continue
            data = path.read_bytes()
            for name in map(bytes.decode, named.findall(data)):
                # Log messages carry the names of sources.
                is_source = data.startswith(ELF) and name.endswith(('.cpp', '.h'))
                if not is_source and Path(name) != INSTALL and INSTALL not in Path(name).parents:
                    wrong.append('%s: %s' % (path.relative_to(INSTALL), name))
        self.assertEqual([], wrong)

    def test_programs_and_libraries_find_their_libraries(self):
        binaries = [path for path in installed('lib') if path.read_bytes()[:4] == ELF]
        text = here('ldd', *binaries)
        self.assertNotIn('not found', text)
        own = set(re.findall(r'lib%s_\w+\.so => (\S+)/' % PACKAGE, text))
        self.assertEqual({str(INSTALL / 'lib')}, own)

    def test_ros_finds_all_parts(self):
        self.assertEqual(str(SHARE), here('rospack', 'find', PACKAGE).strip())
        plugins = here('rospack', 'plugins', '--attrib=plugin', 'nodelet')
        self.assertIn('%s %s/nodelet_plugins.xml\n' % (PACKAGE, SHARE), plugins)
        plugins = here('rospack', 'plugins', '--attrib=plugin', 'rviz')
        self.assertIn('%s %s/rviz_plugins.xml\n' % (PACKAGE, SHARE), plugins)
        for folder in ('config', 'config/paper', 'launch', 'msg', 'srv', 'rviz'):
            source, copy = ({path.name for path in (root / folder).iterdir() if path.is_file()} for root in (ROOT, SHARE))
            self.assertEqual(source, copy)
        names = [path.stem for path in sorted((ROOT / 'msg').glob('*.msg')) + sorted((ROOT / 'srv').glob('*.srv'))]
        imports = 'from {0}.msg import *; from {0}.srv import *; print({1}); import {0}; print({0}.__file__)'
        text = here('/usr/bin/python3', '-c', imports.format(PACKAGE, ', '.join(names)))
        self.assertIn(str(INSTALL / 'lib'), text.splitlines()[-1])
        self.assertEqual((SHARE / 'msg/Track.msg').read_text().split(), here('rosmsg', 'show', '-r', PACKAGE + '/Track').split())

    def test_launch_files_are_complete(self):
        # description.launch asks a running pipeline, and is loaded below.
        files = [path for path in installed('share/%s/launch' % PACKAGE) if path.stem != 'description']
        check = ('import sys; from roslaunch.rlutil import check_roslaunch\n'
                 'print([check_roslaunch(name, False, True) for name in sys.argv[1:]])')
        self.assertEqual(str([None] * len(files)), here('/usr/bin/python3', '-c', check, *files).splitlines()[-1])

    def test_tools_that_need_no_master(self):
        self.assertEqual((SHARE / 'config/planes.yaml').read_text(), rosrun('print_config', 'planes'))
        for name in ('a', 'b'):
            rosrun('simulated_bag', 'drawer', 'drawer.bag', '--first', '30', '--frames', '6')
            self.assertIn('6 frames', rosrun('process_bag', 'drawer.bag', name + '.bag', '--config', SHARE / 'config'))
        rosrun('compare_results.py', 'a.bag', 'b.bag')
        self.assertIn('usage: compare_live.sh', rosrun('compare_live.sh', status=2))
        # A handle 0.2 m from a wall that is pulled out by 0.3 m, and a front 1 m away before a wall.
        (SCRATCH / 'drawer.log').write_text(''.join('0.2 %f 1 0 0 0 1\n' % (0.01 * i) for i in range(31)))
        self.assertIn(',prismatic,', rosrun('fit_track', 'drawer.log'))
        wall = [[1000 if 200 <= u < 400 and 180 <= v < 280 else 1500 for u in range(640)] for v in range(480)]
        rows = '\n'.join(' '.join(map(str, row)) for row in wall)
        (SCRATCH / 'depth.pgm').write_text('P2 640 480 65535\n%s\n' % rows)
        rosrun('detect_image', 'depth.pgm', 'overlay.png', '--fx', '500')
        self.assertGreater((SCRATCH / 'overlay.png').stat().st_size, 1000)

    def test_a_launch_learns_and_tools_talk_to_it(self):
        port, master = own_master()
        with Running(INSTALL, 'roslaunch', '-p', port, PACKAGE, 'demo.launch', 'scene:=drawer', **master) as demo:
            # Rospy waits for the master.
            seen = here('/usr/bin/python3', '-c', WATCH, **master)
            self.assertEqual('type 1', seen.splitlines()[-1])
            self.assertIn('type="prismatic"', rosrun('export_urdf', '__ns:=cabinet', **master))
            self.assertIn('/robot_state_publisher\n', here('roslaunch', '--nodes', PACKAGE, 'description.launch', **master))
            pid = re.search(r'^Pid: (\d+)$', here('rosnode', 'info', '/cabinet/manager', **master), re.M).group(1)
            libraries = set(re.findall(r'/\S*lib%s_\w+\.so' % PACKAGE, Path('/proc/%s/maps' % pid).read_text()))
            self.assertIn(str(INSTALL / 'lib' / ('lib%s_nodelets.so' % PACKAGE)), libraries)
            self.assertEqual([], [name for name in libraries if Path(name).parent != INSTALL / 'lib'])
        self.assertNotRegex(demo.output, r'\[(WARN|ERROR|FATAL)\]|process has died')


if __name__ == '__main__':
    unittest.main()
