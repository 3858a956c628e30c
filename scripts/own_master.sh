# Sourced by demo.sh, soak.sh, compare_live.sh and measure_live.sh: launch_with_own_master LOG LAUNCH_FILE [ARGUMENTS], with a
# master of its own, so that the run neither needs nor disturbs one that is there. Returns when the master answers; all ends with
# the script.

stop_launch() {
  kill -INT "$launch" 2>/dev/null || true
  wait "$launch" 2>/dev/null || true
}

launch_with_own_master() {
  local log=$1 port
  shift
  port=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI=http://localhost:$port ROS_HOSTNAME=localhost
  roslaunch -p "$port" cabinet_articulation "$@" >"$log" 2>&1 &
  launch=$!
  trap stop_launch EXIT
  until /usr/bin/python3 -c 'import rosgraph, sys; sys.exit(not rosgraph.is_master_online())'; do
    if ! kill -0 "$launch" 2>/dev/null; then
      cat "$log"
      exit 1
    fi
    sleep 0.2
  done
}
