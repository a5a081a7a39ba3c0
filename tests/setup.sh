# What examples/demo and the test scripts share: packages, builds, counts.  Sourced from the top of the tree, not run.
#
# SPDX-License-Identifier: LGPL-3.0-or-later

build=${BUILD:-build}
yes=

# The head comment of a script, as its help.
usage ()
{
  sed -n '2,/^# SPDX/s/^# \{0,1\}//p' "$0" | sed '$d'
  exit 2
}

# logs_open: makes the build folder, where the output of every step is kept
logs_open ()
{
  mkdir -p "$build/logs" && logs=$(cd "$build/logs" && pwd)
}

as_root ()
{
  if [ "$(id -u)" = 0 ]; then
    "$@"
  else
    sudo "$@"
  fi
}

# packages_of GROUP...: names from tests/packages
packages_of ()
{
  local group
  for group; do
    sed -n "s/^$group //p" tests/packages
  done
}

# packages_missing GROUP...: those that are not installed
packages_missing ()
{
  packages_of "$@" | while read -r package; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || echo "$package"
  done
}

# packages_install GROUP...: asks first when a person is at the terminal, unless -y was given
packages_install ()
{
  local missing answer
  missing=$(packages_missing "$@" | tr '\n' ' ')
  [ -n "$missing" ] || return 0
  echo "Debian packages needed: $missing"
  if [ -z "$yes" ] && [ -t 0 ]; then
    printf 'Install them now? [Y/n] '
    read -r answer
    case $answer in [Nn]*) return 1 ;; esac
  fi
  export DEBIAN_FRONTEND=noninteractive
  # A list of packages that is missing or out of date makes the first try fail.
  # shellcheck disable=SC2086
  as_root apt-get -qy install --no-install-recommends $missing >"$logs/packages.log" 2>&1 ||
    { as_root apt-get -q update && as_root apt-get -qy install --no-install-recommends $missing
    } >"$logs/packages.log" 2>&1 ||
    { tail "$logs/packages.log"; return 1; }
}

# build_tree FOLDER MESON-OPTION...: configures once, then builds
build_tree ()
{
  local folder=$1
  shift
  [ -e "$folder/build.ninja" ] || meson setup "$folder" "$@" || return 1
  ninja -C "$folder"
}

# A build with a sanitizer, by -O1: more of its time is the compiler's than that of what runs.  By clang, so that one
# build shows the other compiler's warnings, too.  Its checks of C++ types need programs in C++, and ours are in C; and it
# finds what throws exceptions at the start only, but the module for files is loaded later: so all programs load C++.
build_sanitized ()
(
  folder=$1 sanitizer=$2
  CC=clang CXX=clang++
  export CC CXX
  [ -e "$folder/build.ninja" ] ||
    meson setup "$folder" -Ddebug=true -Doptimization=1 -Db_lundef=false -Db_sanitize="$sanitizer" \
      -Dcpp_args=-fno-sanitize=function,vptr -Dc_link_args=-Wl,--no-as-needed,-lstdc++,--as-needed || exit 1
  shift 2
  ninja -C "$folder" "$@"
)

# install_for_user FOLDER HOME: builds in the folder without tests, and installs into a home.  A kept build that is
# configured again needs it too, or plug-ins would go to the system.  Compiling keeps the caller's home, and with it the
# compiler's cache.
install_for_user ()
{
  [ -e "$1/build.ninja" ] || HOME=$2 meson setup "$1" --prefix "$2/.local" -Dtests=false || return 1
  HOME=$2 ninja -C "$1" build.ninja && ninja -C "$1" && HOME=$2 meson install -C "$1" --no-rebuild
}

# use_build FOLDER: `gegl` and `celdepth` of this build come first
use_build ()
{
  local built
  built=$(cd "$1" && pwd)
  PATH=$built/plugin/cli:$PATH
  GEGL_PATH=$(pkg-config --variable=pluginsdir gegl-0.4):$built/gegl-ops
  export PATH GEGL_PATH
}

# ------------------------------------------------------------------ steps of a test run

passed=0 failed=0 skipped=0
spent= started= running= begun=

# step NAME COMMAND...: adds up the counts of the command's last line `N passed, N failed[, N skipped]`; without such a
# line the command itself is one test.  Its output is shown if it fails, and kept in $logs.
step ()
{
  started=${started:-$(date +%s)}
  step_run "$@"
  step_count "$1"
}

