#!/bin/sh
# Installs a build into a folder and uses it as others do: the program from there simulates a recording, and the example of
# the manual, built against the installed libs, merges and registers it. The machine stands still for a second: these
# ten scans must not move, and later ones must. Each but the first and last has the columns of a tenth of a second.
#   installed.sh BUILD_DIR SOURCE_DIR
set -eu
build=$1 source=$2
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT

cmake --install "$build" --prefix "$dir/usr" > /dev/null
"$dir/usr/bin/scanloom" simulate -c "$dir/usr/share/scanloom/params/simulation/demo.ini" \
  --set simulated_drive.standstill=1 --set simulated_drive.speed_up=1 --set simulated_drive.duration=4 \
  --out-dir "$dir/recording" > /dev/null

cmake -G Ninja -S "$source/doc/example" -B "$dir/example" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$dir/usr" > "$dir/log" &&
  cmake --build "$dir/example" >> "$dir/log" || { cat "$dir/log"; exit 1; }
cd "$dir/recording"
"$dir/example/merge_and_register" recording.pcap left.json right.json extrinsics.txt > scans.txt
cat scans.txt
awk 'NR > 1 && NF == 11 && $1 == 1024 { woven++ }
     NF == 11 { travel = sqrt($7 * $7 + $8 * $8 + $9 * $9); if (NR < 10 && travel > 0.01) early++; if (NR > 10 && travel > 0.03) late++ }
     END { exit !(woven > 30 && !early && late > 5) }' scans.txt
