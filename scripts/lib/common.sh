# Sourced by the scripts of this folder: where things are, and an environment that does not depend on the caller's.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# The builds with sanitizers have folders of their own: scripts/test --sanitize, scripts/fuzz.
build=${IMD_BUILD:-$root/build}
devel=$root/devel
[ "$build" = "$root/build" ] || devel=$build/devel
export LC_ALL=C.UTF-8

# ROS's Python modules belong to the system's Python; another python3 in front of it would not find them.
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

# The next phase, and how long all before it has taken. Scripts that this one calls count on from the same moment.
export IMD_BEGUN=${IMD_BEGUN:-$EPOCHSECONDS}
say() { printf '\n== %s  [%d s]\n' "$*" $((EPOCHSECONDS - IMD_BEGUN)); }
die() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

# ROS's own setup files read unset variables.
source_ros() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

# A distribution under /opt/ros (Noetic, ROS-O) that the caller has not chosen yet. Debian's ROS needs no set-up.
if [ -z "${ROS_DISTRO:-}" ]; then
  for setup in /opt/ros/*/setup.bash; do
    if [ -e "$setup" ]; then source_ros "$setup"; fi
  done
fi
