#!/bin/sh
# Topics of ROS 2 both ways, with another vendor's DDS (Fast DDS) on the other side.
# Usage: ros2.sh SCANLOOM REPOSITORY [FASTDDS_PEER]; 77 without a peer, or where two programs cannot meet by DDS.
. "$(dirname "$0")/ros2_common.sh"
export ROS_DOMAIN_ID=78  # nobody else's
count() { awk -v topic="$1" '$1 == topic { print $2 }' heard.log; }
simulate 9

# What is wrong is said, with the status for it.
ROS_DOMAIN_ID=300 "$scanloom" info --ros2 2>wrong.log && fail "a domain of 300 is taken"
grep -q "ROS_DOMAIN_ID = 300" wrong.log || fail "the domain is not named"
"$scanloom" record --ros2 drive.pcap -o a.rawlog 2>wrong.log && fail "a recording is taken for a namespace"
grep -q "is no namespace of ROS 2" wrong.log || fail "the namespace is not named"

# Out: every topic of a run.
points=sensor_msgs/msg/PointCloud2
"$peer" hear heard.mcap 16 --reliable /test/points=$points /test/map=$points /test/imu=sensor_msgs/msg/Imu \
  /test/odometry=nav_msgs/msg/Odometry /tf=tf2_msgs/msg/TFMessage /tf_static=tf2_msgs/msg/TFMessage \
  /diagnostics=diagnostic_msgs/msg/DiagnosticArray >heard.log 2>peer.log &
hearing=$!
sleep 2
"$scanloom" slam drive --ros2=/test --out-dir slam >slam.log 2>&1 || fail "slam ends with $?"
wait $hearing
[ "$(count /test/points)" ] || { echo "skipped: no message came through"; exit 77; }
[ "$(count /test/points)" -ge 60 ] || fail "$(count /test/points) scans of 89 were heard"
[ "$(count /test/odometry)" -ge 600 ] || fail "$(count /test/odometry) poses at the IMU's rate of 1780 were heard"
[ "$(count /tf)" = "$(count /test/odometry)" ] || fail "tf differs from odometry"
[ "$(count /test/imu)" -ge 1000 ] || fail "$(count /test/imu) IMU samples of 1780 were heard"
[ "$(count /test/map)" -ge 1 ] || fail "no keyframe was heard"
[ "$(count /diagnostics)" -ge 5 ] || fail "no diagnostics at 1 Hz were heard"
[ "$(count /tf_static)" = 1 ] || fail "tf_static was heard $(count /tf_static) times"
"$scanloom" record drive -o drive.rawlog >record.log 2>&1
"$scanloom" edit -q -i drive.rawlog --to-mcap drive.mcap
"$peer" compare heard.mcap /test/points drive.mcap /lidar || fail "scans differ from those of the rawlog"

# In: packets and metadata of a driver; a live run and its replay give the same scans.
cat >rig.ini <<END
[lidars]
driver = CMultiLidarSensor
process_rate = 100
pcap_output = heard_live.mcap
extrinsics = drive/extrinsics.txt
deadline_ms = 100
lidar1_name = left
lidar1_metadata = topic:/left/metadata
lidar1_topic = /left/lidar_packets
lidar2_name = right
lidar2_metadata = topic:/right/metadata
lidar2_topic = /right/lidar_packets
END
# Debian's Fast DDS may stop by an assertion of its own when a participant leaves, as the one that listens first does.
for attempt in 1 2 3; do
  rm -f heard_live.mcap
  "$peer" play drive/recording.pcap drive/left.json drive/right.json --best-effort >play.log 2>&1 &
  sleep 1
  status=0
  "$scanloom" record -c rig.ini --ros2=/test --seconds 3 -w -o live.rawlog >live.log 2>&1 || status=$?
  kill $! 2>/dev/null || true
  grep -q Assertion play.log || break
  echo "attempt $attempt: Fast DDS stopped"
done
[ $status = 0 ] || fail "record ends with $status"
"$scanloom" record -c rig.ini heard_live.mcap -o replay.rawlog >replay.log 2>&1 || fail "replay ends with $?"
zcat live.rawlog >live.bytes
zcat replay.rawlog >replay.bytes
cmp live.bytes replay.bytes || fail "live and replay differ"
awk "/^[0-9]+ scans and/ { found = \$1 } END { exit found < 15 }" live.log || fail "too few scans"
