#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How well does what was learned from one recording tell where the front is in another one?

    rosrun cabinet_articulation process_bag monday.bag learned.bag --fixed-frame map
    rosrun cabinet_articulation process_bag tuesday.bag seen.bag --fixed-frame map
    rosrun cabinet_articulation articulation_node __ns:=cabinet
    python3 check_accuracy.py learned.bag seen.bag [NAMESPACE]

For each joint of the first bag: the track of the second bag that it explains best, and how far that is from the joint's path.
"""
import sys

import rosbag
import rospy

from cabinet_articulation.srv import EvaluateModel

NUMBERS_OF_A_POSE = {'stamps': 1, 'poses': 1, 'widths': 1, 'heights': 1, 'covariances': 36, 'edge_support': 4,
                     'measured_poses': 1, 'measured_widths': 1, 'measured_heights': 1, 'measured_covariances': 36}


def last(bag, topic):
    """The newest message on a topic."""
    with rosbag.Bag(bag) as opened:
        messages = [message for _, message, _ in opened.read_messages([topic])]
    return messages[-1] if messages else sys.exit('%s has nothing on %s' % (bag, topic))


def append(track, end):
    """A message has the end of a track, from the last observation that was sent before on."""
    for name, count in NUMBERS_OF_A_POSE.items():
        setattr(track, name, getattr(track, name)[:count * end.first] + getattr(end, name))


def whole_tracks(bag):
    """All tracks of a bag, put together."""
    tracks = {}
    with rosbag.Bag(bag) as opened:
        for _, message, _ in opened.read_messages(['/cabinet/tracks']):
            for track in message.tracks:
                if track.first == 0:
                    tracks[track.id] = track
                elif track.id in tracks and tracks[track.id].revision == track.revision:
                    append(tracks[track.id], track)
    return list(tracks.values())


def main(learned, seen, namespace='/cabinet'):
    rospy.wait_for_service(namespace + '/evaluate_model', 20)
    evaluate = rospy.ServiceProxy(namespace + '/evaluate_model', EvaluateModel)
    tracks = whole_tracks(seen)
    for model in last(learned, '/cabinet/models').models:
        if not model.moved or model.support == 0:
            continue
        if model.parent != 0:
            print('front %d: left out; its path is relative to front %d, on which it hangs' % (model.id, model.parent))
            continue
        answers = [(track, evaluate(model, track)) for track in tracks]
        answers = [(answer.position_error, answer, track) for track, answer in answers if answer.success]
        if not answers:
            sys.exit('no track can be evaluated')
        error, answer, track = min(answers, key=lambda entry: entry[0])
        way = max(answer.q) - min(answer.q)
        print('front %d: %.1f mm and %.1f degrees from its path in the mean, over %.2f of %.2f seen (track %d, %d poses)' %
              (model.id, 1000 * error, 57.3 * answer.orientation_error, way, model.q_max - model.q_min, track.id, len(answer.q)))


if __name__ == '__main__':
    arguments = rospy.myargv()[1:]
    if not 2 <= len(arguments) <= 3:
        sys.exit(__doc__)
    main(*arguments)
