#!/bin/sh
# Runs commands of this commit on a Debian that has its essential packages and nothing else: no git, no sudo for root, no
# display, no /sys. By hand, as root, with debootstrap:
#   tests/end_to_end/bare_debian.sh SUITE [root|user [COMMAND...]]
#   tests/end_to_end/bare_debian.sh trixie                             ./demo and ./check as root, then as a user with sudo
#   tests/end_to_end/bare_debian.sh bookworm user ./demo ./demo        as a user: cold, then warm
# DEBIAN_MIRROR, if set, names the mirror, else this machine's apt does. $BARE_DEBIAN/SUITE (default: /var/tmp/bare_debian)
# keeps base.tar, made once, and system, made anew from it for root and for the user and left for a look.
set -eu
[ $# -ge 1 ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" | head -n -1 >&2; exit 2; }
suite=$1 who=${2:-}
if [ -z "$who" ]; then
  status=0
  "$0" "$suite" root || status=$?
  "$0" "$suite" user || status=$?
  exit $status
fi
shift 2
[ $# -gt 0 ] || set -- ./demo ./check

project=$(cd "$(dirname "$0")/../.." && pwd)
folder=${BARE_DEBIAN:-/var/tmp/bare_debian}/$suite
system=$folder/system
mkdir -p "$folder"
if [ ! -f "$folder/base.tar" ]; then
  mirror=${DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | head -n 1)}
  # A release newer than this debootstrap is set up like sid.
  script=/usr/share/debootstrap/scripts/$suite
  [ -e "$script" ] || script=/usr/share/debootstrap/scripts/sid
  debootstrap --variant=minbase "$suite" "$folder/base" "$mirror" "$script"
  # A mirror may be older than its lists allow.
  echo 'Acquire::Check-Valid-Until "false";' > "$folder/base/etc/apt/apt.conf.d/80mirror"
  tar -C "$folder/base" -cf "$folder/base.tar" .
  rm -rf "$folder/base"
fi
rm -rf "$system"
mkdir "$system"
tar -C "$system" -xf "$folder/base.tar"

inside() { unshare --mount --pid --fork --root="$system" --mount-proc env -i PATH="$PATH" HOME=/root sh -c "$1"; }
case $who in
  root) home=/root run="sh -c" ;;
  user)
    home=/home/forester run="su - forester -c"
    inside "apt-get -q update && apt-get -q -y install --no-install-recommends sudo && useradd -m forester &&
            echo 'forester ALL=(ALL) NOPASSWD: ALL' > /etc/sudoers.d/forester" ;;
  *) echo "root or user, not '$who'" >&2; exit 2 ;;
esac

mkdir "$system$home/scanloom"
git -C "$project" archive HEAD | tar -C "$system$home/scanloom" -x
[ "$who" = root ] || inside "chown -R forester: $home/scanloom"

worst=0
account=""
for command in "$@"; do
  begin=$(date +%s)
  status=0
  inside "$run 'cd $home/scanloom && $command'" || { status=$?; worst=$status; }
  account="$account$suite as $who: $command: status $status after $(($(date +%s) - begin)) s
"
done
printf '%s' "$account"
exit $worst
