#!/usr/bin/python3
"""Writes what the tables say as one page: summarize.py FOLDER [PAGE]. The folder that run.sh wrote gets a summary.md; the
tables also replace what stands between the two marks of PAGE."""
import csv
import statistics
import sys
from collections import defaultdict
from pathlib import Path

MARKS = ('<!-- Tables: evaluation/run.sh --page writes them. -->\n', '<!-- End of the tables. -->\n')
# The paper's and the original release's figures for the paper's own two logs.
PUBLISHED = {'stereo/door.txt': ('30, 10 mm, 3.5°', '10, 10-12 mm, 1.9-3.7°'),
             'stereo/drawer.txt': ('30, 10 mm, 7°', '-, 8-10 mm, 4.6-7.7°')}


def read(path):
    with open(str(path), newline='') as table:
        return list(csv.DictReader(table))


def group(rows, *keys):
    groups = defaultdict(list)
    for row in rows:
        groups[tuple(row[key] for key in keys)].append(row)
    return groups


def show(cell, digits):
    return '%.*f' % (digits, float(cell)) if cell else '-'


def percent(share):
    return '%.0f %%' % (100 * share)


def mean_of(rows, key, digits):
    values = [float(row[key]) for row in rows if row[key]]
    return '%.*f' % (digits, statistics.mean(values)) if values else '-'


def table(title, header, rows):
    lines = ['## ' + title, '', '| %s |' % ' | '.join(header), '|%s' % ('---|' * len(header))]
    return '\n'.join(lines + ['| %s |' % ' | '.join(row) for row in rows]) + '\n'


def depth_error(folder):
    rows = []
    for (source,), points in sorted(group(read(folder / 'fig03.csv'), 'source').items()):
        for point in points[::2]:
            rows.append([source, show(point['distance_m'], 2), show(point['deviation_mm'], 1), show(point['bias_mm'], 1),
                         percent(float(point['valid_share']))])
    return table('Depth of a flat board (Fig. 3)', ['board', 'distance m', 'deviation mm', 'bias mm', 'pixels with depth'], rows)


def hanging_front(folder):
    rows = []
    for (source, variant), points in sorted(group(read(folder / 'fig11_frames.csv'), 'source', 'variant').items()):
        distances = [float(point['distance_m']) for point in points]
        if max(distances) - min(distances) < 1.5:
            continue
        for near, far, name in ((0, 2.3, 'to 2.3'), (2.3, 9, 'beyond')):
            inside = [point for point, distance in zip(points, distances) if near <= distance < far]
            found = [point for point in inside if point['detected'] == '1']
            errors = [mean_of(found, key, 1) for key in ('searched', 'center_mm', 'orientation_deg')]
            rows.append([source, variant, name, str(len(inside)), percent(len(found) / len(inside))] + errors)
    return table('A hanging front (Fig. 11; paper: above 75 % up to 2.3 m, below 15 mm and 3°)',
                 ['source', 'variant', 'distance m', 'poses', 'found', 'planes searched', 'position mm', 'orientation °'], rows)


def fronts(folder):
    rows = []
    for row in read(folder / 'fig11_fronts.csv'):
        rows.append([row['source'], row['front'], row['variant'], row['judged'], percent(float(row['rate']))] +
                    [show(row[key], 1) for key in ('center_mm_median', 'normal_deg_median', 'in_plane_deg_median',
                                                   'width_mm_median', 'height_mm_median')] + [show(row['others_median'], 0)])
    return table('Every front that opens (medians)', ['source', 'front', 'variant', 'frames', 'found', 'centre mm', 'normal °',
                                                      'in-plane °', 'width mm', 'height mm', 'other rectangles'], rows)


def learned(folder):
    rows = []
    for row in read(folder / 'fig11_learned.csv'):
        rows.append([row['source'], row['variant'], row['front'], row['learned']] +
                    [show(row['probability'], 2), show(row['right_from_mm'], 0), show(row['axis_deg'], 1)] +
                    [show(row[key], 1) for key in ('axis_mm', 'predicted_mm_mean', 'predicted_mm_max')] + [row['objects_moving']])
    return table('What was learned from whole runs', ['source', 'variant', 'front', 'learned', 'P', 'right from mm', 'axis °',
                                                      'axis mm', 'predicted mm', 'at most', 'objects moving'], rows)


def curves(folder):
    rows = []
    for (source,), points in group(read(folder / 'fig12.csv'), 'source').items():
        if source.count('/') and source not in PUBLISHED:
            continue
        sure = None
        for point in reversed(points):
            if float(point['confident_share']) < 1:
                break
            sure = point['observations']
        last = points[-1]
        rows.append([source, last['type'], sure or 'never', show(last['error_mm_mean'], 1), show(last['error_deg_mean'], 1)] +
                    list(PUBLISHED.get(source, ('', ''))))
    return table('50 sub-samples (Fig. 12)', ['source', 'type', 'P > 0.95 in every run from', 'error mm', 'error °', 'paper',
                                              'original release'], rows)


def unseen(folder):
    rows = []
    entries = [dict(row, set=row['source'].rsplit('/', 1)[0]) for row in read(folder / 'fig12_unseen.csv')]
    for (name, kind), members in sorted(group(entries, 'set', 'type').items()):
        cells = [name, kind]
        for share in ('0.3', '0.5'):
            for key in ('true_type_error_mm', 'error_mm'):
                cells.append(mean_of([row for row in members if row['trained_share'] == share], key, 0))
        rows.append(cells)
    return table('Openings never seen: mean error over the farthest tenth [mm]',
                 ['source', 'type', '30 % seen, type given', 'as selected', '50 % seen, type given', 'as selected'], rows)


def intervals(folder):
    rows = [[row['source'], row['quantity'], row['checks'], percent(float(row['inside_95']))]
            for row in read(folder / 'fig12_intervals.csv') if row['inside_95']]
    return table('Coverage of the 95 % intervals', ['source', 'quantity', 'checks', 'inside'], rows)


def replace_tables(page, tables):
    text = page.read_text(encoding='utf-8')
    if [text.count(mark) for mark in MARKS] != [1, 1] or text.index(MARKS[0]) > text.index(MARKS[1]):
        sys.exit('%s: expected one line "%s" and after it one line "%s"' % ((page,) + tuple(mark.strip() for mark in MARKS)))
    before, rest = text.split(MARKS[0])
    page.write_text(before + MARKS[0] + '\n' + tables + '\n' + MARKS[1] + rest.split(MARKS[1])[1], encoding='utf-8')
    print(page)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    parts = [part(folder) for part in (depth_error, hanging_front, fronts, learned, curves, unseen, intervals)]
    (folder / 'summary.md').write_text('\n'.join(parts), encoding='utf-8')
    print(folder / 'summary.md')
    if len(sys.argv) == 3:
        replace_tables(Path(sys.argv[2]), '\n'.join(parts))


main()
