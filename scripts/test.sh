#!/usr/bin/env bash
# test.sh [unit]: installs what is missing, builds, runs every unit test and every rostest; with `unit` the unit tests alone.
# The last line is "N passed, N failed"; the exit status says the same.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(dirname "$here")/build

case "$*" in
  "")
    targets=tests
    others=run_other_tests
    ;;
  unit)
    targets=unit_tests
    others=
    ;;
  *)
    echo "unknown arguments '$*'; usage: test.sh [unit]" >&2
    exit 2
    ;;
esac

export PATH=/usr/bin:$PATH
if ! "$here/build.sh" $targets; then
  echo "the build failed"
  echo "0 passed, 1 failed"
  exit 1
fi
rm -rf "$build/test_results"
set +eu
. "$here/../devel/setup.sh"
make -C "$build" --no-print-directory -j"$(nproc)" run_unit_tests
run_status=$?
if [ -n "$others" ]; then
  # One after the other: the rostests measure rates, and the machine may have two cores.
  make -C "$build" --no-print-directory -j1 $others || run_status=$?
fi
/usr/bin/python3 "$here/summarize_tests.py" "$build/test_results" "$run_status"
