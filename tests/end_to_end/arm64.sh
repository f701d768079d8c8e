#!/bin/sh
# Builds decoding, batching, IMU and registration for arm64 and runs their tests, and the example of the manual, in an
# emulator: the same points, columns and poses to the bit as on this machine. By hand, as root, with debootstrap:
#   tests/end_to_end/arm64.sh
# $BARE_DEBIAN/arm64 (default: /var/tmp/bare_debian) keeps the system with compiler and packages for the next time.
set -eu
