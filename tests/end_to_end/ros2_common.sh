# Read by ros2*.sh, with their arguments: SCANLOOM REPOSITORY [FASTDDS_PEER]. Works in a folder of its own, which is
# removed at the end, as what runs in the background is ended. Skips (77) without another vendor's DDS.
set -eu
scanloom=$1 repository=$2 peer=${3:-}
[ -n "$peer" ] || { echo "skipped: Cyclone DDS or Fast DDS is missing"; exit 77; }
folder=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "FAILED: $*"; for log in ./*.log; do echo "== $log"; tail -n 20 "$log" | cut -c1-300; done; exit 1; }

simulate() {  # SECONDS: drive/, of two lidars with 16 beams
  "$scanloom" simulate -c "$repository/params/simulation/sparse.ini" --set simulated_drive.duration="$1" \
    --set simulated_drive.standstill=2 --set simulated_drive.route=winding --set simulated_lidars.lidar1_model=OS0-16 \
    --set simulated_lidars.lidar2_model=OS0-16 --out-dir drive >simulate.log 2>&1 || fail "no drive"
}
