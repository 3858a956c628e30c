#!/usr/bin/python3
"""How often answers are right, by the probability they state: reliability.py ANSWERS.csv... [--plot OUT.png] [--list]

ANSWERS.csv is what learner_answers writes of logs, sequences and scenes, with the truth. Each track has one vote, which its
answers after some of its observations share, and another for its last answer. A front that is tracked twice, or of which a false
track is learned, has a vote for each. Only answers that something moved are counted. --list names the tracks whose last answer is
sure and wrong.
"""
import argparse
import csv
import re
import sys
from collections import defaultdict

RIGID, CURVE = 0, 3  # by the constants of ArticulationModel.msg
NAMES = ['rigid', 'prismatic', 'rotational', 'other', 'screw']
BINS = [0.0, 0.5, 0.8, 0.95, 0.99, 1.0]
SURE = 0.95


def answers(path):
    """(track, number of observations or frame, fields) of every answer with a truth, in order."""
    found = defaultdict(dict)
    with open(path, newline='') as file:
        for row in csv.DictReader(file):
            of_log = re.fullmatch(r'after(\d+)', row['answer'])
            of_sequence = re.fullmatch(r'frame(\d+)/(\d+)', row['answer'])
            if of_log:
                key = row['source'], int(of_log.group(1))
            elif of_sequence:
                key = '%s, track %s' % (row['source'], of_sequence.group(2)), int(of_sequence.group(1))
            else:
                continue
            found[key][row['field']] = float(row['value'])
    for field in ('observed', 'truth'):
        if found and not any(field in fields for fields in found.values()):
            raise ValueError('%s has no field "%s": an older learner_answers wrote it, which is to be run again' % (path, field))
    for (track, count), fields in sorted(found.items()):
        if 'truth' in fields:
            yield track, count, fields


def votes(path):
    """Of every track: a list of (probability, told type, true type) of its answers that it moved."""
    by_track = defaultdict(list)
    for track, _, fields in answers(path):
        kind = int(fields['type'])
        if kind == RIGID or not fields['observed']:
            continue
        told = kind if fields['explained'] else CURVE
        by_track[track].append((fields['probability%d' % told], told, int(fields['truth'])))
    return by_track


def table(by_track):
    """Rows of (from, to, votes, share right)."""
    weight, right = defaultdict(float), defaultdict(float)
    for track in by_track.values():
        for probability, told, truth in track:
            place = max(i for i, low in enumerate(BINS[:-1]) if probability >= low)
            weight[place] += 1 / len(track)
            right[place] += (told == truth) / len(track)
    return [(BINS[i], BINS[i + 1], weight[i], right[i] / weight[i]) for i in sorted(weight)]


def sure(by_track):
    """Votes of sure answers, and how many of them are right."""
    total = sum(sum(p > SURE for p, _, _ in track) / len(track) for track in by_track.values())
    return total, sum(sum(p > SURE and told == truth for p, told, truth in track) / len(track) for track in by_track.values())


def plot(rows, path):
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(figsize=(4, 4))
    axes.plot([0, 1], [0, 1], color='0.6', linewidth=1, linestyle=':')
    axes.scatter([(low + high) / 2 for low, high, _, _ in rows], [share for *_, share in rows], s=[20 + 8 * n for _, _, n, _ in rows])
    axes.set(xlabel='stated probability', ylabel='share of answers that are right', xlim=(0, 1.02), ylim=(0, 1.02))
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('answers', nargs='+')
    parser.add_argument('--plot')
    parser.add_argument('--list', action='store_true')
    options = parser.parse_args()
    try:
        by_track = {(path, track): given for path in options.answers for track, given in votes(path).items()}
    except (OSError, ValueError) as error:
        sys.exit('reliability.py: %s' % error)
    last = {track: given[-1:] for track, given in by_track.items()}
    rows = table(by_track)
    print('probability    votes  right')
    for low, high, count, share in rows:
        print('%.2f to %.2f  %6.1f  %4.0f %%' % (low, high, count, 100 * share))
    total, right = sure(by_track)
    print('P > %.2f, all answers: %.1f of %.1f votes right' % (SURE, right, total))
    total, right = sure(last)
    print('P > %.2f, last answers: %d of %d right' % (SURE, right, total))
    for (_, track), [(probability, told, truth)] in last.items():
        if options.list and probability > SURE and told != truth:
            print('%s: %s with %.3f, is %s' % (track, NAMES[told], probability, NAMES[truth]))
    if options.plot:
        plot(rows, options.plot)


if __name__ == '__main__':
    main()
