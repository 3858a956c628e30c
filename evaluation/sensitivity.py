#!/usr/bin/python3
"""What halving and doubling each setting does.

sensitivity.py PROGRAMS LABELS.csv... [--file NAME] [--settings KEY...] [--also COMMAND]

PROGRAMS is the folder of fit_track, of a sourced workspace. Each LABELS.csv has the columns file and type, and stands beside
those logs. The default is the last section of config/articulation.yaml. --also gives a command that scores something else by a
folder of settings, which stands for {config} in it; the last line that it prints is shown. Prints a table in Markdown, the
defaults first.
"""
import argparse
import csv
import re
import subprocess
import tempfile
from pathlib import Path

CONFIG = Path(__file__).resolve().parents[1] / 'config'
SURE = 0.95


def settings(path):
    """(section, key, value, least, most) of every number in a file of settings."""
    section, least, most = '', None, None
    for line in path.read_text().splitlines():
        heading = re.match(r'# ---- (.*)', line)
        allowed = re.match(r'# (?:\[.*\] )?(\S+) to (\S+)$', line)
        value = re.match(r'(\w+): ([-+]?[\d.]+(?:e[-+]\d+)?)$', line)
        if heading:
            section = heading.group(1)
        elif allowed:
            least, most = float(allowed.group(1)), float(allowed.group(2))
        elif value:
            yield section, value.group(1), float(value.group(2)), least, most


def answers(programs, folder, files):
    """Type and its probability, by file."""
    command = [programs / 'fit_track', *files, '--config', folder]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if not result.stdout:
        raise SystemExit('fit_track failed: ' + result.stderr)
    found = {}
    for row in csv.DictReader(result.stdout.splitlines()):
        found[row['file']] = row['type'], float(row.get('p_' + row['type']) or 0)
    return found


def score(programs, folder, labels):
    """Cells of a row: right of all, and how many answers with P > 0.95 are wrong, for each file of labels."""
    cells = []
    for path, types in labels:
        found = answers(programs, folder, list(types))
        right = sum(found[file][0] == kind for file, kind in types.items())
        sure = sum(found[file][0] != kind and found[file][1] > SURE for file, kind in types.items())
        cells.append('%d of %d, %d' % (right, len(types), sure))
    return cells


def also(command, folder):
    output = subprocess.run(command.replace('{config}', str(folder)), shell=True, capture_output=True, text=True, check=False).stdout
    return (output.strip().splitlines() or ['-'])[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('programs', type=Path)
    parser.add_argument('labels', type=Path, nargs='+')
    parser.add_argument('--file', default='articulation')
    parser.add_argument('--settings', nargs='+')
    parser.add_argument('--also', action='append', default=[])
    arguments = parser.parse_args()
    labels = []
    for path in arguments.labels:
        with open(path, newline='') as file:
            labels.append((path, {str(path.parent / row['file']): row['type'] for row in csv.DictReader(file)}))
    known = list(settings(CONFIG / (arguments.file + '.yaml')))
    chosen = [entry for entry in known if (entry[1] in arguments.settings if arguments.settings else entry[0] == known[-1][0])]

    def row(name, line):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / (arguments.file + '.yaml')).write_text(line)
            cells = score(arguments.programs, folder, labels) + [also(command, folder) for command in arguments.also]
        print('| ' + ' | '.join([name] + cells) + ' |', flush=True)

    heads = ['%s: right, wrong with P > %s' % ('/'.join(path.parent.parts[-2:]), SURE) for path, _ in labels] + arguments.also
    print('| setting | ' + ' | '.join(heads) + ' |\n|---|' + '---|' * len(heads))
    row('as it is', '%s: %g\n' % chosen[0][1:3])
    for _, key, value, least, most in chosen:
        for factor in (0.5, 2):
            changed = min(most, max(least, value * factor))
            row('`%s` %g' % (key, changed), '%s: %g\n' % (key, changed))


if __name__ == '__main__':
    main()
