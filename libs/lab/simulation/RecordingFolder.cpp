#include "lab/simulation/RecordingFolder.h"

#include "base/core/OutputFile.h"
#include "base/formats/ImuCsv.h"
#include "base/formats/SecondsText.h"
#include "base/formats/Trajectory.h"
#include "input/packets/CaptureWriter.h"
#include "input/rig/Extrinsics.h"
#include "lab/simulation/internal/ScenePackets.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kDegrees = 180 / M_PI;
constexpr Duration kTruthPeriod = 10ms, kObjectPeriod = 100ms;

std::vector<PacketCounts> writeCapture(const Scene& scene, const std::filesystem::path& path,
                                       const std::function<void(double)>& progress)
{
  constexpr Duration kBetweenReports = 100ms;  // of the recording
  OutputFile file(path);
  CaptureWriter capture(file.temporary());
  ScenePackets packets(scene);
  Timestamp reported = scene.span.start;
  for (Datagram datagram; packets.next(datagram);)
  {
    capture.write(datagram);
    if (packets.time() - reported < kBetweenReports) continue;
    reported = packets.time();
    progress(packets.share());
  }
  capture.close();
  file.commit();
  progress(1);
  std::vector<PacketCounts> counts;
  for (std::size_t i = 0; i < scene.lidars.size(); ++i) counts.push_back(packets.counts(i));
  return counts;
}

/** Returns the biases that were drawn. */
TurnOnBias writeImu(const Scene& scene, const std::filesystem::path& path)
{
  constexpr Duration kSlice = 10s;
  ImuCsvWriter writer(path);
  ImuStream imu(scene.scenery.drive(), scene.span, scene.body_imu, scene.seed);
  for (Timestamp until = scene.span.start; until < scene.span.end();)
  {
    until = std::min(until + kSlice, scene.span.end());
    for (const ImuStream::Sample& sample : imu.before(until)) writer.add(sample.reading);
  }
  writer.close();
  return imu.turnOnBias();
}

void writeGroundTruth(const Scene& scene, const std::filesystem::path& path)
{
  TumWriter writer(path);
  for (Duration t{0}; seconds(t) <= scene.span.duration; t += kTruthPeriod)
    writer.add({scene.span.start + t, scene.scenery.drive().at(seconds(t)).world_T_body});
  writer.close();
}

void writeTotalStation(const Scene& scene, const std::filesystem::path& path)
{
  OutputFile file(path);
  file.stream() << "#t [s],x [m],y [m],z [m]\n";
  for (std::uint64_t i = 0; scene.station.secondsOf(i) <= scene.span.duration; ++i)
    if (const auto prism = scene.station.measure(scene.scenery, i))
      fmt::print(file.stream(), "{},{:.4f},{:.4f},{:.4f}\n", secondsText(prism->stamp), prism->station_p.x(),
                 prism->station_p.y(), prism->station_p.z());
  file.commit();
}

void writeGnss(const Scene& scene, const std::filesystem::path& path)
{
  OutputFile file(path);
  file.stream() << "#t [s],lat [deg],lon [deg],height [m]\n";
  for (const GnssFix& fix :
       gnssFixes(scene.scenery.drive(), scene.span, scene.gnss, scene.body_T_prism.translation, scene.seed))
    fmt::print(file.stream(), "{},{:.9f},{:.9f},{:.3f}\n", secondsText(fix.stamp), fix.at.latitude, fix.at.longitude,
               fix.at.height);
  file.commit();
}

const char* nameOf(ObjectKind kind)
{
  return kind == ObjectKind::Person ? "person" : kind == ObjectKind::Vehicle ? "vehicle" : "tree";
}

void writeObjects(const Scene& scene, const std::filesystem::path& path)
{
  OutputFile file(path);
  file.stream() << "#t [s],id,type,x,y,z,yaw_deg,vx,vy,length,width,height (x y z: ground point under the centre, "
                   "world frame)\n";
  for (Duration t{0}; seconds(t) <= scene.span.duration; t += kObjectPeriod)
    for (const MovingObject& object : scene.scenery.objects().at(seconds(t)))
      if (object.moves)
        fmt::print(file.stream(), "{},{},{},{:.3f},{:.3f},{:.3f},{:.2f},{:.3f},{:.3f},{:.2f},{:.2f},{:.2f}\n",
                   secondsText(scene.span.start + t), object.id, nameOf(object.kind), object.ground_point.x(),
                   object.ground_point.y(), object.ground_point.z(), kDegrees * object.yaw, object.velocity.x(),
                   object.velocity.y(), object.size.x(), object.size.y(), object.size.z());
  file.commit();
}

void writeTrees(const Scene& scene, const std::filesystem::path& path)
{
  OutputFile file(path);
  file.stream() << "#x [m],y [m],z [m],diameter [m],length [m] (x y z: foot of the stem, world frame; diameter at "
                   "1.3 m)\n";
  for (const Stem& stem : scene.scenery.world().stems())
    fmt::print(file.stream(), "{:.3f},{:.3f},{:.3f},{:.3f},{:.2f}\n", stem.foot.x(), stem.foot.y(), stem.foot.z(),
               stem.diameter, stem.length);
  file.commit();
}

