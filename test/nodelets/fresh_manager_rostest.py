#!/usr/bin/python3
"""Managers and loaders that end and are started anew: the nodelets are there again, and what was learned is saved."""
import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path
from xmlrpc.client import ServerProxy

import rosgraph
import rospy
import rostest
from roslib.packages import find_node

from cabinet_articulation.msg import ArticulationModelArray

PATIENCE = 30
LOADERS = 24


def start(package, program, *arguments):
    # Connections within one computer are refused in an instant, and that is when a loader may take a dead one for good.
    environment = dict(os.environ, ROS_NAMESPACE='/cabinet', ROS_HOSTNAME='localhost')
    return subprocess.Popen([find_node(package, program)[0], *arguments], env=environment)


def wait_until(done):
    give_up = time.monotonic() + PATIENCE
    while not done() and time.monotonic() < give_up:
        time.sleep(0.05)
    return done()


def services():
    return {name for name, _ in rosgraph.Master('/fresh_manager_test').getSystemState()[2]}


def is_established(model):
    return model.moved and model.support > 0


def rosnode_kill(process):
    ServerProxy(rosgraph.Master('/fresh_manager_test').lookupNode('/cabinet/manager')).shutdown('/fresh_manager_test', 'test')


class FreshManager(unittest.TestCase):
    def setUp(self):
        self.running = {}
        self.addCleanup(self.end_all)

    def end_all(self):
        for name in list(self.running):
            self.end(name, signal.SIGKILL)

    def start_manager(self):
        self.running['manager'] = start('nodelet', 'nodelet', 'manager', '__name:=manager')

    def start_loader(self, nodelet, stage):
        self.running[nodelet] = start('cabinet_articulation', 'load_nodelets', 'manager',
                                      '%s=cabinet_articulation/%s' % (nodelet, stage), '__name:=%s_loader' % nodelet)

    def end(self, name, how):
        process = self.running.pop(name)
        how(process) if callable(how) else process.send_signal(how)
        try:
            return process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            raise

    def test_every_loader_that_met_a_dead_manager_finds_the_next_one(self):
        self.start_manager()
        self.assertTrue(wait_until(lambda: '/cabinet/manager/list' in services()), 'no manager')
        self.end('manager', signal.SIGKILL)
        # The master still names the services of the dead one.
        nodelets = ['tracking_%d' % i for i in range(LOADERS)]
        for nodelet in nodelets:
            self.start_loader(nodelet, 'tracking')
        time.sleep(3)
        self.start_manager()
        missing = lambda: [nodelet for nodelet in nodelets if '/cabinet/%s/set_parameters' % nodelet not in services()]
        wait_until(lambda: not missing())
        self.assertEqual(missing(), [], 'these were not loaded')

    def test_the_models_are_saved_however_the_manager_is_asked_to_end(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / 'drawer.log'
            log.write_text(''.join('0.5 0.3 %.4f 0 1 0 0 0.4 0.2\n' % (1.5 - 0.005 * max(0, i - 20)) for i in range(80)))
            for name, how in (('SIGINT', signal.SIGINT), ('SIGTERM', signal.SIGTERM), ('rosnode kill', rosnode_kill)):
                self.learn_and_end(log, Path(folder) / (name + '.yaml'), how)

    def learn_and_end(self, log, models_file, how):
        rospy.set_param('/cabinet/articulation/models_file', str(models_file))
        rospy.set_param('/cabinet/articulation/save_at_exit', True)
        learned = []
        models = rospy.Subscriber('/cabinet/models', ArticulationModelArray,
                                  lambda message: learned.extend(model for model in message.models if is_established(model)))
        self.start_manager()
        self.start_loader('articulation', 'articulation')
        self.running['player'] = start('cabinet_articulation', 'track_publisher', str(log), '_rate:=30', '_loop:=true',
                                       '_frame_id:=kitchen')
        self.assertTrue(wait_until(lambda: learned), 'nothing was learned for ' + models_file.stem)
        self.end('player', signal.SIGINT)
        models.unregister()
        self.assertEqual(self.end('manager', how), 0, 'exit status of the manager after ' + models_file.stem)
        self.end('articulation', signal.SIGINT)
        self.assertTrue(models_file.exists(), 'nothing was saved after ' + models_file.stem)
        self.assertIn('complete: true', models_file.read_text())


if __name__ == '__main__':
    rospy.init_node('fresh_manager_test')
    rostest.rosrun('cabinet_articulation', 'fresh_manager_test', FreshManager)
