#!/usr/bin/env bash
# Reproduces the paper's figures: run.sh [--sequences FOLDER] [--tracks FOLDER] [--page] [OUT]
# Writes tables (CSV), figures (PNG) and a summary.md to OUT (build/figures unless given). The simulator is all it needs.
# With --page, tables and figures also go into doc/evaluation.md.
# Builds first if the programs are missing; CABINET_BUILD names another build folder, which must have them.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname "$here")
build=${CABINET_BUILD:-$root/build}

sequences= tracks= out= page=
while [ $# -gt 0 ]; do
  case $1 in
    --sequences | --tracks)
      [ $# -ge 2 ] || { echo "$1 needs a folder" >&2; exit 1; }
      [ "$1" = --sequences ] && sequences=$2 || tracks=$2
      shift 2 ;;
    --page) page=$root/doc/evaluation.md; shift ;;
    -*) sed -n 2,5p "$0" >&2; exit 1 ;;
    *) out=$1; shift ;;
  esac
done
out=${out:-$build/figures}

programs=$build/devel/lib/cabinet_articulation/evaluation
if [ ! -x "$programs/fig12_models" ]; then
  [ -z "${CABINET_BUILD:-}" ] || { echo "no programs in $programs: build there, or unset CABINET_BUILD" >&2; exit 1; }
  "$root/scripts/build.sh"
fi
export LD_LIBRARY_PATH=$build/devel/lib:${LD_LIBRARY_PATH:-}
"$programs/fig03_depth_error" --sequences "$sequences" "$out"
"$programs/fig11_detection" --sequences "$sequences" "$out"
"$programs/fig12_models" --sequences "$sequences" --tracks "$tracks" "$out"
/usr/bin/python3 "$here/summarize.py" "$out" ${page:+"$page"}
/usr/bin/python3 "$here/plot.py" "$out"
if [ -n "$page" ]; then
  for figure in fig03 fig12 fig12_unseen; do cp "$out/$figure.png" "$root/doc/images/$figure.png"; done
  cp "$out/fig11_simulated_hanging_drawer.png" "$root/doc/images/fig11.png"
fi
