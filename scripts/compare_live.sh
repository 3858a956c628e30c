#!/usr/bin/env bash
# compare_live.sh BAG [runs:=N] [out:=FOLDER] [ARGUMENTS OF replay.launch]: plays a bag to the nodelets, gives it to process_bag,
# and compares all that both say (compare_results.py). The rate is 0.3 unless given, so that nothing is dropped. With runs:=10 it
# is played ten times, and runs that dropped frames are counted. The exit status is 0 if at least one run dropped nothing and all
# of those were equal; the last line says so in words. Example: compare_live.sh door.bag rate:=1.0 runs:=10 fixed_frame:=world
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

if [ $# -eq 0 ] || [ ! -f "$1" ]; then
  echo "expected a bag, not '${1:-}'; usage: compare_live.sh BAG [runs:=N] [out:=FOLDER] [ARGUMENTS OF replay.launch]" >&2
  exit 2
fi
bag=$(realpath "$1")
shift

export PATH=/usr/bin:$PATH
if ! rospack find cabinet_articulation >/dev/null 2>&1; then
  if [ ! -f "$here/../devel/setup.sh" ]; then
    echo "compare_live.sh: the package is not built; run scripts/build.sh, or source the setup file of its workspace" >&2
    exit 2
  fi
  set +eu
  . "$here/../devel/setup.sh"
  set -eu
fi

rate=0.3
runs=1
out=
ns=cabinet
config=$(rospack find cabinet_articulation)/config
camera=stereo
topics=()
offline=(--camera-rectangles)
launch_arguments=()
for argument in "$@"; do
  value=${argument#*:=}
  case $argument in
    rate:=*) rate=$value ;;
    runs:=*) runs=$value ;;
    out:=*) out=$value ;;
    *:=*)
      launch_arguments+=("$argument")
      case $argument in
        ns:=*) ns=$value ;;
        config_dir:=*) config=$value ;;
        fixed_frame:=*) if [ -n "$value" ]; then offline+=(--fixed-frame "$value"); fi ;;
        camera:=*)
          camera=$value
          offline+=(--camera "$value")
          ;;
        input:=*) offline+=(--input "$value") ;;
        rectified:=true) offline+=(--rectified) ;;
        depth_scale:=*) offline+=(--depth-scale "$value") ;;
        left_image:=* | left_info:=* | right_image:=* | right_info:=* | depth_image:=* | depth_info:=*) topics+=("$argument") ;;
      esac
      ;;
    *)
      echo "compare_live.sh: expected NAME:=VALUE, not '$argument'" >&2
      exit 2
      ;;
  esac
done
for argument in "${topics[@]}"; do
  name=${argument%%:=*}
  offline+=("--${name//_/-}" "/$camera/${argument#*:=}")
done
if ! [[ $runs =~ ^[1-9][0-9]*$ ]]; then
  echo "compare_live.sh: runs:=$runs is not a number of runs" >&2
  exit 2
fi
out=$(realpath "${out:-$(mktemp -d)}")
mkdir -p "$out"
echo "bags and logs are in $out"

rosrun cabinet_articulation process_bag "$bag" "$out/offline.bag" --config "$config" "${offline[@]}"

# One run: the replay with a master of its own, and a recorder that hears it from the first frame on.
play() {
  local live=$1 recorder
  . "$here/own_master.sh"
  launch_with_own_master "${live%.bag}.log" replay.launch bag:="$bag" rate:="$rate" paused:=true "${launch_arguments[@]}"
  rosrun rosbag record -b 0 -q -O "$live" "/$ns/rectangles" "/$ns/tracks" "/$ns/models" "/$ns/timing" /diagnostics __name:=record \
    >>"${live%.bag}.log" &
  recorder=$!
  local status=0
  rosrun cabinet_articulation steer_replay.py "$ns" || status=$?
  kill -INT "$recorder"
  wait "$recorder" || true
  if [ $status -ne 0 ]; then grep -E 'WARN|ERROR|FATAL' "${live%.bag}.log" | tail -n 20 || true; fi
  return $status
}

complete=0
equal=0
dropping=0
for ((run = 1; run <= runs; ++run)); do
  live=$out/live_$run.bag
  (play "$live") || {
    echo "run $run could not be played (log: ${live%.bag}.log)"
    exit 1
  }
  status=0
  rosrun cabinet_articulation compare_results.py "$live" "$out/offline.bag" --ns "$ns" >"${live%.bag}.txt" || status=$?
  cat "${live%.bag}.txt"
  if [ $status -gt 1 ]; then exit 1; fi
  dropped=$(sed -n 's/^models: .* \([0-9]*\) only offline;.*/\1/p' "${live%.bag}.txt")
  echo "run $run: $dropped frames were dropped"
  if [ "$dropped" -gt 0 ]; then
    dropping=$((dropping + 1))
  else
    complete=$((complete + 1))
    if [ $status -eq 0 ]; then equal=$((equal + 1)); fi
  fi
done

echo "$dropping of $runs runs at rate $rate dropped frames; $equal of the $complete others gave the same as process_bag"
[ $complete -gt 0 ] && [ $equal -eq $complete ]
