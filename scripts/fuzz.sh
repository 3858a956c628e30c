#!/usr/bin/env bash
# fuzz.sh MINUTES [TARGET...]: installs what is missing, builds the fuzz targets (test/fuzz) with the address and the undefined
# behaviour sanitizer in build_fuzz/, and runs each, or those named, for MINUTES, as many at a time as there are processors.
# With clang's libFuzzer if clang++ is there, else with the compiler at hand and a seeded loop. Prints one line for each target.
# Inputs that are findings stay in build_fuzz/findings/TARGET with what was said about them; the exit status is 1 if there are any.
set -euo pipefail
if ! [[ ${1:-} =~ ^[0-9]*\.?[0-9]+$ ]]; then
  echo "expected a number of minutes, not '${1:-}'; usage: fuzz.sh MINUTES [TARGET...]" >&2
  exit 2
fi
seconds=$(awk "BEGIN { print int($1 * 60 + 0.5) }")
if [ "$seconds" -lt 1 ]; then
  echo "expected at least a second, not '$1' minutes" >&2
  exit 2
fi
shift

. "$(dirname "${BASH_SOURCE[0]}")/ros_environment.sh"
build=$root/build_fuzz
# Assertions count, so it is no release. Casts of numbers that are too large are checked on top of what `undefined` means.
flags="-O1 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all"
flags+=" -DEIGEN_MALLOC_ALREADY_ALIGNED=1"
# OpenCV's intrinsics load words from wherever they are, on purpose.
flags+=" -fno-sanitize=alignment"
# The choice between clones is made before the sanitizers are there, and libFuzzer counts that it was made.
flags+=" -include $root/test/sanitizers/no_clones.h"
if echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
  clang++ -fsanitize=fuzzer -x c++ - -o /dev/null 2>/dev/null; then
  export libfuzzer=true
  fuzzer=(-DCMAKE_CXX_COMPILER=clang++ -DCABINET_ARTICULATION_FUZZER=ON -DCMAKE_CXX_FLAGS="$flags -fsanitize=fuzzer-no-link")
else
  export libfuzzer=false
  fuzzer=(-DCABINET_ARTICULATION_FUZZER=OFF -DCMAKE_CXX_FLAGS="$flags")
fi
mkdir -p "$build/findings" "$build/corpus"
configure "$build" "$build/devel" -DCMAKE_BUILD_TYPE=Debug "${fuzzer[@]}"
rm -f "$build"/devel/lib/cabinet_articulation/*_fuzz  # of targets that have another name now
make -C "$build" -j"$(nproc)" --no-print-directory fuzzers >"$build/make.log" 2>&1 || { tail -n 50 "$build/make.log"; exit 1; }

programs=$build/devel/lib/cabinet_articulation
if [ $# -eq 0 ]; then
  set -- $(cd "$programs" && ls -d *_fuzz | sed 's/_fuzz$//')
fi
if [ $# -eq 0 ]; then
  echo "no fuzz targets were built in $programs" >&2
  exit 1
fi
export build root seconds programs
export ASAN_OPTIONS=allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1
[ -d /dev/shm ] && export TMPDIR=/dev/shm

fuzz_one() {
  local target=$1 findings=$build/findings/$1 corpus=$root/test/fuzz/corpus/$1 grown=$build/corpus/$1
  local log=$findings/log.txt status=0 start=$SECONDS runs
  rm -f "$findings/log.txt"
  mkdir -p "$findings" "$grown"
  cd "$findings"
  if $libfuzzer; then
    local folders=("$grown")
    [ -d "$corpus" ] && folders+=("$corpus")
    "$programs/${target}_fuzz" "${folders[@]}" -max_total_time="$seconds" -max_len=65536 -timeout=60 -rss_limit_mb=3000 -malloc_limit_mb=1000 \
      -print_final_stats=1 -verbosity=1 -artifact_prefix="$findings/" >"$log" 2>&1 || status=$?
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  else
    "$programs/${target}_fuzz" "$corpus" --seconds "$seconds" --seed "$RANDOM" --running "$findings/input" >"$log" 2>&1 || status=$?
    runs=$(sed -n 's/^Done \([0-9]*\) runs.*/\1/p' "$log")
  fi
  local count=0
  [ "$status" -eq 0 ] || count=1
  echo "$target: ${runs:-unknown} runs, $((SECONDS - start)) seconds, $count findings$([ $count -eq 0 ] || echo "; see $findings")"
  return "$count"
}
export -f fuzz_one

printf '%s\n' "$@" | xargs -P "$(nproc)" -I TARGET bash -c 'fuzz_one TARGET' && status=0 || status=1
[ "$status" -eq 0 ] && echo "no findings" || echo "there are findings"
exit "$status"
