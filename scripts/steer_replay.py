#!/usr/bin/python3
"""steer_replay.py NAMESPACE [PATIENCE]: for compare_live.sh and measure_live.sh. Waits until the paused player of replay.launch,
the pipeline and the recorder are connected, lets the bag play, and returns when its last frame is through."""
import sys
import time
import xmlrpc.client

import rosgraph
import rospy
from std_srvs.srv import SetBool
from cabinet_articulation.msg import ArticulationModelArray

PLAYER, RECORDER = '/play', '/record'
SETTLED = 2  # [s] without a new connection, or without new models


def connections(master, node):
    """Topics with the node at the other end, both ways; empty if the node is not there."""
    try:
        _, _, info = xmlrpc.client.ServerProxy(master.lookupNode(node)).getBusInfo('/steer_replay')
    except (rosgraph.MasterException, OSError):
        return set()
    return {(connection[4], connection[1]) for connection in info}


class Replay:
    def __init__(self, namespace, patience):
        self.models = '/%s/models' % namespace
        self.patience = patience
        self.master = rosgraph.Master('/steer_replay')
        self.changed = time.monotonic()
        rospy.Subscriber(self.models, ArticulationModelArray, lambda _: self.touch())

    def touch(self):
        self.changed = time.monotonic()

    def settled(self):
        return time.monotonic() - self.changed > SETTLED

    def wait_for_connections(self):
        """The recorder hears the last stage, and the player has found all that it ever will."""
        end = time.monotonic() + self.patience
        known = None
        while True:
            recorded, played = connections(self.master, RECORDER), connections(self.master, PLAYER)
            complete = any(topic == self.models for topic, _ in recorded) and len(played) > 1
            if not complete or known != (recorded, played):
                known = recorded, played
                self.touch()
            if self.settled():
                return
            if time.monotonic() > end:
                raise TimeoutError('the pipeline was not ready within %d s; the player is connected on %s, the recorder on %s' % (
                    self.patience, sorted({topic for topic, _ in played}), sorted({topic for topic, _ in recorded})))
            time.sleep(0.2)

    def play(self):
        rospy.ServiceProxy(PLAYER + '/pause_playback', SetBool)(False)
        while connections(self.master, PLAYER):
            time.sleep(0.5)
        self.touch()
        while not self.settled():
            time.sleep(0.2)


def main():
    rospy.init_node('steer_replay', anonymous=True, disable_signals=True)
    replay = Replay(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 60)
    try:
        replay.wait_for_connections()
        replay.play()
    except (TimeoutError, rospy.ServiceException) as error:
        sys.exit('steer_replay.py: %s' % error)


if __name__ == '__main__':
    main()
