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

VARIANTS = {'ours': ('C0', 'ours'), 'ours_depth': ('C2', 'ours, from a depth image'), 'paper': ('C1', "the paper's recipe")}
TYPE_COLORS = {'rigid': 'C7', 'prismatic': 'C2', 'rotational': 'C3'}
PAPER = dict(color='0.35', linewidth=1, linestyle=':')
# What the text of the paper says about its Fig. 12, and what the original release's library reaches on the same logs.
PAPER_ERROR = {'prismatic': (10, 7), 'rotational': (10, 3.5)}  # [mm], [deg] from 30 observations on
ORIGINAL_ERROR = {'stereo/drawer.txt': ((8, 10), (4.6, 7.7)), 'stereo/door.txt': ((10, 12), (1.9, 3.7))}

plt.rcParams.update({'font.size': 9, 'axes.titlesize': 10, 'axes.grid': True, 'grid.color': '0.92', 'axes.axisbelow': True,
                     'axes.spines.top': False, 'axes.spines.right': False, 'legend.frameon': False, 'legend.fontsize': 8,
                     'lines.markersize': 4, 'lines.linewidth': 1.4})


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


def title_of(source):
    return source.replace('simulated_', 'simulated ').replace('.txt', ' (log)').replace('_', ' ')


def save(figure, path):
    figure.tight_layout()
    figure.savefig(str(path), dpi=110)
    plt.close(figure)
    print(path)


def draw_depth_error(folder):
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4))
    for (source,), rows in sorted(group(read(folder / 'fig03.csv'), 'source').items()):
        simulated = source.startswith('simulated')
        style = dict(marker='o', linestyle='-' if simulated else '--', color='C0' if 'white' in source else 'k',
                     label='%s, %s' % ('white' if 'white' in source else '5 % reflectance', 'simulated' if simulated else source))
        # Where hardly a pixel is left, what remains says nothing about the board.
        kept = [row for row in rows if number(row['valid_share']) > 0.05]
        axes[0].plot(column(kept, 'distance_m'), column(kept, 'deviation_mm'), **style)
        axes[1].plot(column(kept, 'distance_m'), column(kept, 'bias_mm'), **style)
        axes[2].plot(column(rows, 'distance_m'), column(rows, 'valid_share'), **style)
    axes[0].plot([0.5, 1.2, 2.5], [2, 2, 10], label='paper, white: below this', **PAPER)
    axes[2].plot([0.5, 1.2, 2.5, 3], [1, 1, 0, 0], label='paper, 5 % reflectance', **PAPER)
    titles = ('standard deviation from the best-fit plane [mm]', 'mean error of the depth [mm]', 'share of pixels with depth')
    for axis, title in zip(axes, titles):
        axis.set(xlabel='distance [m]', title=title)
    axes[0].set_ylim(0, 40)
    axes[0].legend(loc='upper left')
    axes[2].legend(*[entries[-1:] for entries in axes[2].get_legend_handles_labels()], loc='lower left')
    save(figure, folder / 'fig03.png')


def draw_detection(folder):
    panels = (('rate', 'detection rate', (0, 1.03), 0.75, 'paper: above this, up to 2.3 m'),
              ('searched_mean', 'planes searched until found', (0, None), None, ''),
              ('center_mm_mean', 'position error of those found, mean [mm]', (0, 17), 15, 'paper: below this'),
              ('orientation_deg_mean', 'orientation error of those found, mean [deg]', (0, None), 3, 'paper: below this'))
    for (source,), rows in group(read(folder / 'fig11.csv'), 'source').items():
        if len({row['distance_from_m'] for row in rows}) < 4:
            continue  # no figure against distance where everything is at the same
        figure, axes = plt.subplots(2, 2, figsize=(9, 5.6), sharex=True)
        for axis, (key, title, limits, paper, paper_label) in zip(axes.flat, panels):
            for variant, (color, label) in VARIANTS.items():
                points = [row for row in rows if row['variant'] == variant]
                x = [(number(row['distance_from_m']) + number(row['distance_to_m'])) / 2 for row in points]
                axis.plot(x, column(points, key), marker='o', color=color, label=label)
            if paper is not None:
                axis.plot([0.6, 2.3 if key == 'rate' else 3], [paper, paper], label=paper_label, **PAPER)
            axis.set(title=title, ylim=limits)
        for axis in axes[1]:
            axis.set_xlabel('distance [m]')
        axes[0][0].legend()
        axes[1][0].legend(*[entries[-1:] for entries in axes[1][0].get_legend_handles_labels()])
        judged = sum(int(row['judged']) for row in rows if row['variant'] == 'ours')
        figure.suptitle('%s, %d poses' % (title_of(source), judged), fontsize=11)
        save(figure, folder / ('fig11_%s.png' % source))


