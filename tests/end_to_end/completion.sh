#!/bin/bash
# bash completes verbs, options and keys.   completion.sh SCANLOOM SOURCE_DIR
set -eu
PATH=$(dirname "$1"):$PATH
compopt() { :; }  # works only while readline completes
source "$2/apps/scanloom/completions/scanloom.bash"

expect() {  # CHOICE WORD...: completing the last word offers this choice
  COMP_WORDS=("${@:2}")
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _scanloom
  [[ " ${COMPREPLY[*]} " == *" $1 "* ]] || { echo "${*:2} -> ${COMPREPLY[*]}, without $1"; exit 1; }
}

expect slam scanloom ''
expect simulate scanloom s
expect record scanloom help rec
expect edit scanloom config --default ''
expect --out-dir scanloom slam --o
expect --config scanloom slam -
expect map_cells.cell_size= scanloom slam --set map_c
expect lidars.pcap_input= scanloom record --set lidars.pc
expect imu_noise.gyro_noise_deg= scanloom slam -c rig.ini --set imu_noise.
