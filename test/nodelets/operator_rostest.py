#!/usr/bin/python3
"""What an operator does beside a running system: see what it costs, look for trouble, and turn its knobs."""
import os
import subprocess
import time
import unittest
from pathlib import Path
from xmlrpc.client import ServerProxy

import dynamic_reconfigure
import rosgraph
import rospy
import rostest
import yaml
from dynamic_reconfigure.client import Client

from cabinet_articulation.msg import ArticulationModelArray

CONFIG = Path(__file__).resolve().parents[2] / 'config'
STAGES = ['stereo', 'planes', 'rectangles', 'tracking', 'articulation']
PIPELINE = ['/cabinet/manager', '/cabinet/manager_nodelets']
PATIENCE = 30


def cpu_seconds(pid):
    fields = Path('/proc/%d/stat' % pid).read_text().rsplit(')', 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def pids(nodes):
    master = rosgraph.Master('/operator_test')
    return [ServerProxy(master.lookupNode(node)).getPid('/operator_test')[2] for node in nodes]


def other_value(knobs):
    """A knob that can be turned whatever the others say: a switch, or a number."""
    for knob in knobs:
        if knob['type'] == 'bool':
            return {knob['name']: not knob['default']}
    number = next(knob for knob in knobs if knob['type'] == 'double')
    return {number['name']: (number['default'] + number['max']) / 2}


class Operator(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for stage in STAGES:
            rospy.wait_for_service('/cabinet/%s/set_parameters' % stage, PATIENCE)

    def test_1_nobody_listens_and_it_costs_next_to_nothing(self):
        shares = []
        # The least of several: starting up, and others on the same machine, are not what is measured.
        for _ in range(8):
            processes = pids(PIPELINE)
            before, start = sum(map(cpu_seconds, processes)), time.monotonic()
            time.sleep(3)
            shares.append((sum(map(cpu_seconds, processes)) - before) / (time.monotonic() - start))
            if shares[-1] < 0.02:
                break
        self.assertLess(min(shares), 0.02, 'share of a core: %s' % shares)

    def test_2_roswtf_finds_nothing_wrong(self):
        models = []
        subscriber = rospy.Subscriber('/cabinet/models', ArticulationModelArray, models.append)
        end = time.monotonic() + PATIENCE
        while not models and time.monotonic() < end:
            time.sleep(0.1)
        self.assertTrue(models, 'the pipeline does not work')
        # Away from any package, so that only the running system is judged.
        output = subprocess.run(['roswtf'], cwd='/', stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=True,
                                universal_newlines=True).stdout
        subscriber.unregister()
        self.assertIn('Online checks summary:\n\nNo errors or warnings', output)

    def test_3_rqt_reconfigure_shows_and_sets_what_the_files_say(self):
        found = dynamic_reconfigure.find_reconfigure_services()
        for stage in STAGES:
            name = '/cabinet/' + stage
            self.assertIn(name, found)
            client = Client(name, timeout=PATIENCE)
            shown = client.get_configuration(PATIENCE)
            in_file = yaml.safe_load((CONFIG / (stage + '.yaml')).read_text())
            knobs = client.get_parameter_descriptions(PATIENCE)
            self.assertGreater(len(knobs), 5, stage)
            for knob in knobs:
                self.check(stage + '/' + knob['name'], knob, shown[knob['name']], in_file[knob['name']])
            changed = other_value(knobs)
            answer = client.update_configuration(changed)
            for key, value in changed.items():
                self.assertEqual(answer[key], value, stage)
                self.assertEqual(rospy.get_param(name + '/' + key), value, stage)
            client.update_configuration({key: in_file[key] for key in changed})
            client.close()

    def check(self, where, knob, shown, in_file):
        self.assertEqual(knob['default'], in_file, where)
        self.assertEqual(shown, in_file, where)
        self.assertTrue(knob['description'], where)
        if knob['edit_method']:
            # rqt_reconfigure evaluates the text to offer the choices.
            self.assertIn(knob['default'], [choice['value'] for choice in eval(knob['edit_method'])['enum']], where)
        elif knob['type'] in ('int', 'double'):
            self.assertLessEqual(knob['min'], knob['default'], where)
            self.assertLessEqual(knob['default'], knob['max'], where)


if __name__ == '__main__':
    rospy.init_node('operator_test')
    rostest.rosrun('cabinet_articulation', 'operator_test', Operator)
