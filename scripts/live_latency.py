#!/usr/bin/python3
"""live_latency.py CAMERA_INFO NAMESPACE: for measure_live.sh, until it is terminated. A frame begins when its CameraInfo arrives
and ends with its models; both are heard by this one process, in wall time."""
import signal
import statistics
import sys
import threading
import time
from collections import defaultdict

import rospy
from cabinet_articulation.msg import ArticulationModelArray, Timing
from sensor_msgs.msg import CameraInfo

FIRST = 1.0  # [s] of the bag that is left out: libraries are loaded, and buffers grow


class Latency:
    def __init__(self, camera_info, namespace):
        self.shown, self.answered, self.stages = {}, {}, defaultdict(dict)
        rospy.Subscriber('/' + camera_info, CameraInfo, lambda m: self.note(self.shown, m))
        rospy.Subscriber('/%s/models' % namespace, ArticulationModelArray, lambda m: self.note(self.answered, m))
        rospy.Subscriber('/%s/timing' % namespace, Timing, self.on_timing)

    @staticmethod
    def note(times, message):
        times[message.header.stamp.to_sec()] = time.monotonic()

    def on_timing(self, message):
        self.stages[message.stage][message.header.stamp.to_sec()] = message.milliseconds

    def report(self):
        """False if fewer than two frames came through."""
        shown, answered = dict(self.shown), dict(self.answered)
        stages = {stage: dict(values) for stage, values in list(self.stages.items())}
        if not shown:
            return False
        first = min(shown) + FIRST
        frames = sorted(stamp for stamp in shown if stamp >= first)
        times = sorted(1e3 * (answered[stamp] - shown[stamp]) for stamp in frames if stamp in answered)
        if len(times) < 2:
            return False
        print('%d frames at %.1f Hz, %d dropped (%.1f %%)' % (
            len(frames), (len(frames) - 1) / (frames[-1] - frames[0]), len(frames) - len(times),
            100 - 100 * len(times) / len(frames)))
        print('image to model: median %.1f ms, 90 %% within %.1f ms, most %.1f ms' % (
            statistics.median(times), times[int(0.9 * (len(times) - 1))], times[-1]))
        spans = ((stage, [spent for stamp, spent in values.items() if stamp >= first]) for stage, values in stages.items())
        print('stages, median ms: ' + ', '.join('%s %.1f' % (stage, statistics.median(values)) for stage, values in spans if values))
        return True


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    rospy.init_node('record', disable_signals=True)  # the name that steer_replay.py waits for
    ended = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: ended.set())  # shells let what they start in the background ignore SIGINT
    latency = Latency(sys.argv[1], sys.argv[2])
    ended.wait()
    if not latency.report():
        sys.exit('live_latency.py: no frame came through')


if __name__ == '__main__':
    main()
