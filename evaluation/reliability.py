#!/usr/bin/python3
"""How often answers are right, by the probability they state: reliability.py ANSWERS.csv LABELS.csv [--plot OUT.png]

ANSWERS.csv is what learner_answers writes, LABELS.csv has the columns file and type. Each front has one vote, which its answers
after some of its observations share, and another for its last answer. Only answers that something moved are counted.
"""
import argparse
import csv
from collections import defaultdict

# By the constants of ArticulationModel.msg.
NAMES = ['rigid', 'prismatic', 'rotational', 'other', 'screw']
BINS = [0.0, 0.5, 0.8, 0.95, 0.99, 1.0]
SURE = 0.95


def answers(path):
    """(source, number of observations, type, probability) of every answer, in order."""
    found = defaultdict(dict)
    with open(path, newline='') as file:
        for row in csv.DictReader(file):
            if row['answer'].startswith('after'):
                found[row['source'], int(row['answer'][len('after'):])][row['field']] = float(row['value'])
    for (source, count), fields in sorted(found.items()):
        kind = int(fields['type'])
        unexplained = fields['moved'] and not fields['explained']
        yield source, count, 'other' if unexplained else NAMES[kind], fields.get('probability%d' % kind, 0.0)


def votes(path, types):
    """Of every front: a list of (probability, right) of its answers that it moved."""
    by_front = defaultdict(list)
    for source, _, name, probability in answers(path):
        if source in types and name != 'rigid':
            by_front[source].append((probability, name == types[source]))
    return by_front


def table(by_front):
    """Rows of (from, to, votes, share right)."""
    weight, right = defaultdict(float), defaultdict(float)
    for front in by_front.values():
        for probability, is_right in front:
            place = max(i for i, low in enumerate(BINS[:-1]) if probability >= low)
            weight[place] += 1 / len(front)
            right[place] += is_right / len(front)
    return [(BINS[i], BINS[i + 1], weight[i], right[i] / weight[i]) for i in sorted(weight)]


def sure(by_front):
    """Votes of sure answers, and how many of them are right."""
    total = sum(sum(p > SURE for p, _ in front) / len(front) for front in by_front.values())
    return total, sum(sum(p > SURE and ok for p, ok in front) / len(front) for front in by_front.values())


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
    parser.add_argument('answers')
    parser.add_argument('labels')
    parser.add_argument('--plot')
    options = parser.parse_args()
    with open(options.labels, newline='') as file:
        types = {row['file']: row['type'] for row in csv.DictReader(file)}
    by_front = votes(options.answers, types)
    rows = table(by_front)
    print('probability    votes  right')
    for low, high, count, share in rows:
        print('%.2f to %.2f  %6.1f  %4.0f %%' % (low, high, count, 100 * share))
    total, right = sure(by_front)
    print('P > %.2f, all answers: %.1f of %.1f votes right' % (SURE, right, total))
    total, right = sure({source: front[-1:] for source, front in by_front.items()})
    print('P > %.2f, last answers: %d of %d right' % (SURE, right, total))
    if options.plot:
        plot(rows, options.plot)


if __name__ == '__main__':
    main()
