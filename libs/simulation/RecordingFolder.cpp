#include "simulation/RecordingFolder.h"

#include "output/OutputFile.h"
#include "output/SecondsText.h"
#include "output/Trajectory.h"
#include "simulation/PacketStream.h"
#include "source/CaptureWriter.h"
#include "source/EurocImu.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr double kDegrees = 180 / M_PI;
const Rigid kStationTWorld = Rigid::fromXyzYawPitchRoll(512.3, -87.1, 44.2, 137.3 / kDegrees, 0, 0);

struct PacketCounts
{
  std::uint64_t lidar = 0, imu = 0;
};

/** Writes the datagrams of both lidars in the order of their receipt, a second of the drive at a time. */
std::array<PacketCounts, 2> writeCapture(const Scene& scene, const std::filesystem::path& path,
                                         const std::function<void(double)>& progress)
{
  constexpr Duration kSlice = 1s;
  constexpr Duration kLongestTransport = 10ms;
  const Timestamp end = scene.span.start + fromSeconds(scene.span.duration);

  AtomicFile file(path);
  CaptureWriter capture(file.temporary());
  std::array<PacketStream, 2> streams{PacketStream(scene, scene.lidars[0]), PacketStream(scene, scene.lidars[1])};
  std::array<PacketCounts, 2> counts;
  std::vector<Datagram> waiting;
  for (Timestamp until = scene.span.start; until < end;)
  {
    until = std::min(until + kSlice, end);
    for (std::size_t i = 0; i < streams.size(); ++i)
      for (Datagram& datagram : streams[i].finishedBefore(until))
      {
        const bool is_imu = datagram.destination_port == scene.lidars[i].lidar.metadata().imu_port;
        ++(is_imu ? counts[i].imu : counts[i].lidar);
        waiting.push_back(std::move(datagram));
      }
    std::stable_sort(waiting.begin(), waiting.end(),
                     [](const Datagram& a, const Datagram& b) { return a.received < b.received; });

    // What the next slice brings was measured after `until`: nothing can still come before it.
    const Timestamp settled = until == end ? end + kLongestTransport : until;
    const auto unsettled = std::find_if(waiting.begin(), waiting.end(),
                                        [&](const Datagram& datagram) { return datagram.received >= settled; });
    std::for_each(waiting.begin(), unsettled, [&](const Datagram& datagram) { capture.write(datagram); });
    waiting.erase(waiting.begin(), unsettled);
    progress(seconds(until - scene.span.start) / scene.span.duration);
  }
  capture.close();
  file.commit();
  return counts;
}

void writeGroundTruth(const Scene& scene, const std::filesystem::path& path)
{
  TumWriter writer(path);
  for (Duration t{0}; seconds(t) <= scene.span.duration; t += 10ms)
    writer.add({scene.span.start + t, scene.drive.at(seconds(t)).world_T_body});
  writer.close();
}

void writeTotalStation(const Scene& scene, const std::filesystem::path& path)
{
  constexpr double kRate = 7.0;       // Hz
  constexpr double kNoise = 0.002;    // m
  constexpr double kLostShare = 0.1;  // hidden by a stem
  OutputFile file(path);
  file.stream() << "#t [s],x [m],y [m],z [m]\n";
  for (std::uint64_t i = 0;; ++i)
  {
    Random random(scene.seed, RandomStream::TotalStation, i);
    const Duration t = fromSeconds((static_cast<double>(i) + random.uniform(0.2, 0.4)) / kRate);
    if (seconds(t) > scene.span.duration) break;
    if (random.uniform() < kLostShare) continue;
    Eigen::Vector3d prism = kStationTWorld * (scene.drive.at(seconds(t)).world_T_body * scene.body_T_prism.translation);
    for (double& coordinate : prism) coordinate += kNoise * random.normal();
    fmt::print(file.stream(), "{},{:.4f},{:.4f},{:.4f}\n", secondsText(scene.span.start + t), prism.x(), prism.y(),
               prism.z());
  }
  file.commit();
}

void writeExtrinsics(const Scene& scene, const std::filesystem::path& path)
{
  const std::vector<std::pair<std::string, Rigid>> poses{{"T_body_left", scene.lidars[0].lidar.bodyTSensor()},
                                                         {"T_body_right", scene.lidars[1].lidar.bodyTSensor()},
                                                         {"T_body_imu", scene.body_T_imu},
                                                         {"T_body_prism", scene.body_T_prism},
                                                         {"T_ts_world", kStationTWorld}};
  OutputFile file(path);
  file.stream() << "# T_a_b maps coordinates in b to a. Line: name x y z yaw pitch roll (m, deg; R = Rz(yaw) Ry(pitch) "
                   "Rx(roll)), then the 4x4 rows.\n# sensor = Ouster sensor coordinate frame (after "
                   "lidar_to_sensor_transform); imu = frame of imu.csv\n";
  for (const auto& [name, pose] : poses)
  {
    const Eigen::Vector3d& t = pose.translation;
    const Eigen::Vector3d angles = kDegrees * pose.yawPitchRoll();
    fmt::print(file.stream(), "{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", name, t.x(), t.y(), t.z(), angles[0],
               angles[1], angles[2]);
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

nlohmann::json vectorJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::string summaryOf(const Scene& scene, const std::array<PacketCounts, 2>& counts)
{
  nlohmann::json summary{{"seed", scene.seed},
                         {"seconds", scene.span.duration},
                         {"stems", scene.world.stems().size()},
                         {"epoch_ns", nanoseconds(scene.span.start)},
                         {"imu_bias_gyro_rad_s", vectorJson(scene.imu_errors.bias.gyro)},
                         {"imu_bias_accel_m_s2", vectorJson(scene.imu_errors.bias.accel)}};
  for (std::size_t i = 0; i < counts.size(); ++i)
    summary[scene.lidars[i].name] = {{"lidar_packets", counts[i].lidar}, {"imu_packets", counts[i].imu}};
  return summary.dump(2);
}
}  // namespace

const std::vector<std::string>& recordingFileNames()
{
  static const std::vector<std::string> names{"recording.pcap", "left.json",       "right.json",
                                              "imu.csv",        "groundtruth.tum", "total_station.csv",
                                              "extrinsics.txt", "objects.csv",     "summary.json"};
  return names;
}

void writeRecording(const Scene& scene, const std::filesystem::path& folder,
                    const std::function<void(double)>& progress)
{
  constexpr Duration kImuPeriod = 5ms;
  constexpr Duration kImuPhase = 1230us;  // no clock starts with the recording

  const std::array<PacketCounts, 2> counts = writeCapture(scene, folder / "recording.pcap", progress);
  for (const LidarStation& station : scene.lidars)
    writeText(folder / (station.name + ".json"), toJson(station.lidar.metadata()));
  writeEurocImu(folder / "imu.csv", simulateImu(scene.drive, scene.span, scene.body_T_imu, scene.span.start + kImuPhase,
                                                kImuPeriod, scene.imu_errors, scene.seed, RandomStream::BodyImu));
  writeGroundTruth(scene, folder / "groundtruth.tum");
  writeTotalStation(scene, folder / "total_station.csv");
  writeExtrinsics(scene, folder / "extrinsics.txt");
  writeText(folder / "objects.csv",
            "#t [s],id,type,x,y,z,yaw_deg,vx,vy,length,width,height (x y z: ground point under "
            "the centre, world frame)");
  writeText(folder / "summary.json", summaryOf(scene, counts));
}
}  // namespace scanloom
