#!/bin/sh
# Cross-compiles decoding, batching, IMU and registration for arm64 and runs their tests in an emulator. Then merges and
# registers a simulated recording there and by this machine's build: points, poses and preintegration must be the same bits.
# By hand, as root, with debootstrap, after `cmake --build --preset release --target scanloom scanloom_bits`:
#   tests/end_to_end/arm64.sh
# $SCANLOOM_DATA, if set, names the recordings for the tests that read them.
# $BARE_DEBIAN/arm64 (default: /var/tmp/bare_debian) keeps the system with all packages for the next time.
set -eu
project=$(cd "$(dirname "$0")/../.." && pwd)
folder=${BARE_DEBIAN:-/var/tmp/bare_debian}/arm64
system=$folder/system
work=$system/srv/scanloom
inside() { unshare --mount --pid --fork --root="$system" --mount-proc env -i PATH="$PATH" HOME=/root sh -c "$1"; }
linesOf() { awk -v group="$1" '/^# group:/ { here = $3 == group; next } here && /-dev/ && !/none$/ { print $1 }' "$project/apt-packages.txt"; }

if [ ! -f "$folder/ready" ]; then
  mkdir -p "$folder"
  mirror=${DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | head -n 1)}
  debootstrap --variant=minbase bookworm "$system" $mirror
  echo 'Acquire::Check-Valid-Until "false";' > "$system/etc/apt/apt.conf.d/80mirror"
  inside "
    set -e
    export DEBIAN_FRONTEND=noninteractive
    dpkg --add-architecture arm64
    apt-get -q update
    apt-get -q -y install --no-install-recommends crossbuild-essential-arm64 qemu-user-static cmake ninja-build pkg-config zstd
    for package in $(echo $(linesOf run) $(linesOf check)); do
      apt-cache show \$package 2>/dev/null | grep -q '^Architecture: all' && echo \$package || echo \$package:arm64
    done | grep -v libclang > /srv/packages
    apt-get -q -y install --no-install-recommends \$(cat /srv/packages)
    # apt takes libmrpt-common-dev of this machine for arm64's, but its config.h tells the processor.
    apt-get -q -o APT::Sandbox::User=root download libmrpt-common-dev:arm64
    dpkg -x libmrpt-common-dev_*_arm64.deb /"
  touch "$folder/ready"
fi

rm -rf "$work" "$system/srv/data"
mkdir -p "$work"
[ -z "${SCANLOOM_DATA:-}" ] || cp -r "$SCANLOOM_DATA" "$system/srv/data"
git -C "$project" archive HEAD | tar -C "$work" -x
inside "
  set -e
  cd /srv/scanloom
  cmake --preset release -DCMAKE_TOOLCHAIN_FILE=tests/end_to_end/arm64.toolchain.cmake > /dev/null
  cmake --build --preset release --target scanloom_bits \
    scanloom_test_core scanloom_test_lidar scanloom_test_batching scanloom_test_imu scanloom_test_ndt
  [ ! -d /srv/data ] || export SCANLOOM_DATA=/srv/data
  ctest --preset release -R '^(core|lidar|batching|imu|ndt)\.' -j $(nproc)"

"$project/build/release/bin/scanloom" simulate -c "$project/params/simulation/demo.ini" --set simulated_drive.standstill=1 \
  --set simulated_drive.speed_up=1 --set simulated_drive.duration=4 --out-dir "$work/recording" > /dev/null
cd "$work/recording"
files="recording.pcap left.json right.json extrinsics.txt"
"$project/build/release/bin/scanloom_bits" $files > here.txt
inside "cd /srv/scanloom/recording && qemu-aarch64-static ../build/release/bin/scanloom_bits $files > arm64.txt"
cmp here.txt arm64.txt
echo "$(wc -l < here.txt) lines of digests and poses are the same bits on arm64"
