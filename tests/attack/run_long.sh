#!/bin/sh
# Attacks for hours, out of everybody's way: one seed after the other, each for ten minutes. A line for each seed; what
# is found lies in FOLDER/seed-N and is said with the command that repeats it.
#   tests/attack/run_long.sh HOURS FOLDER [FIRST_SEED]     e.g. 8 /tmp/attack
set -eu
hours=$1 folder=$2 seed=${3:-1}
build=$(cd "$(dirname "$0")/../.." && pwd)/build/release
end=$(($(date +%s) + 3600 * hours))
found=0
while [ "$(date +%s)" -lt "$end" ]; do
  mkdir -p "$folder/seed-$seed"
  echo "seed $seed"
  nice -n 19 "$build/bin/scanloom_attack" "$build/lib/libscanloom_program.so" --seed "$seed" --seconds 600 \
    --folder "$folder/seed-$seed" || found=1
  rmdir "$folder/seed-$seed" 2>/dev/null || true
  seed=$((seed + 1))
done
exit $found
