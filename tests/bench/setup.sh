# What the scripts here share: packages, and a build of the programs.  Sourced from the top of the tree with the
# script's arguments; takes a -y from them.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
. tests/setup.sh

case ${1-} in
  -y) yes=1; shift ;;
esac

logs_open
packages_install build bench || exit 1
{ [ -e "$build-bench/build.ninja" ] ||
    meson setup "$build-bench" -Dbench=true -Dgegl=disabled -Doiio=disabled -Dcli=disabled; } >"$logs/bench.log" 2>&1 &&
  ninja -C "$build-bench" bench >>"$logs/bench.log" 2>&1 ||
  { tail -n 40 "$logs/bench.log"; exit 1; }