def draw_curve(axes, source, rows):
    x, kind = column(rows, 'observations'), rows[0]['type']
    names = [key[2:] for key in rows[0] if key.startswith('p_')]
    for name in names:
        axes[0].plot(x, column(rows, 'p_' + name), marker='o', color=TYPE_COLORS.get(name, 'C4'), label=name)
    if x[-1] > 30:
        axes[0].axvline(30, label='paper: right from here on', **PAPER)
    axes[0].set(title=title_of(source), ylim=(-0.03, 1.03), xlim=(0, 1.04 * x[-1]))
    mean, deviation = column(rows, 'error_mm_mean'), column(rows, 'error_mm_deviation')
    axes[1].errorbar(x, mean, yerr=deviation, marker='o', color='C0', elinewidth=0.8, label='ours, 1 sigma over the runs')
    axes[2].plot(x, column(rows, 'error_deg_mean'), marker='o', color='C0')
    for axis, limit, index in ((axes[1], 30, 0), (axes[2], 15, 1)):
        axis.axhline(PAPER_ERROR[kind][index], label='paper', **PAPER)
        if source in ORIGINAL_ERROR:
            axis.axhspan(*ORIGINAL_ERROR[source][index], color='C1', alpha=0.25, linewidth=0, label='original release')
        axis.set_ylim(0, limit)
    axes[2].set_xlabel('observations')


def draw_models(folder):
    sources = group(read(folder / 'fig12.csv'), 'source')
    # The paper's own two logs and everything with images; the table has the other logs.
    shown = [key[0] for key in sources if '/' not in key[0] or key[0].startswith('stereo/')]
    figure, axes = plt.subplots(3, len(shown), figsize=(2.9 * len(shown), 7), squeeze=False, sharex='col', sharey='row')
    for index, source in enumerate(shown):
        draw_curve(axes[:, index], source, sources[(source,)])
    for axis, label in zip(axes[:, 0], ('probability', 'prediction error [mm]', 'prediction error [deg]')):
        axis.set_ylabel(label)
        axis.legend(loc='upper right' if axis is not axes[0][0] else 'center right')
    save(figure, folder / 'fig12.png')


def draw_unseen(folder):
    rows = [row for row in read(folder / 'fig12_unseen.csv') if row['true_type_error_mm']]
    groups = group([dict(row, group=row['source'].split('/')[0]) for row in rows], 'group', 'type')
    figure, axis = plt.subplots(figsize=(8, 1 + 0.34 * len(groups)))
    labels = []
    for y, ((name, kind), entries) in enumerate(sorted(groups.items(), reverse=True)):
        labels.append('%s, %s (%d)' % (title_of(name), kind, len({row['source'] for row in entries})))
        for share, offset, color in (('0.3', 0.16, 'C1'), ('0.5', -0.16, 'C0')):
            errors = [number(row['true_type_error_mm']) for row in entries if row['trained_share'] == share]
            axis.plot(errors, [y + offset] * len(errors), '.', color=color, alpha=0.5)
            axis.plot([sum(errors) / max(1, len(errors))], [y + offset], '|', color=color, markersize=11, markeredgewidth=2,
                      label='trained on the first %d %%' % (100 * float(share)) if y == 0 else None)
    axis.set(xscale='log', xlabel='error over the farthest tenth of the opening [mm]; bars: means', yticks=range(len(labels)),
             yticklabels=labels, title='prediction of openings never seen')
    axis.legend()
    save(figure, folder / 'fig12_unseen.png')


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    draw_depth_error(folder)
    draw_detection(folder)
    draw_models(folder)
    draw_unseen(folder)


main()
