# The language of a German, for a host.  Sourced, not run; needs Debian's package locales.
#
#   german FOLDER COMMAND...     FOLDER gets the locale
#
# SPDX-License-Identifier: LGPL-3.0-or-later

german ()
(
  export LOCPATH="$1/locales" LC_ALL=de_DE.UTF-8 LANGUAGE=de
  shift
  mkdir -p "$LOCPATH"
  [ -e "$LOCPATH/$LC_ALL" ] || localedef -i de_DE -f UTF-8 "$LOCPATH/$LC_ALL" || exit 1
  "$@"
)
