# Debian systems in a folder, for tests on a machine that is not the developer's own.  Sourced, not run; needs root.
#
#   chroot_make SUITE NAME PACKAGE...  a system of its own under $chroot_home/NAME; one that is there is used again
#   chroot_copy NAME COPY              a second one, to be spoilt
#   chroot_tree NAME                   the working tree into its /celdepth, without what git ignores; all files are new to
#                                      a build that was kept
#   chroot_commit NAME                 the last commit into its /celdepth
#   chroot_run NAME COMMAND...         runs a command in it
#
# Every command gets a mount, process and IPC space of its own: nothing stays mounted or running, however it ends.  The
# mirror and the proxy are those of this machine's own apt.  $CELDEPTH_CHROOT says where the systems are kept.
#
# SPDX-License-Identifier: LGPL-3.0-or-later

chroot_home=${CELDEPTH_CHROOT:-/var/tmp/celdepth-chroot}

chroot_mirror ()
{
  local codename
  codename=$(. /etc/os-release && echo "$VERSION_CODENAME")
  apt-get indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' |
    sed -n "s/^$codename main //p" | head -n 1
}

chroot_make ()
{
  local suite=$1 name=$2 root=$chroot_home/$2
  shift 2
  if [ ! -e "$root/.base" ]; then
    rm -rf "$root"
    mkdir -p "$chroot_home"
    debootstrap --variant=minbase "$suite" "$root" "$(chroot_mirror)" >"$chroot_home/$name.log" 2>&1 ||
      { tail "$chroot_home/$name.log"; rm -rf "$root"; return 1; }
    apt-config dump Acquire::http::Proxy Acquire::https::Proxy Acquire::Check-Valid-Until Acquire::Check-Date \
      >"$root/etc/apt/apt.conf.d/90celdepth"
    touch "$root/.base"
  fi
  [ $# -eq 0 ] || [ "$(cat "$root/.packages" 2>/dev/null)" = "$*" ] && return 0
  chroot_run "$name" sh -c 'apt-get -q update &&
    DEBIAN_FRONTEND=noninteractive apt-get -qy install --no-install-recommends "$@"' \
    sh "$@" >>"$chroot_home/$name.log" 2>&1 || { tail "$chroot_home/$name.log"; return 1; }
  echo "$*" >"$root/.packages"
}

chroot_copy ()
{
  rm -rf "${chroot_home:?}/$2"
  cp -a "$chroot_home/$1" "$chroot_home/$2"
}

chroot_tree ()
{
  local root=$chroot_home/$1
  rm -rf "$root/celdepth"
  mkdir "$root/celdepth"
  git -c safe.directory='*' ls-files -z --cached --others --exclude-standard | xargs -0 -r ls -d 2>/dev/null |
    tar -cf - -T - | tar -xmf - -C "$root/celdepth"
}

chroot_commit ()
{
  local root=$chroot_home/$1
  rm -rf "$root/celdepth"
  mkdir "$root/celdepth"
  git -c safe.directory='*' archive HEAD | tar -xf - -C "$root/celdepth"
}

chroot_run ()
{
  local root=$chroot_home/$1
  shift
  unshare --mount --pid --ipc --fork --kill-child --mount-proc="$root/proc" sh -c '
    root=$1
    shift
    mount --rbind /dev "$root/dev" && mount -t tmpfs -o mode=1777 tmpfs "$root/tmp" &&
      exec chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 CI="${CI-}" "$@"
  ' sh "$root" "$@"
}
