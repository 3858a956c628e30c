#!/usr/bin/env bash
# soak.sh MINUTES [ROSLAUNCH ARGUMENTS]: installs what is missing, builds, lets a simulated kitchen be used for MINUTES of
# simulated time in front of the whole pipeline, as fast as the pipeline goes, and prints every minute what it costs and what
# is known. The last line and the exit status say whether everything held: door and drawer known all the time and saved at the
# end, and, in runs of more than ten minutes, memory, objects and times that do not grow. Example: soak.sh 60 scene_seed:=2
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(dirname "$here")/build

if ! [[ ${1:-} =~ ^[0-9]*\.?[0-9]+$ ]]; then
  echo "expected a number of minutes, not '${1:-}'; usage: soak.sh MINUTES [ROSLAUNCH ARGUMENTS]" >&2
  exit 2
fi
minutes=$1
shift

export PATH=/usr/bin:$PATH
"$here/build.sh"
set +eu
. "$here/../devel/setup.sh"
set -eu

. "$here/own_master.sh"
launch_with_own_master "$build/soak.log" soak.launch "$@"

echo "$minutes minutes of a simulated kitchen (log: $build/soak.log)"
rm -f "$build/soak.yaml"
rosrun cabinet_articulation soak_report truth:=/stereo/truth models:=/cabinet/models timing:=/cabinet/timing \
  predict:=/cabinet/predict save_models:=/cabinet/save_models _minutes:="$minutes" _file:="$build/soak.yaml" 2>&1
