# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# Functions that show a drive in rviz, on the display or on a virtual one; sourced after lib.sh.

started=() # process ids, terminated when the script ends

# start NAME COMMAND...: runs the command in the background, with its output in a log.
start() {
  local name=$1
  shift
  "$@" >"$log_dir/$name.log" 2>&1 &
  started+=($!)
}

end_all() {
  local i
  for ((i = ${#started[@]} - 1; i >= 0; --i)); do
    kill "${started[i]}" 2>/dev/null || true
    wait "${started[i]}" 2>/dev/null || true
  done
  started=()
}

# wait_for SECONDS WHAT COMMAND...: waits until the command succeeds.
wait_for() {
  local seconds=$1 what=$2
  shift 2
  for ((; seconds > 0; --seconds)); do
    if "$@" >/dev/null 2>&1; then return; fi
    sleep 1
  done
  fail "$what; the output of its programs is in $log_dir"
}

start_virtual_display() {
  local number=$log_dir/display
  rm -f "$number"
  start xvfb Xvfb -displayfd 3 -screen 0 1600x1000x24 +extension GLX -nolisten tcp 3>"$number"
  wait_for 20 "the virtual display did not start" test -s "$number"
  DISPLAY=:$(<"$number")
  export DISPLAY LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1
  export XDG_RUNTIME_DIR=$log_dir/xdg
  mkdir -p "$XDG_RUNTIME_DIR"
  chmod 700 "$XDG_RUNTIME_DIR"
}

# An empty display has one color, while rviz's window has many.
rviz_is_drawn() {
  (($(import -window root png:- | identify -format '%k' -) > 50))
}

# no_result NAME WHAT: ends the script, with the first errors in a program's output.
no_result() {
  local log=$log_dir/$1.log
  grep -m 3 -i error "$log" >&2 || true
  fail "$2; full log: $log"
}

start_master() {
  start roscore roscore -p "${ROS_MASTER_URI##*:}"
  wait_for 30 "the ROS master did not start" rosparam set /use_sim_time true
}
