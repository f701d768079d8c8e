#!/bin/sh
# A room of libs/ includes and links only rooms above it in libs/CMakeLists.txt, and of these nothing in internal/. What it
# reaches through others stays within the rules below. Usage: rooms_obey_their_order.sh REPOSITORY
set -eu
cd "$1/libs"
modules="base input estimation calibration mrpt diagnosis run lab"  # each may know only those before it

# "include ROOM OTHER" for every room that a file of ROOM includes, "link ROOM OTHER" for every room that CMake links to it.
edges()
{
  sed -n 's/^scanloom_room(\([^ )]*\).*/\1/p' CMakeLists.txt | while read -r folder; do
    find "$folder" -name '*.h' -o -name '*.cpp' | xargs sed -nE 's#^ *\# *include "([a-z_/]*/)[^/"]*".*#\1#p' | sort -u |
      sed 's#internal/$##; s#/$##; s#.*/##; s#^#include '"${folder##*/}"' #'
  done
  sed -nE 's/^scanloom_room\(([^)]*)\)/\1/p' CMakeLists.txt |
    awk '{ room = $1; sub(/.*\//, "", room); print "order", room
           for (i = 2; i <= NF; ++i) if (sub(/^scanloom_/, "", $i)) print "link", room, $i }'
}

failed=0
edges | awk '
  function fault(text) { print text; failed = 1 }
  function reaches(from, to) { return (from, to) in reached }
  function only(room, allowed,    other) {
    for (other in place) if (reaches(room, other) && index(" " allowed " ", " " other " ") == 0) fault(room " reaches " other)
  }
  function never(room, other) { if (reaches(room, other)) fault(room " reaches " other) }

  $1 == "order" { place[$2] = ++rooms; name[rooms] = $2 }
  ($1 == "include" || $1 == "link") && $2 != $3 { edge[$1, $2, $3] = 1; reached[$2, $3] = 1 }
  $1 == "link" { linked[$2, $3] = 1 }

  END {
    if (rooms < 20) fault("only " rooms " rooms were found")
    for (k = 1; k <= rooms; ++k) for (i = 1; i <= rooms; ++i) for (j = 1; j <= rooms; ++j) {
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
    never("observations", "slam")
    never("edit", "slam")
    never("diagnosis", "slam")
    never("evaluation", "rig")
    exit failed
  }' || failed=1

fail() { echo "$1"; failed=1; }

# Modules: their order, and that no folder is forgotten.
known=""
for module in $modules; do
  known="$known $module"
  [ -d "$module" ] || fail "libs/$module is missing"
  for other in $(grep -rhoE '^ *# *include "[a-z_]+/' "$module" | sed 's/.*"//; s#/##' | sort -u); do
    case " $known " in *" $other "*) ;; *) fail "libs/$module includes libs/$other" ;; esac
  done
done
for folder in */; do
  case " $modules " in *" ${folder%/} "*) ;; *) fail "libs/$folder is no module" ;; esac
done
for folder in $(find . -name '*.cpp' ! -name precompiled.cpp -printf '%h\n' | sed 's#/internal$##; s#^\./##' | sort -u); do
  grep -q "^scanloom_room($folder " CMakeLists.txt || fail "libs/$folder is no room"
done

# internal/ is the room's own.
theirs=$(grep -rnE '^ *# *include "[a-z_/]*/internal/' . ../apps | sed 's#^\./##' |
         awk -F'"' '{ room = $2; sub(/internal\/.*/, "", room); if (index($1, room) != 1) print }')
[ -z "$theirs" ] || fail "internal to another room:
$theirs"

for room in base/core input/lidar input/batching input/whole_turns input/packets input/bags input/rig estimation lab/simulation; do
  ! grep -rn '# *include <mrpt' "$room" || fail "$room must not know MRPT"
done
# Two types of one name, each in a header of its own, are one to the linker: it keeps the functions of either.
twice=$(find . -name '*.h' | xargs sed -nE 's/^(struct|class|enum class) ([A-Za-z0-9]+)( final)?( *:.*)?$/\2/p' | sort | uniq -d)
[ -z "$twice" ] || fail "defined in two headers: $twice"
exit $failed
