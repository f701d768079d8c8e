#!/bin/sh
# A library of libs/ includes and links only libraries above it in libs/CMakeLists.txt, and of these nothing in internal/. What it
# reaches through others stays within the rules below. Usage: libraries_obey_their_order.sh REPOSITORY
set -eu
cd "$1/libs"
modules="base input estimation calibration mrpt site diagnosis run lab"  # each may know only those before it

# "include LIBRARY OTHER" for every library that a file of LIBRARY includes, "link LIBRARY OTHER" for every library that CMake links to it.
edges()
{
  sed -n 's/^scanloom_library(\([^ )]*\).*/\1/p' CMakeLists.txt | while read -r folder; do
    find "$folder" -name '*.h' -o -name '*.cpp' | xargs sed -nE 's#^ *\# *include "([a-z0-9_/]*/)[^/"]*".*#\1#p' | sort -u |
      sed 's#internal/$##; s#/$##; s#.*/##; s#^#include '"${folder##*/}"' #'
  done
  sed -nE 's/^scanloom_library\(([^)]*)\)/\1/p' CMakeLists.txt |
    awk '{ library = $1; sub(/.*\//, "", library); print "order", library
           for (i = 2; i <= NF; ++i) if (sub(/^scanloom_/, "", $i)) print "link", library, $i }'
}

failed=0
edges | awk '
  function fault(text) { print text; failed = 1 }
  function reaches(from, to) { return (from, to) in reached }
  function only(library, allowed,    other) {
    for (other in place) if (reaches(library, other) && index(" " allowed " ", " " other " ") == 0) fault(library " reaches " other)
  }
  function never(library, other) { if (reaches(library, other)) fault(library " reaches " other) }

  $1 == "order" { place[$2] = ++libraries; name[libraries] = $2 }
  ($1 == "include" || $1 == "link") && $2 != $3 { edge[$1, $2, $3] = 1; reached[$2, $3] = 1 }
  $1 == "link" { linked[$2, $3] = 1 }

  END {
    if (libraries < 20) fault("only " libraries " libraries were found")
    for (k = 1; k <= libraries; ++k) for (i = 1; i <= libraries; ++i) for (j = 1; j <= libraries; ++j) {
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
    only("simulation", "core config formats positions lidar batching packets rawlogs bags ros2 rig imu")
    never("observations", "slam")
    never("edit", "slam")
    never("diagnosis", "slam")
    never("whole_turns", "slam")
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
  grep -q "^scanloom_library($folder " CMakeLists.txt || fail "libs/$folder is no library"
done

# internal/ is the library's own.
theirs=$(grep -rnE '^ *# *include "[a-z0-9_/]*/internal/' . ../apps | sed 's#^\./##' |
         awk -F'"' '{ library = $2; sub(/internal\/.*/, "", library); if (index($1, library) != 1) print }')
[ -z "$theirs" ] || fail "internal to another library:
$theirs"

# What no other library and no program includes, by itself or by another header of the library, is internal, too.
unused=$({ find . -name '*.h' ! -path '*/internal/*' | sed 's#^\./#header #'
           grep -roE '^ *# *include "[a-z0-9_/]*/[A-Za-z0-9]+\.h"' . ../apps ; } | sed 's#^\./##' | awk '
  function room(path) { sub(/\/[^\/]*$/, "", path); sub(/\/internal$/, "", path); return path }
  $1 == "header" { open[$2] = 1; next }
  { user = $0; sub(/:.*/, "", user); split($0, part, "\""); header = part[2]
    if (room(user) != room(header) || (user ~ /\.h$/ && user !~ /\/internal\//)) used[header] = 1 }
  END { for (header in open) if (!(header in used)) print header }')
[ -z "$unused" ] || fail "used by its own library alone, and not in internal/:
$unused"

for library in base/core input/lidar input/batching input/packets input/bags input/ros2 input/rig estimation lab/simulation; do
  ! grep -rn '# *include <mrpt' "$library" || fail "$library must not know MRPT"
done
# Two types of one name, each in a header of its own, are one to the linker: it keeps the functions of either.
twice=$(find . ../apps -name '*.h' | xargs sed -nE 's/^(struct|class|enum class) ([A-Za-z0-9]+)( final)?( *:.*)?$/\2/p' | sort | uniq -d)
[ -z "$twice" ] || fail "defined in two headers: $twice"
exit $failed
