#!/usr/bin/env bash
# Writes config/*.yaml, config/paper/*.yaml and the parameters in doc/nodelets/*.md again from the code:
# update_config.sh [BUILD_FOLDER]
set -euo pipefail
root=$(dirname "$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)")
build=${1:-$root/build}
export LD_LIBRARY_PATH=$build/devel/lib:${LD_LIBRARY_PATH:-}
mkdir -p "$root/config/paper"
for stage in {,paper/}{stereo,planes,rectangles,tracking,articulation,simulation}; do
  "$build/devel/lib/cabinet_articulation/print_config" "$stage" >"$root/config/$stage.yaml"
done
for page in "$root"/doc/nodelets/*.md; do
  # The table is the last section of a page.
  sed -i '/^## Parameters$/,$d' "$page"
  printf '## Parameters\n' >>"$page"
  "$build/devel/lib/cabinet_articulation/print_config" --table "$(basename "$page" .md)" >>"$page"
done
