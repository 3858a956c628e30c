#!/usr/bin/python3
"""Compares what the nodelets published (LIVE.bag) with what process_bag wrote (OFFLINE.bag), field by field.

Frames belong together by their stamp. All fields of rectangles, models and tracks are compared, but for header.seq, Track.first
and TrackArray.generation; tracks are put together first from messages that carry only what is new. Numbers may differ by
TOLERANCE times the larger magnitude (and by 1e-12 around 0, covariances by 1e-16), NaN equals NaN, quaternions may have either
sign; integers, strings and lengths are exact.

Exit status: 0 if all frames are there and equal, 1 if not, 2 if the bags cannot be compared.
"""
import argparse
import math
import statistics
import sys

import genpy
import rosbag

TOPICS = ('rectangles', 'tracks', 'models')
TOLERANCE = 1e-9
# What rounding leaves where 0 is meant. A standard deviation of 0.1 mm or 0.01 degrees is a covariance of 1e-8.
FLOOR, COVARIANCE_FLOOR = 1e-12, 1e-16
SHOWN_STAMPS = 10
# [ns] Stamps that go back by no more are frames out of order, as in clock_jump.h.
OUT_OF_ORDER = 10**9
# How a message was sent, not what was found; a generation is a time of day.
IGNORED = {'seq', 'first', 'generation'}
# What a track has of each observation, and how many values.
HISTORY = {'stamps': 1, 'poses': 1, 'widths': 1, 'heights': 1, 'covariances': 36, 'edge_support': 4, 'measured_poses': 1,
           'measured_widths': 1, 'measured_heights': 1, 'measured_covariances': 36}


def is_close(a, b, tolerance, path):
    floor = COVARIANCE_FLOOR if 'covariance' in path else FLOOR
    return math.isclose(a, b, rel_tol=tolerance, abs_tol=floor) or (math.isnan(a) and math.isnan(b))


def quaternion_differences(a, b, tolerance, path):
    sign = math.copysign(1, sum(getattr(a, slot) * getattr(b, slot) for slot in 'xyzw'))
    for slot in 'xyzw':
        if not is_close(getattr(a, slot), sign * getattr(b, slot), tolerance, path):
            yield '%s.%s' % (path, slot), getattr(a, slot), getattr(b, slot)


def list_differences(a, b, tolerance, path, start=0, ignored=IGNORED):
    if len(a) != len(b):
        yield path + ' (length)', len(a), len(b)
    elif start > 0 or a != b:
        for i in range(start, len(a)):
            yield from differences(a[i], b[i], tolerance, '%s[%d]' % (path, i), ignored)


def differences(a, b, tolerance, path='', ignored=IGNORED):
    """Yields (path, a's value, b's value) of every field in which two messages differ."""
    if isinstance(a, float) and isinstance(b, float):
        if not is_close(a, b, tolerance, path):
            yield path, a, b
    elif isinstance(a, (list, tuple)):
        yield from list_differences(a, b, tolerance, path, 0, ignored)
    elif not hasattr(a, '__slots__') or isinstance(a, genpy.TVal):
        if a != b:
            yield path, a, b
    elif list(a.__slots__) != list(b.__slots__):
        yield path + ' (fields of the message)', ' '.join(a.__slots__), ' '.join(b.__slots__)
    elif list(a.__slots__) == ['x', 'y', 'z', 'w']:
        yield from quaternion_differences(a, b, tolerance, path)
    else:
        for slot in a.__slots__:
            if slot not in ignored:
                yield from differences(getattr(a, slot), getattr(b, slot), tolerance, path + '.' * bool(path) + slot, ignored)


class History:
    """All observations of one track: a message carries those from `first` on. After a gap a history stays as it was, and
    incomplete, until the next whole one (`first` = 0)."""

    def __init__(self):
        self.lists = {field: [] for field in HISTORY}
        self.revision = None
        self.compared = 0  # so many observations were found equal
        self.complete = False

    def add(self, track):
        first = track.first
        # A part begins with an observation that was sent before.
        known = self.lists['stamps'][first:first + 1]
        self.complete = first == 0 or (self.revision == track.revision and len(known) == 1 and known == track.stamps[:1])
        if not self.complete:
            return self
        for field, values in self.lists.items():
            del values[first * HISTORY[field]:]
            values.extend(getattr(track, field))
        self.revision = track.revision
        self.compared = min(self.compared, first)
        return self