# step_start NAME COMMAND...: the same side by side with others, as many as there are processors, until steps_finish.
# For steps of about the same duration: the next one waits for the oldest.
step_start ()
{
  started=${started:-$(date +%s)}
  if [ "$(echo "$running" | wc -w)" -ge "$(nproc)" ]; then
    wait "${running%% *}"
    running=${running#* }
  fi
  step_run "$@" &
  running="$running$! "
  begun=$begun$1'
'
}

# steps_finish: counts what step_start began, in that order
steps_finish ()
{
  local name names=$begun
  # shellcheck disable=SC2086
  wait $running
  running= begun=
  while IFS= read -r name; do
    [ -z "$name" ] || step_count "$name"
  done <<NAMES
$names
NAMES
}

step_log ()
{
  echo "$logs/$(echo "$1" | tr -c 'a-zA-Z0-9\n' -).log"
}

# What an earlier run left of a step does not count for one that is not reached.
step_forget ()
{
  rm -f "$(step_log "$1").status"
}

# Runs a step, and leaves its exit status and seconds beside its log.
step_run ()
{
  local log begin status
  log=$(step_log "$1")
  begin=$(date +%s)
  shift
  "$@" >"$log" 2>&1 </dev/null
  status=$?
  echo $status $(($(date +%s) - begin)) >"$log.status"
}

# Counts and prints what a step left, and answers whether nothing failed.
step_count ()
{
  local name=$1 log seconds status counts step_failed
  log=$(step_log "$name")
  read -r status seconds <"$log.status"
  spent=$spent$(printf '%6d s  %s' "$seconds" "$name")'
'
  counts=$(sed -nE 's/^([a-z]+: )?([0-9]+) passed, ([0-9]+) failed(, ([0-9]+) skipped)?$/\2 \3 \5/p' "$log" | tail -n 1)
  [ -n "$counts" ] || counts=$([ "$status" = 0 ] && echo 1 0 || echo 0 1)
  # shellcheck disable=SC2086
  set -- $counts
  step_failed=$2
  [ "$status" = 0 ] || [ "$step_failed" -gt 0 ] || step_failed=1
  passed=$((passed + $1)) failed=$((failed + step_failed)) skipped=$((skipped + ${3:-0}))
  printf '%-44s %4d s   %s passed, %s failed, %s skipped.\n' \
    "$name" "$seconds" "$1" "$step_failed" "${3:-0}"
  [ "$step_failed" = 0 ] || { sed 's/^/    /' "$log" | tail -n 60; echo "    (all of it: $log)"; }
  [ "${3:-0}" = 0 ] || grep -i skip "$log" | sed 's/^/    /' | head
  [ "$step_failed" = 0 ]
}

# step_end: where the time went, and the closing line with its exit status; in CI a skipped test is a failed one
step_end ()
{
  printf '\nSeconds, longest first:\n%s%6d s  in all\n\n' "$(printf %s "$spent" | sort -rn)
" $(($(date +%s) - started))
  if [ "${CI-}" = true ]; then
    failed=$((failed + skipped))
    skipped=0
  fi
  echo "$passed passed, $failed failed, $skipped skipped"
  [ "$failed" = 0 ] && [ "$passed" -gt 0 ]
}

# meson_test FOLDER OPTION...: the test programs of a build, with a closing line of the usual form
meson_test ()
{
  local folder=$1 status
  shift
  meson test -C "$folder" --no-rebuild --print-errorlogs "$@" >"$folder/meson-test.out"
  status=$?
  cat "$folder/meson-test.out"
  awk '/^Ok:/ || /^Expected Fail:/ { passed += $NF }
       /^Fail:/ || /^Unexpected Pass:/ || /^Timeout:/ { failed += $NF }
       /^Skipped:/ { skipped += $NF }
       END { printf "%d passed, %d failed, %d skipped\n", passed, failed, skipped }' "$folder/meson-test.out"
  return $status
}

# sanitized_test FOLDER OPTION...: the same for a build with the address sanitizer
sanitized_test ()
(
  export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
  # Leaks in libraries that are not ours are not reported.
  export LSAN_OPTIONS=suppressions=$PWD/tests/leaks.supp:print_suppressions=0
  # Where plugins have variables of a thread, gcc 12's leak check takes stray bytes for their bounds, and crashes.
  export ASAN_OPTIONS=intercept_tls_get_addr=0
  # Libraries that GEGL's own modules need leave memory behind when they are unloaded.
  export G_DEBUG=resident-modules
  meson_test "$@" --timeout-multiplier 5
)
