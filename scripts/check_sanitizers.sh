#!/usr/bin/env bash
# check_sanitizers.sh [address|thread]: installs what is missing, builds the package anew with gcc's sanitizers in
# build/<sanitizer>/ and runs its tests and tools. Without an argument, it takes one sanitizer after the other. Programs are put
# into $XDG_CACHE_HOME/cabinet_articulation/sanitizers.
#
# address: AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer on all tests (some replay bags) and on the tools.
# thread: ThreadSanitizer on all tests, most of them with the nodelets in one manager. See not_run_thread for what is left out.
#
# What any process reports counts, also that of a nodelet whose test passed. The last line says how many reports there were, how
# many tests failed and how many suppressions are in force. The exit status says the same.
set -euo pipefail

case "$*" in
  "") sanitizers=(address thread) ;;
  address | thread) sanitizers=("$1") ;;
  *)
    echo "unknown arguments '$*'; usage: check_sanitizers.sh [address|thread]" >&2
    exit 2
    ;;
esac

. "$(dirname "${BASH_SOURCE[0]}")/ros_environment.sh"
settings=$root/test/sanitizers

# By their names in make's targets. With a sanitizer, a program is 2 to 20 times slower. So tests that must be through in a given
# time are run for what they report, and their own verdict does not count. Those that compare times are not run, nor is the one
# that puts a count of its own in malloc's place.
unjudged=(
  end_to_end.test end_to_end__scene_drawer.test end_to_end__scene_static.test end_to_end__scene_door__input_disparity.test
  end_to_end__scene_drawer__input_depth.test end_to_end__scene_kitchen__camera_motion_true.test
  two_cameras.test two_cameras__one_manager_true.test looped_bag.test nodes.test two_managers.test realsense.test operator.test
  hostile_messages.test model_saving_test simulated_stereo_camera.test simulated_stereo_camera_test
  # Frames are dropped, and what was learned then differs from what process_bag learns.
  parity__scene_door.test parity__scene_drawer__camera_motion_0.1.test parity__scene_drawer__rounds_2.test
  parity__scene_door__input_disparity.test parity__scene_drawer__camera_motion_0.1__input_disparity.test
  parity__scene_door__input_depth.test parity__scene_drawer__camera_motion_0.1__input_depth.test
  parity__scene_door__input_rectified.test parity__scene_door__input_millimetres.test
)
# long_use_test takes ten minutes in one thread. endurance_test and incremental_fit_test run the same code for less long.
# soak.test plays to the end of a scene again and again. Those above do the same with the same nodelets.
not_run_address=(track_cost_test plane_memory_test block_matcher_memory_test long_use_test soak.test)
not_run_thread=(
  track_cost_test plane_memory_test block_matcher_memory_test long_use_test soak.test
  # Has several threads in OpenCV's pool, which keeps an order that is not seen.
  thread_count_test
  # As soak.test, with recordings.
  parity__scene_door.test parity__scene_drawer__camera_motion_0.1.test parity__scene_drawer__rounds_2.test
  parity__scene_door__input_disparity.test parity__scene_drawer__camera_motion_0.1__input_disparity.test
  parity__scene_door__input_depth.test parity__scene_drawer__camera_motion_0.1__input_depth.test
  parity__scene_door__input_rectified.test parity__scene_door__input_millimetres.test
)

# Assertions are on: CMake's build type None adds no NDEBUG. Inline functions stay within each library: otherwise the copies
# in ROS's libraries, which are not instrumented, would serve for ours.
flags="-O1 -g1 -fno-omit-frame-pointer -fvisibility-inlines-hidden"
flags_address="$flags -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all -DEIGEN_MALLOC_ALREADY_ALIGNED=1"
flags_thread="$flags -fsanitize=thread -include $settings/thread.h"
suppressions_address=$settings/leak.supp
suppressions_thread=$settings/thread.supp

build_with() {
  local flags=flags_$1 runtime= include=() library=()
  if [ -d /opt/ros/noetic ]; then include=(-I/opt/ros/noetic/include) library=(-L/opt/ros/noetic/lib); fi
  local compile=(g++ -std=c++17 ${!flags} "${include[@]}")
  mkdir -p "$build" "$devel/lib/nodelet"
  if [ "$1" = thread ]; then
    runtime=$build/libthread_runtime.so
    "${compile[@]}" -fno-visibility-inlines-hidden -fPIC -shared "$settings/thread_runtime.cpp" -lopencv_core -o "$runtime" ||
      return 1
  fi
  # The linker puts the runtime before all other libraries of a program.
  configure "$build" "$devel" -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="${!flags}" \
    -DCMAKE_EXE_LINKER_FLAGS="$runtime" || return 1
  make -C "$build" -j"$(nproc)" --no-print-directory all tests || return 1
  # roslaunch finds this program `nodelet` first. Reports name our functions only if the library is there from the start.
  "${compile[@]}" -DROS_NODELET="\"$ros_nodelet\"" "$settings/nodelet_manager.cpp" $runtime -o "$devel/lib/nodelet/nodelet" \
    "${library[@]}" -lnodeletlib -lroscpp -lrosconsole -lrostime -L"$devel/lib" -Wl,-rpath,"$devel/lib" \
    -Wl,--no-as-needed -lcabinet_articulation_nodelets
}

