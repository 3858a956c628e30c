#!/usr/bin/env bash
# Installs what is missing, builds, runs every unit test and every rostest.
# The last line is "N passed, N failed"; the exit status says the same.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(dirname "$here")/build

export PATH=/usr/bin:$PATH
if ! "$here/build.sh" tests; then
  echo "the build failed"
  echo "0 passed, 1 failed"
  exit 1
fi
rm -rf "$build/test_results"
set +eu
. "$here/../devel/setup.sh"
# One after the other: the rostests measure rates, and the machine may have two cores.
make -C "$build" --no-print-directory run_tests
run_status=$?
/usr/bin/python3 "$here/summarize_tests.py" "$build/test_results" "$run_status"
