#!/bin/sh
# Runs a command of this commit on a Debian 12 that has its essential packages and nothing else: no git, no sudo for root,
# no display, no /sys. By hand, as root, with debootstrap:
#   tests/end_to_end/bare_debian.sh FOLDER root|user COMMAND
#   tests/end_to_end/bare_debian.sh /var/tmp/bare user './demo && ./demo'      cold, then warm
# FOLDER/base.tar is made once; FOLDER/system is made anew from it each time and left for a look.
set -eu
[ $# = 3 ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
folder=$1 who=$2 command=$3
project=$(cd "$(dirname "$0")/../.." && pwd)
system=$folder/system

mkdir -p "$folder"
if [ ! -f "$folder/base.tar" ]; then
  debootstrap --variant=minbase bookworm "$folder/base"
  tar -C "$folder/base" -cf "$folder/base.tar" .
  rm -rf "$folder/base"
fi
rm -rf "$system"
mkdir "$system"
tar -C "$system" -xf "$folder/base.tar"

inside() { unshare --mount --pid --fork --root="$system" --mount-proc env -i PATH="$PATH" HOME=/root sh -c "$1"; }
case $who in
  root) home=/root run="" ;;
  user)
    home=/home/forester run="su - forester -c"
    inside "apt-get -q update && apt-get -q -y install --no-install-recommends sudo && useradd -m forester &&
            echo 'forester ALL=(ALL) NOPASSWD: ALL' > /etc/sudoers.d/forester" ;;
  *) echo "root or user, not '$who'" >&2; exit 2 ;;
esac

mkdir "$system$home/scanloom"
git -C "$project" archive HEAD | tar -C "$system$home/scanloom" -x
[ "$who" = root ] || inside "chown -R forester: $home/scanloom"

begin=$(date +%s)
status=0
inside "${run:-sh -c} 'cd $home/scanloom && $command'" || status=$?
echo "bare Debian 12 as $who: $command: status $status after $(($(date +%s) - begin)) s"
exit $status