# The tools as a user runs them, on small inputs. The tests run some of them too, and export_urdf.
run_tools() {
  local tools=$devel/lib/cabinet_articulation input
  rm -rf "$build/tools"
  mkdir "$build/tools"
  cd "$build/tools"
  for input in stereo disparity depth; do
    "$tools/simulated_bag" drawer $input.bag --input $input --first 30 --frames 20 || return 1
    "$tools/process_bag" $input.bag $input.out.bag --input $input || return 1
  done
  # A door of 0.4 m that turns about z. The depth image has 640 x 480 px, 1.5 m everywhere but for a front 1 m away.
  awk 'BEGIN { for (i = 0; i < 50; ++i) { q = 0.02 * i; print 0.4 * cos(q), 0.4 * sin(q), 1, 0, 0, sin(q / 2), cos(q / 2) } }' \
    >door.log
  awk 'BEGIN { print "P2 640 480 65535"
    for (v = 0; v < 480; ++v) for (u = 0; u < 640; ++u) print (u >= 200 && u < 400 && v >= 180 && v < 280 ? 1000 : 1500) }' \
    >depth.pgm
  "$tools/fit_track" door.log && "$tools/detect_image" depth.pgm overlay.png --fx 500
}

# The names of make's targets that run one test each. targets gtest|rostest +|- NAME...: with these names (+), or all others (-).
targets() {
  local kind=$1 which=$2 target name
  shift 2
  make -C "$build" help | grep -o "_run_tests_[a-z_]*_${kind}_.*" | while read -r target; do
    name=${target##*_"$kind"_}
    [[ " $* " == *" ${name#test_nodelets_} "* ]] && name=+ || name=-
    # Without what the target depends on: each would first remove the results of those before.
    [ $name = "$which" ] && echo "$target/fast"
  done
}

# Runs tests: run_tests +|- NAME..., as above. The rostests one after the other, for each has many processes.
run_tests() {
  local status=0 tests
  tests=$(targets gtest "$@")
  [ -z "$tests" ] || make -C "$build" --no-print-directory -k -j"$(nproc)" $tests || status=1
  tests=$(targets rostest "$@")
  [ -z "$tests" ] || make -C "$build" --no-print-directory -k $tests || status=1
  return $status
}

# Everything that was built; all processes put their reports into files. Its status tells nothing of tests that failed.
run_all() (
  set +eu
  . "$devel/setup.sh"
  export ASAN_OPTIONS="log_path=$reports/$1:handle_abort=1" UBSAN_OPTIONS="log_path=$reports/$1:print_stacktrace=1"
  export LSAN_OPTIONS="suppressions=$suppressions_address:print_suppressions=0"
  export TSAN_OPTIONS="log_path=$reports/$1:suppressions=$suppressions_thread:print_suppressions=0:history_size=7:handle_abort=1"
  status=0
  local without_verdict=() name
  for name in "${unjudged[@]}"; do [[ " ${not_run[*]} " == *" $name "* ]] || without_verdict+=("$name"); done
  run_tests + "${without_verdict[@]}" || status=1
  rm -rf "$build/test_results"
  run_tests - "${unjudged[@]}" "${not_run[@]}" || status=1
  if [ "$1" = address ]; then run_tools || status=1; fi
  exit $status
)

# Every report ends with a summary; what has none is the last word of a process that died.
count_reports() {
  local file
  for file in "$reports"/*; do
    [ -s "$file" ] || continue
    grep '^SUMMARY' "$file" >>"$build/reports.txt" || { head -n 5 "$file" >&2 && echo "$file" >>"$build/reports.txt"; }
  done
  # gcc's UndefinedBehaviorSanitizer writes to the terminal, whatever log_path says.
  # And roslaunch says of which process it was a surprise that it ended, whose verdict may not count.
  grep -hE 'runtime error: |has died' "$build/run.log" >>"$build/reports.txt" || true
  sort "$build/reports.txt" | uniq -c >&2
  wc -l <"$build/reports.txt"
}

# Prints what went wrong, and adds to the verdict. False if anything did.
check() {
  local build=$root/build/$1 status=0 tests count
  local reports=$build/reports
  # Out of the package, where rosrun would find each program twice; one for each clone, or make would take another's for its own.
  local devel=${XDG_CACHE_HOME:-$HOME/.cache}/cabinet_articulation/sanitizers/$(cksum <<<"$root" | cut -d ' ' -f 1)-$1
  local -n not_run=not_run_$1 supp=suppressions_$1
  if ! build_with "$1"; then
    verdict+=("$1: the build failed")
    return 1
  fi
  rm -rf "$reports" "$build/reports.txt" "$build/test_results"
  mkdir "$reports"
  touch "$build/reports.txt"
  run_all "$1" 2>&1 | tee "$build/run.log" || status=$?
  tests=$(/usr/bin/python3 "$root/scripts/summarize_tests.py" "$build/test_results" "$status") || status=1
  echo "$tests"
  count=$(count_reports)
  echo "$1: not run are ${not_run[*]:-none}; run without their verdict ${unjudged[*]:-none}"
  verdict+=("$1: $count reports, tests ${tests##*$'\n'}, $(grep -c '^[a-z]' "$supp") suppressions")
  [ "$count" -eq 0 ] && [ "$status" -eq 0 ]
}

ros_nodelet=$(catkin_find --first-only --libexec nodelet nodelet)
verdict=()
result=clean
for sanitizer in "${sanitizers[@]}"; do check "$sanitizer" || result="not clean"; done
printf -v text '; %s' "${verdict[@]}"
echo "$result: ${text:2}"
[ "$result" = clean ]
