# A screen of its own for a host that needs one.  Sourced, not run.
#
#   screen_start FOLDER    starts Xvfb on a free display, and sets DISPLAY; FOLDER gets a file
#   screen_stop
#
# SPDX-License-Identifier: LGPL-3.0-or-later

screen_server=

screen_start ()
{
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
