#!/bin/sh
# Makes the Debian packages of this commit on a bare Debian, has lintian look at them, installs them on another bare one, and
# uses them there: a simulated drive is localised, by Python to the same bits, and recorded, and MRPT's rawlog-edit reads the
# rawlog by the plugin's name alone. By hand, as root, with debootstrap:
#   tests/end_to_end/packages.sh SUITE       the packages stay in $BARE_DEBIAN/SUITE/packages
set -eu
suite=$1 here=$(dirname "$0")
folder=${BARE_DEBIAN:-/var/tmp/bare_debian}/$suite

"$here/bare_debian.sh" "$suite" root '
  .ci/install run package &&
  export DEBFULLNAME=Forester DEBEMAIL=forester@debian.org &&
  cmake --preset release -DSCANLOOM_TESTS=OFF -DSCANLOOM_PYTHON=ON -DCMAKE_INSTALL_PREFIX=/usr && cmake --build --preset release &&
  cd build/release && cpack -G DEB && mkdir /srv/packages &&
  for package in *.deb; do dpkg -c "$package"; lintian --allow-root --fail-on error "$package" && mv "$package" /srv/packages || exit 1; done'
rm -rf "$folder/packages" "$folder/clean"
mkdir "$folder/packages" "$folder/clean"
mv "$folder"/system/srv/packages/*.deb "$folder/packages"

tar -C "$folder/clean" -xf "$folder/base.tar"
cp "$folder"/packages/*.deb "$folder/clean/srv"
unshare --mount --pid --fork --root="$folder/clean" --mount-proc env -i PATH="$PATH" HOME=/root DEBIAN_FRONTEND=noninteractive sh -c '
  set -e
  cd /srv
  apt-get -q update
  apt-get -q -y install --no-install-recommends ./scanloom_*.deb ./scanloom-mrpt-plugin_*.deb ./python3-scanloom_*.deb mrpt-apps
  scanloom --version
  params=/usr/share/scanloom/params
  scanloom simulate -c $params/simulation/demo.ini --out-dir drive
  scanloom slam drive -c $params/harvester.ini --out-dir slam
  python3 -c "import scanloom; scanloom.write_trajectory(\"slam.tum\", scanloom.slam(\"drive\", configuration=\"$params/harvester.ini\"))"
  cmp slam.tum slam/trajectory.tum
  scanloom record drive -o drive.rawlog
  rawlog-edit -p libscanloom_mrpt.so --info -i drive.rawlog'
