#!/usr/bin/python3
"""Draws the figures from the tables: plot.py FOLDER, the folder that run.sh wrote."""
import csv
import sys
from collections import defaultdict
from pathlib import Path

try:
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot as plt
except ImportError:
    sys.exit('the tables are written, the figures are not: matplotlib is missing (Debian: apt-get install python3-matplotlib)')

COLORS = {'ours': 'C0', 'paper': 'C1'}
TYPES = {'rigid': 'C7', 'prismatic': 'C2', 'rotational': 'C3'}
LIMIT = dict(color='0.4', linewidth=0.8, linestyle=':')


def read(path):
    with open(str(path), newline='') as table:
        return list(csv.DictReader(table))


def number(cell):
    return float(cell) if cell else float('nan')


def column(rows, key):
    return [number(row[key]) for row in rows]


def group(rows, *keys):
    groups = defaultdict(list)
    for row in rows:
        groups[tuple(row[key] for key in keys)].append(row)
    return groups


def save(figure, path):
    figure.tight_layout()
    figure.savefig(str(path), dpi=110)
    plt.close(figure)
    print(path)


def draw_depth_error(folder):
    figure, axes = plt.subplots(1, 3, figsize=(13, 4))
    for (source,), rows in group(read(folder / 'fig03.csv'), 'source').items():
        style = dict(marker='.', linestyle='-' if source.startswith('simulated') else '--', color='C0' if 'white' in source else 'k')
        x = column(rows, 'distance_m')
        # Where hardly a pixel is left, what remains says nothing about the board.
        kept = [row if number(row['valid_share']) > 0.05 else defaultdict(str) for row in rows]
        axes[0].plot(x, column(kept, 'deviation_mm'), label=source, **style)
        axes[1].plot(x, column(kept, 'bias_mm'), label=source, **style)
        axes[2].plot(x, column(rows, 'valid_share'), label=source, **style)
    # The paper's statements about its Fig. 3.
    axes[0].plot([0.5, 1.2, 2.5], [2, 2, 10], label='paper, white: below', **LIMIT)
    axes[2].plot([0.5, 1.2, 2.5, 3], [1, 1, 0, 0], label='paper, 5 % reflectance', **LIMIT)
    for axis, title in zip(axes, ('std from best-fit plane [mm]', 'bias [mm]', 'pixels with depth')):
        axis.set(xlabel='distance [m]', title=title)
        axis.legend(fontsize=7)
    axes[0].set_ylim(0, 45)
    save(figure, folder / 'fig03.png')


def draw_detection(folder):
    for (source,), rows in group(read(folder / 'fig11.csv'), 'source').items():
        if 'drawer' not in source or not ('hanging' in source or 'single' in source):
            continue
        figure, axes = plt.subplots(2, 2, figsize=(11, 7))
        for (variant,), points in sorted(group(rows, 'variant').items()):
            x = [(number(row['distance_from_m']) + number(row['distance_to_m'])) / 2 for row in points]
            for axis, key in zip(axes.flat, ('rate', 'searched_mean', 'center_mm_mean', 'normal_deg_mean')):
                axis.plot(x, column(points, key), marker='.', color=COLORS[variant], label=variant)
        axes[0][0].plot([0.6, 2.3], [0.75, 0.75], label='the paper reports: above', **LIMIT)
        axes[1][0].axhline(15, label='the paper reports: below', **LIMIT)
        axes[1][1].axhline(3, label='the paper reports: below', **LIMIT)
        titles = ('detection rate', 'planes searched until found', 'mean position error [mm]', 'mean error of the normal [deg]')
        for axis, title in zip(axes.flat, titles):
            axis.set(xlabel='distance [m]', title=title, ylim=(0, None))
            axis.legend(fontsize=8)
        figure.suptitle('%s, %d poses' % (source, sum(int(row['judged']) for row in rows if row['variant'] == 'ours')))
        save(figure, folder / ('fig11_%s.png' % source))


def draw_models(folder):
    sources = group(read(folder / 'fig12.csv'), 'source')
    # A figure of every log would be no figure; the table has them all.
    shown = [key for key in sources if 'door' in key[0] or 'drawer' in key[0]]
    shown = [key for key in shown if '/' not in key[0] or key[0].startswith('stereo/')][:8]
    figure, axes = plt.subplots(2, len(shown), figsize=(3.2 * len(shown), 6), squeeze=False)
    for index, key in enumerate(shown):
        rows = sources[key]
        x = column(rows, 'observations')
        for name, color in TYPES.items():
            axes[0][index].plot(x, column(rows, 'p_' + name), marker='.', color=color, label=name)
        axes[0][index].set(title=key[0].replace('simulated', 'sim.'), ylim=(-0.02, 1.02), xlabel='observations')
        mean, deviation = column(rows, 'error_mm_mean'), column(rows, 'error_mm_deviation')
        axes[1][index].errorbar(x, mean, yerr=deviation, marker='.', color='C0', label='[mm]')
        axes[1][index].plot(x, column(rows, 'error_deg_mean'), marker='.', color='C1', label='[deg]')
        axes[1][index].axhline(10, **LIMIT)
        axes[1][index].set(ylim=(0, 40), xlabel='observations')
    axes[0][0].set_ylabel('probability')
    axes[1][0].set_ylabel('prediction error (dotted: paper, 10 mm)')
    axes[0][0].legend(fontsize=7)
    axes[1][0].legend(fontsize=7)
    save(figure, folder / 'fig12.png')


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    draw_depth_error(folder)
    draw_detection(folder)
    draw_models(folder)


main()
