# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# Functions shared by the scripts in this folder; sourced, not run.

repository=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_dir=${DATMO_FUSION_BUILD_DIR:-$repository/build}
# rosrun does not search below PACKAGE/build, so the devel space of the default folder is next to it.
if [[ $build_dir == "$repository/build" ]]; then devel_dir=$repository/devel; else devel_dir=$build_dir/devel; fi
program_dir=$devel_dir/lib/datmo_fusion
log_dir=$build_dir/log

# job_count: prints the number of parallel compilers: one per core, limited by the available memory,
# as compiling a file that includes roscpp and pluginlib takes about 1.2 GB.
job_count() {
  local cores jobs_in_memory
  cores=$(nproc)
  jobs_in_memory=$(awk '/^MemAvailable/ { print int($2 / 1.2e6) }' /proc/meminfo)
  local jobs=$((cores < jobs_in_memory ? cores : jobs_in_memory))
  echo $((jobs > 0 ? jobs : 1))
}

# Debian's ROS requires Debian's Python: another python3 that comes first on PATH breaks it.
export PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin

# Ubuntu's ROS is in a folder of its own, Debian's is not.
if [[ -f /opt/ros/noetic/setup.bash ]]; then
  set +u # catkin's setup.bash reads unset variables
  # shellcheck disable=SC1091
  source /opt/ros/noetic/setup.bash
  set -u
fi

# Objects compiled in one checkout are reused in another, including precompiled headers.
export CCACHE_BASEDIR=${repository%/*} CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros

# Prints the purpose and usage of the sourcing script, which are in its header.
if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '3,/^[^#]/s/^# \{0,1\}//p' "$0"
  exit
fi

say() { printf '== %s\n' "$*"; }

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# run_logged NAME COMMAND...: writes the command's output to a log, and shows its end only on
# failure. Returns the command's own exit code.
run_logged() {
  local name=$1 log started=$SECONDS code=0
  shift
  mkdir -p "$log_dir"
  log=$log_dir/${name// /_}.log
  printf '== %s ... ' "$name"
  "$@" >"$log" 2>&1 || code=$?
  if ((code == 0)); then
    printf 'ok (%d s)\n' $((SECONDS - started))
  else
    printf 'FAILED (%d s)\n' $((SECONDS - started))
    tail -n 40 "$log" >&2
    printf "error: step '%s' failed with exit code %d; full log: %s\n" "$name" "$code" "$log" >&2
  fi
  return "$code"
}

# configure_tree FOLDER CMAKE_OPTION...: configures a build tree. Files of a folder are compiled
# together, unless DATMO_FUSION_UNITY=OFF is set in the environment. Warnings are errors only with
# Debian 12's compiler, which the code is tested with.
configure_tree() {
  local options=(-S "$repository" -B "$1" "-DDATMO_FUSION_UNITY=${DATMO_FUSION_UNITY:-ON}")
  if grep -q '^VERSION_CODENAME=bookworm' /etc/os-release; then
    options+=(-DDATMO_FUSION_WERROR=ON)
  fi
  if command -v ccache >/dev/null; then
    options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  # Generates messages only for the languages used here.
  ROS_LANG_DISABLE=geneus:genlisp:gennodejs cmake "${options[@]}" "${@:2}"
}

# Sets the environment of a built tree, for everything that uses ROS. The master's port is a free
# one, so that it does not interfere with a master that is already running.
use_ros() {
  set +u # catkin's setup.bash reads unset variables
  # shellcheck disable=SC1091
  source "$devel_dir/setup.bash"
  set -u
  local port
  port=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI=http://localhost:$port ROS_HOSTNAME=localhost ROS_LOG_DIR=$log_dir/ros
  mkdir -p "$ROS_LOG_DIR"
}
