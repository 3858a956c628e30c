#!/usr/bin/python3
"""Compares two tables of learner_answers: compare_answers.py BEFORE.csv AFTER.csv [--tolerance 1e-9]

Prints every answer whose type differs, and for each field how many values differ, by how much at most (relative to the larger
one, absolute below 1) and where. The exit status is 1 if an answer is missing, a type differs or a value differs by more.
"""
import argparse
import csv
import math
import sys


def read(path):
    with open(path) as file:
        return {(row['source'], row['answer'], row['field']): float(row['value']) for row in csv.DictReader(file)}


def difference(a, b):
    if a == b or (math.isnan(a) and math.isnan(b)):
        return 0
    return abs(a - b) / max(1, abs(a), abs(b)) if math.isfinite(a) and math.isfinite(b) else math.inf


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('before')
    parser.add_argument('after')
    parser.add_argument('--tolerance', type=float, default=1e-9)
    options = parser.parse_args()
    before, after = read(options.before), read(options.after)
    wrong = 0
    for key in sorted(before.keys() ^ after.keys()):
        print('only %s: %s' % ('before' if key in before else 'after', ', '.join(key)))
        wrong += 1
    fields = {}
    for key in sorted(before.keys() & after.keys()):
        by = difference(before[key], after[key])
        if by == 0:
            continue
        if key[2] == 'type':
            print('%s, %s: type %d before, %d after' % (key[0], key[1], before[key], after[key]))
        name = key[2].rstrip('0123456789')
        count, largest, where = fields.get(name, (0, 0, None))
        fields[name] = (count + 1, max(by, largest), key if by > largest else where)
        wrong += by > options.tolerance
    for name, (count, largest, where) in sorted(fields.items()):
        print('%s: %d values differ, by %.1e at most (%s)' % (name, count, largest, ', '.join(where)))
    total = len(before)
    if wrong:
        print('%d of %d values are missing or differ by more than %g' % (wrong, total, options.tolerance))
    elif fields:
        print('all of %d values are equal to %g' % (total, options.tolerance))
    else:
        print('all of %d values are identical' % total)
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
