#!/bin/sh
# Runs one fuzz target for MILLIONS of 10^6 executions, out of everybody's way; stops at the first finding. One line per
# million; the corpus is kept and grows. Seeds from recordings: build/sanitize/bin/scanloom_fuzz_corpus RECORDINGS params CORPUS
#   tests/fuzz/run_long.sh TARGET MILLIONS CORPUS     e.g. packets_pcap 10 /tmp/corpus
set -eu
target=$1 millions=$2 corpus=$3/$1
root=$(cd "$(dirname "$0")/../.." && pwd)
options=$(sed -n 's/.*fuzz options: //p' "$root/tests/fuzz/${target}_fuzz.cpp")
mkdir -p "$corpus"
for i in $(seq "$millions"); do
  log=$(mktemp)
  # shellcheck disable=SC2086 # options are several words
  nice -n 19 "$root/build/sanitize/bin/scanloom_fuzz_$target" "$corpus" $options -runs=1000000 -seed="$i" \
    -print_final_stats=1 -artifact_prefix="$3/$target-" >"$log" 2>&1 || { cat "$log"; exit 1; }
  echo "$target $i: $(sed -n 's/stat::average_exec_per_sec: *//p' "$log") executions per s"
  rm "$log"
done
