# Completion of the celdepth command for bash.
# SPDX-License-Identifier: LGPL-3.0-or-later

_celdepth_options ()
{
  # a long list of values goes on in the next line, after a |
  "$1" "$2" --help 2> /dev/null | sed -e ':a' -e '/|$/{' -e 'N' -e 's/|\n */|/' -e 'ba' -e '}' |
    sed -n 's/^  \(-., \)*\(--[a-z-]*\(=[^ ]*\)*\).*/\2/p'
}

_celdepth ()
{
  local word="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD-1]}" options values
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=( $(compgen -W "popup segment order expand smooth shade enhance stereo wiggle relief exact layers register compose propagate deform inbetween help --help --version" -- "$word") )
    return
  fi
  options=$(_celdepth_options "$1" "${COMP_WORDS[1]}")
  case "$before" in
  --*)
    values=$(printf '%s\n' "$options" | sed -n "s/^$before=//p" | head -n 1)
    case "$values" in
    *"|"*) COMPREPLY=( $(compgen -W "${values//|/ }" -- "$word") ); return ;;
    esac
    ;;
  esac
  case "$word" in
  -*) COMPREPLY=( $(compgen -W "$(printf '%s\n' "$options" | sed 's/=.*//')" -- "$word") ) ;;
  *) compopt -o filenames 2> /dev/null; COMPREPLY=( $(compgen -f -- "$word") ) ;;
  esac
}

complete -F _celdepth celdepth
