#!/bin/sh
# A lib may include only itself and the libs above it; MRPT stays in the libs that may know it.
set -eu
cd "$1/libs"
order=$(sed -n 's/^scanloom_lib(\([a-z_]*\).*/\1/p' CMakeLists.txt)
failed=0
above=""
for lib in $order; do
  above="$above $lib"
  for include in $(sed -n 's/^ *# *include "\([a-z_]*\)\/.*/\1/p' "$lib"/*.h "$lib"/*.cpp 2>/dev/null | sort -u); do
    case " $above " in *" $include "*) ;; *) echo "$lib includes $include, which is not above it"; failed=1 ;; esac
  done
done
for lib in core cloud lidar batching source imu preprocessing ndt graph slam simulation; do
  grep -n '# *include <mrpt' "$lib"/* 2>/dev/null && { echo "$lib must not know MRPT"; failed=1; }
done
for lib in ndt imu; do
  grep -nE '# *include "(config|lidar|batching|source)/' "$lib"/* 2>/dev/null && { echo "$lib needs only core"; failed=1; }
done
grep -n '# *include "slam/' simulation/* 2>/dev/null && { echo "simulation must not know slam"; failed=1; }
for folder in */; do
  case " $(echo $order) " in *" ${folder%/} "*) ;; *) echo "libs/$folder is no lib"; failed=1 ;; esac
done
# Two types of one name, each in a header of its own, are one to the linker: it keeps the functions of either.
twice=$(sed -nE 's/^(struct|class|enum class) ([A-Za-z0-9]+)( final)?( *:.*)?$/\2/p' */*.h | sort | uniq -d)
[ -z "$twice" ] || { echo "defined in two headers: $twice"; failed=1; }
exit $failed
