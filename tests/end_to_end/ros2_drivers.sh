#!/bin/sh
# A rig of two lidars whose drivers of ROS 2 publish PointCloud2, on another vendor's DDS: the right one starts late, falls
# silent and is restarted, twice, while somebody else publishes nonsense on the same topics.
# Usage: ros2_drivers.sh SCANLOOM REPOSITORY [FASTDDS_PEER]; 77 without a peer, or where two programs cannot meet by DDS.
. "$(dirname "$0")/ros2_common.sh"
export ROS_DOMAIN_ID=79  # nobody else's
simulate 20
"$scanloom" record drive -o drive.rawlog >record.log 2>&1 || fail "no rawlog"
"$scanloom" edit -q -i drive.rawlog -o split.rawlog --split-lidars
"$scanloom" edit -q -i split.rawlog --to-mcap drivers.mcap
{
  "$scanloom" config --for drivers.mcap 2>config.log | sed -e '/^pcap_input/d' -e '/^$/,$d'
  echo "pcap_output = heard.mcap"
} >rig.ini

points=sensor_msgs/msg/PointCloud2
play() { "$peer" play drivers.mcap --at "$begin" --only "$@" >>drivers.log 2>&1 & }
begin=$(($(date +%s) + 3))
for topic in /lidar_left /tf_static /imu; do play $topic; done
for window in "1 --to 7" "8.5 --to 13.5" "15"; do play /lidar_right --from $window; done
"$peer" flood 30 /lidar_left=$points /lidar_right=$points /imu=sensor_msgs/msg/Imu >flood.log 2>&1 &
"$scanloom" record -c rig.ini --ros2=/test --seconds 11 -o live.rawlog >live.log 2>&1 || fail "record ends with $?"
grep -q Assertion drivers.log && { echo "skipped: Fast DDS stopped"; exit 77; }  # as in ros2.sh
emitted() { awk -v lidar="$1:" '$1 == lidar { print $5 }' live.log; }
[ "$(emitted lidar1)" -ge $((50 * 512)) ] || fail "the left lidar has $(emitted lidar1) columns"
[ "$(emitted lidar2)" -ge $((15 * 512)) ] || fail "the right lidar has $(emitted lidar2) columns"
grep -q "'lidar2': silent" live.log || fail "its silence is not said"
grep -q "'lidar2': back" live.log || fail "its return is not said"
grep -q "messages_malformed: [1-9]" live.log || fail "the nonsense is not counted"
[ "$(wc -c <live.log)" -lt 5000 ] || fail "the nonsense floods the terminal"
"$scanloom" record -c rig.ini heard.mcap --set lidars.pcap_output= -o replay.rawlog >replay.log 2>&1 || fail "no replay"
zcat live.rawlog >live.bytes
zcat replay.rawlog >replay.bytes
grep -q scans_dropped live.log || cmp live.bytes replay.bytes || fail "live and replay differ"
