#!/bin/sh
# A lib includes and links only libs above it in libs/CMakeLists.txt, and what it reaches through other libs stays within
# the rules below. Usage: libs_obey_their_order.sh REPOSITORY
set -eu
cd "$1/libs"

# "include LIB OTHER" for every lib that a file of LIB includes, "link LIB OTHER" for every lib that CMake links to it.
edges()
{
  for folder in */; do
    lib=${folder%/}
    cat "$lib"/*.h "$lib"/*.cpp | sed -n "s/^ *# *include \"\([a-z_]*\)\/.*/include $lib \1/p" | sort -u
  done
  sed -n 's/^scanloom_lib(\(.*\))/\1/p' CMakeLists.txt |
    awk '{ print "order", $1; for (i = 2; i <= NF; ++i) if (sub(/^scanloom_/, "", $i)) print "link", $1, $i }'
}

failed=0
{ edges; for folder in */; do echo "folder ${folder%/}"; done; } | awk '
  function fault(text) { print text; failed = 1 }
  function reaches(from, to) { return (from, to) in reached }
  function only(lib, allowed,    other) {
    for (other in place) if (reaches(lib, other) && index(" " allowed " ", " " other " ") == 0) fault(lib " reaches " other)
  }
  function never(lib, other) { if (reaches(lib, other)) fault(lib " reaches " other) }

  $1 == "order" { place[$2] = ++libs; name[libs] = $2 }
  $1 == "folder" { folder[$2] = 1 }
  ($1 == "include" || $1 == "link") && $2 != $3 { edge[$1, $2, $3] = 1; reached[$2, $3] = 1 }
  $1 == "link" { linked[$2, $3] = 1 }

  END {
    for (lib in folder) if (!(lib in place)) fault("libs/" lib " is no lib")
    for (k = 1; k <= libs; ++k) for (i = 1; i <= libs; ++i) for (j = 1; j <= libs; ++j) {
      if (reaches(name[i], name[k]) && reaches(name[k], name[j])) reached[name[i], name[j]] = 1
      if ((name[i], name[k]) in linked && (name[k], name[j]) in linked) linked[name[i], name[j]] = 1
    }
    for (e in edge) {
      split(e, part, SUBSEP)
      if (!(part[3] in place) || place[part[3]] >= place[part[2]]) fault(part[2] " " part[1] "s " part[3] ", which is not above it")
      if (part[1] == "include" && !((part[2], part[3]) in linked)) fault(part[2] " includes " part[3] " without linking it")
    }
    only("imu", "core")
    only("ndt", "core")
    only("config", "core")
    only("lidar", "core")
    only("simulation", "core config formats lidar batching whole_turns packets rawlogs bags rig imu")
    never("mrpt_bridge", "slam")
    never("edit", "slam")
    never("doctor", "slam")
    never("evaluation", "rig")
    exit failed
  }' || failed=1

for lib in core lidar batching whole_turns packets bags rig imu preprocessing ndt graph slam simulation; do
  grep -n '# *include <mrpt' "$lib"/* && { echo "$lib must not know MRPT"; failed=1; }
done
# Two types of one name, each in a header of its own, are one to the linker: it keeps the functions of either.
twice=$(sed -nE 's/^(struct|class|enum class) ([A-Za-z0-9]+)( final)?( *:.*)?$/\2/p' */*.h | sort | uniq -d)
[ -z "$twice" ] || { echo "defined in two headers: $twice"; failed=1; }
exit $failed
