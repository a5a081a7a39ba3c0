# A screen of its own for a host that needs one, and its windows.  Sourced, not run.
#
#   screen_start FOLDER      starts Xvfb on a free display, and sets DISPLAY; FOLDER gets a file
#   screen_stop
#   window NAME [SECONDS]    waits for a window with this name, and prints its number
#   program_end PID          ends a program that runs in the background
#
# SPDX-License-Identifier: LGPL-3.0-or-later

screen_server=

screen_start ()
{
  rm -f "$1/display" # of the screen before
  Xvfb -noreset -displayfd 3 -screen 0 1500x1100x24 >/dev/null 2>&1 3>"$1/display" &
  screen_server=$!
  for _ in $(seq 60); do
    [ -s "$1/display" ] && break
    sleep 0.5
  done
  DISPLAY=:$(cat "$1/display")
  export DISPLAY
}

screen_stop ()
{
  kill "$screen_server"
  wait "$screen_server"
}

# Windows that come and go make xdotool fail now and then.
window ()
{
  for _ in $(seq "$((2 * ${2:-120}))"); do
    found=$(xdotool search --onlyvisible --name "$1" 2>/dev/null | tail -n 1)
    [ -n "$found" ] && echo "$found" && return
    sleep 0.5
  done
  return 1
}

# A program that hangs as it ends must not keep what comes after it.
program_end ()
{
  kill "$1"
  for _ in $(seq 20); do
    kill -0 "$1" 2>/dev/null || break
    sleep 0.5
  done
  kill -9 "$1" 2>/dev/null
  wait "$1" 2>/dev/null
}