void writeExtrinsics(const Scene& scene, const std::filesystem::path& path)
{
  std::vector<std::pair<std::string, Rigid>> poses;
  for (const LidarStation& lidar : scene.lidars)
    poses.emplace_back("T_body_" + lidar.name, lidar.written_body_T_sensor);
  poses.emplace_back("T_body_imu", scene.body_imu.body_T_imu);
  poses.emplace_back("T_body_prism", scene.body_T_prism);
  poses.emplace_back("T_ts_world", stationTWorld());
  if (scene.gnss.error > 0) poses.emplace_back("T_enu_world", enuTWorld());
  OutputFile file(path);
  file.stream() << "# T_a_b maps coordinates in b to a. Line: name x y z yaw pitch roll (m, deg; R = Rz(yaw) Ry(pitch) "
                   "Rx(roll)), then the 4x4 rows.\n# sensor = Ouster sensor coordinate frame (after "
                   "lidar_to_sensor_transform); imu = frame of imu.csv\n";
  for (const auto& [name, pose] : poses)
  {
    fmt::print(file.stream(), "{} {}\n", name, poseText(pose));
    const Eigen::Matrix4d m = pose.matrix();
    for (int row = 0; row < 4; ++row)
      fmt::print(file.stream(), "  {:.12f} {:.12f} {:.12f} {:.12f}\n", m(row, 0), m(row, 1), m(row, 2), m(row, 3));
  }
  file.commit();
}

void writeText(const std::filesystem::path& path, const std::string& text)
{
  writeAtomically(path, [&](std::ostream& file) { file << text << '\n'; });
}

/** Returns of all lidars by surface, and rays without return as "none". */
nlohmann::json returnsJson(const std::vector<PacketCounts>& counts)
{
  constexpr std::array<const char*, kSurfaces> kNames{"ground",  "stem", "branch", "crown",    "undergrowth",
                                                      "machine", "boom", "object", "building", "precipitation"};
  ReturnCounts all;
  for (const PacketCounts& lidar : counts) all.add(lidar.returns);
  nlohmann::json returns{{"none", all.none}};
  for (std::size_t i = 0; i < kSurfaces; ++i)
    if (i <= static_cast<std::size_t>(Surface::Object) || all.of_surface[i] > 0) returns[kNames[i]] = all.of_surface[i];
  return returns;
}

nlohmann::json vectorJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::string summaryOf(const Scene& scene, const std::vector<PacketCounts>& counts, const TurnOnBias& bias)
{
  nlohmann::json summary{{"seed", scene.seed},
                         {"seconds", scene.span.duration},
                         {"stems", scene.scenery.world().stems().size()},
                         {"epoch_ns", nanoseconds(scene.span.start)},
                         {"imu_bias_gyro_rad_s", vectorJson(bias.gyro)},
                         {"imu_bias_accel_m_s2", vectorJson(bias.accel)},
                         {"returns", returnsJson(counts)}};
  for (std::size_t i = 0; i < counts.size(); ++i)
    summary[scene.lidars[i].name] = {{"lidar_packets", counts[i].lidar},
                                     {"imu_packets", counts[i].imu},
                                     {"lost", counts[i].lost},
                                     {"reordered", counts[i].reordered},
                                     {"duplicated", counts[i].duplicated}};
  std::uint64_t rays = 0;
  for (const auto& returns : summary["returns"]) rays += returns.get<std::uint64_t>();
  summary["rays"] = rays;
  return summary.dump(2);
}
}  // namespace

std::vector<std::string> recordingFileNames(const SimulationSettings& settings)
{
  const char* const lidars = settings.recording.packets() ? "recording.pcap" : "recording.rawlog";
  std::vector<std::string> names{lidars,           "imu.csv",     "groundtruth.tum", "total_station.csv",
                                 "extrinsics.txt", "objects.csv", "trees.csv",       "summary.json"};
  if (settings.gnss.error > 0) names.emplace_back("gnss.csv");
  for (const SimulatedLidarOptions& lidar : settings.lidars) names.push_back(lidar.name + ".json");
  return names;
}

void writeRecording(const Scene& scene, const std::filesystem::path& folder,
                    const std::function<void(double)>& progress)
{
  const std::vector<PacketCounts> counts = writeCapture(scene, folder / "recording.pcap", progress);
  for (const LidarStation& lidar : scene.lidars) writeText(folder / (lidar.name + ".json"), toJson(lidar.metadata()));
  const TurnOnBias bias = writeImu(scene, folder / "imu.csv");
  writeGroundTruth(scene, folder / "groundtruth.tum");
  writeTotalStation(scene, folder / "total_station.csv");
  if (scene.gnss.error > 0) writeGnss(scene, folder / "gnss.csv");
  writeExtrinsics(scene, folder / "extrinsics.txt");
  writeObjects(scene, folder / "objects.csv");
  writeTrees(scene, folder / "trees.csv");
  writeText(folder / "summary.json", summaryOf(scene, counts, bias));
}
}  // namespace scanloom