class Comparison:
    """What came out for one topic."""

    def __init__(self, topic, live, offline, tolerance=TOLERANCE):
        """live, offline: the messages in the order in which they were sent."""
        self.topic = topic
        self.tolerance = tolerance
        self.first = None  # (frame, path, live value, offline value)
        self.fields = self.gaps = 0
        self.frames = set()  # that differ
        live, offline = by_frame(live), by_frame(offline)
        self.common = len(set(live) & set(offline))
        self.only_live = sorted(set(live) - set(offline))
        self.only_offline = sorted(set(offline) - set(live))
        (self.compare_tracks if topic == 'tracks' else self.compare_messages)(live, offline)

    def compare_messages(self, live, offline):
        for frame in sorted(set(live) & set(offline)):
            self.count(frame, list(differences(live[frame][-1], offline[frame][-1], self.tolerance)))

    def compare_tracks(self, live, offline):
        histories = [{}, {}]  # by id
        for frame in sorted(set(live) | set(offline)):
            for i, messages in enumerate((live, offline)):
                for message in messages.get(frame, []):
                    histories[i] = {track.id: histories[i].get(track.id, History()).add(track) for track in message.tracks}
            if frame in live and frame in offline:
                a, b = live[frame][-1], offline[frame][-1]
                found = list(differences(a, b, self.tolerance, ignored=IGNORED | set(HISTORY)))
                for i, (track_a, track_b) in enumerate(zip(a.tracks, b.tracks)):
                    found += self.compare_histories(histories[0][track_a.id], histories[1][track_b.id], 'tracks[%d]' % i)
                self.count(frame, found)

    def compare_histories(self, a, b, path):
        """From the first observation on that is new or was not equal yet."""
        if not (a.complete and b.complete):
            self.gaps += 1
            return []
        start = min(a.compared, b.compared)
        found = []
        for field in a.lists:
            found += list_differences(a.lists[field], b.lists[field], self.tolerance, '%s.%s' % (path, field),
                                      start * HISTORY[field])
        a.compared = b.compared = start if found else len(a.lists['stamps'])
        return found

    def count(self, frame, found):
        self.fields += len(found)
        if found:
            self.frames.add(frame)
            self.first = self.first or (frame,) + found[0]

    def text(self):
        lines = ['%s: %d frames in both, %d only live, %d only offline; %d frames differ, in %d fields'
                 % (self.topic, self.common, len(self.only_live), len(self.only_offline), len(self.frames), self.fields)]
        for name, frames in ('live', self.only_live), ('offline', self.only_offline):
            if frames:
                more = len(frames) - SHOWN_STAMPS
                lines.append('  only %s: %s%s' % (name, ' '.join(map(stamp_text, frames[:SHOWN_STAMPS])),
                                                  ' and %d more' % more if more > 0 else ''))
        if self.gaps:
            lines.append('  %d times the history of a track was not compared, for what came before was missing' % self.gaps)
        if self.first:
            lines.append('  first: at %s %s is %r live and %r offline' % ((stamp_text(self.first[0]),) + self.first[1:]))
        return '\n'.join(lines)


def by_frame(messages):
    """{(round, stamp): messages}. A new round begins where time jumps back."""
    frames, round_, newest = {}, 0, 0
    for message in messages:
        stamp = message.header.stamp.to_nsec()
        jumped = newest - stamp > OUT_OF_ORDER
        round_ += jumped
        newest = stamp if jumped else max(newest, stamp)
        frames.setdefault((round_, stamp), []).append(message)
    return frames


def stamp_text(frame):
    return '%d.%09d' % divmod(frame[1], 10**9) + (' (round %d)' % (frame[0] + 1) if frame[0] else '')


def verdict(comparisons, tolerance, allow_missing):
    """Exit status, and why in words."""
    different = [comparison for comparison in comparisons if comparison.first]
    if different:
        first = min(different, key=lambda comparison: comparison.first[0])
        return 1, 'different: %d fields in %d frames; first at %s in %s: %s' % (
            sum(c.fields for c in comparisons), len(set().union(*(c.frames for c in comparisons))), stamp_text(first.first[0]),
            first.topic, first.first[1])
    if not any(comparison.common for comparison in comparisons):
        return 1, 'nothing was compared: the bags have no frame in common'
    equal = 'equal to %g relative' % tolerance
    missing = sum(len(c.only_live + c.only_offline) for c in comparisons)
    gaps = sum(c.gaps for c in comparisons)
    if missing or gaps:
        return int(not allow_missing), 'what both have is %s, but %d messages are missing and %d histories have gaps' % (
            equal, missing, gaps)
    return 0, 'all %d frames are there and %s' % (max(c.common for c in comparisons), equal)


def read(path, ns):
    """{topic: messages}, and of `timing` {stage: milliseconds}."""
    messages, timing = {topic: [] for topic in TOPICS}, {}
    with rosbag.Bag(path) as bag:
        for topic, message, _ in bag.read_messages(topics=['/%s/%s' % (ns, name) for name in TOPICS + ('timing',)]):
            name = topic.rsplit('/', 1)[1]
            if name == 'timing':
                timing.setdefault(message.stage, []).append(message.milliseconds)
            else:
                messages[name].append(message)
            for track in getattr(message, 'tracks', []):
                lacking = sorted({'first', 'revision', *HISTORY} - set(track.__slots__))
                if lacking:
                    raise ValueError('%s is of an older version: its tracks have no %s' % (path, ', '.join(lacking)))
    silent = [name for name in TOPICS if not messages[name]]
    if silent:
        raise ValueError('%s has no message on %s' % (path, ', '.join('/%s/%s' % (ns, name) for name in silent)))
    return messages, timing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('live', metavar='LIVE.bag')
    parser.add_argument('offline', metavar='OFFLINE.bag')
    parser.add_argument('--tolerance', type=float, default=TOLERANCE, help='relative (default: %(default)g)')
    parser.add_argument('--ns', default='cabinet', help='namespace of the topics in LIVE.bag (default: %(default)s)')
    parser.add_argument('--allow-missing', action='store_true', help='frames that only one bag has are no failure')
    options = parser.parse_args()
    try:
        live, timing = read(options.live, options.ns.strip('/'))
        offline, _ = read(options.offline, 'cabinet')
    except (OSError, ValueError, rosbag.ROSBagException) as error:
        print('compare_results.py: %s' % error, file=sys.stderr)
        return 2
    if timing:
        medians = ['%s %.1f' % (stage, statistics.median(values)) for stage, values in sorted(timing.items())]
        print('milliseconds live (median): ' + ', '.join(medians))
    comparisons = [Comparison(topic, live[topic], offline[topic], options.tolerance) for topic in TOPICS]
    for comparison in comparisons:
        print(comparison.text())
    status, text = verdict(comparisons, options.tolerance, options.allow_missing)
    print(text)
    return status


if __name__ == '__main__':
    sys.exit(main())
