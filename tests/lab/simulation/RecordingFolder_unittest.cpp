#include "lab/simulation/RecordingFolder.h"

#include "base/config/Configuration.h"
#include "base/formats/ImuCsv.h"
#include "base/formats/Trajectory.h"
#include "estimation/imu/Preintegration.h"
#include "input/lidar/OusterDecoder.h"
#include "input/packets/CaptureReader.h"
#include "input/rig/Extrinsics.h"
#include "lab/simulation/internal/Machine.h"
#include "support/TemporaryFolder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

#include "mantle.h"
#include "support/messageOf.h"

namespace scanloom::recording_folder_unittest
{
namespace
{
SimulationSettings shortDrive()
{
  SimulationSettings settings;
  settings.drive.duration = 4;
  settings.drive.standstill = 0.5;
  settings.drive.speed_up = 1;
  settings.body.sway_deg = 3;
  settings.ranging.range_noise = 0.02;
  settings.ranging.range_noise_weak = 0;
  settings.objects.person_every = settings.objects.vehicle_every = 0;
  // Ground and stems only: surfaces that the test can compute.
  settings.forest.trees.branches.living_branches = settings.forest.trees.branches.dead_branches = 0;
  settings.forest.stand.stumps_per_hectare = 0;
  settings.forest.foliage.leaf_area_density = settings.forest.foliage.undergrowth_cover = 0;
  return settings;
}

void record(const std::filesystem::path& folder, std::uint64_t seed = 1)
{
  std::filesystem::create_directory(folder);
  writeRecording(makeScene(shortDrive(), seed), folder, [](double) {});
}

/** Every file's content, by name. */
std::map<std::string, std::string> contents(const std::filesystem::path& folder)
{
  std::map<std::string, std::string> files;
  for (const std::string& name : recordingFileNames(shortDrive())) files[name] = contentOf(folder / name);
  return files;
}
/** The decoder of a lidar, made from the files of the recording alone. */
OusterDecoder decoderOf(const std::filesystem::path& folder, const std::string& name)
{
  return {loadOusterMetadata((folder / (name + ".json")).string()),
          readExtrinsics(folder / "extrinsics.txt").at("T_body_" + name)};
}

/** Calls visit(stamp, points in the body frame) for every block of a lidar. */
template <typename Visitor>
void forEachBlock(const std::filesystem::path& folder, const OusterDecoder& decoder, Visitor&& visit)
{
  CaptureReader capture(folder / "recording.pcap");
  Datagram datagram;
  std::vector<MeasurementBlock> blocks;
  while (capture.next(datagram))
  {
    if (datagram.destination_port != decoder.description().lidar_port) continue;
    ASSERT_EQ(decoder.kind(datagram.payload), PacketKind::Lidar);
    decoder.readBlocks(datagram.payload, blocks);
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
      PointCloud points;
      decoder.appendPoints(datagram.payload, i, 0, 0, points);
      visit(blocks[i], points);
    }
  }
}

bool isOnMachine(const Eigen::Vector3d& in_body)
{
  static const Scene scene = makeScene(shortDrive(), 1);
  const Machine& machine = scene.scenery.machine();
  const auto near = [&](const Eigen::AlignedBox3d& box) { return box.exteriorDistance(in_body) < 0.2; };
  for (const OrientedBox& box : machine.boom().boxes(machine.boom().at(0)))
    if (((box.frameTBox().inverse() * in_body).cwiseAbs() - box.half()).maxCoeff() < 0.2) return true;
  return std::any_of(machine.body().begin(), machine.body().end(), near);
}

struct Surroundings
{
  double distance;         // m, of the point to the nearest surface
  Eigen::Vector3d normal;  // of that surface
};

Surroundings nearestSurface(const World& world, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d up = world.ground().normal(p.x(), p.y());
  Surroundings nearest{(p.z() - world.ground().height(p.x(), p.y())) * up.z(), up};
  for (const Stem& stem : world.stems())
    if ((stem.foot - p).head<2>().norm() < 4 && std::abs(distanceToMantle(stem.wood(), p)) < std::abs(nearest.distance))
      nearest = {distanceToMantle(stem.wood(), p), stem.wood().normal(p)};
  return nearest;
}

TEST(RecordingFolder, putsDecodedPointsOntoTheSurfacesWithTheNoiseThatWasAskedFor)
{
  const TemporaryFolder folder;
  record(folder / "a");
  const Trajectory truth = readTum(folder / "a" / "groundtruth.tum");
  const Scene scene = makeScene(shortDrive(), 1);
  const World& world = scene.scenery.world();

  for (const char* name : {"left", "right"})
  {
    const OusterDecoder decoder = decoderOf(folder / "a", name);
    double squares = 0, sum = 0, count = 0, outliers = 0;
    forEachBlock(folder / "a", decoder,
                 [&](const MeasurementBlock& block, const PointCloud& points)
                 {
                   if (block.measurement_id % 8 != 0) return;
                   const Rigid world_T_body = poseAt(truth, block.stamp).value();
                   const Rigid world_T_sensor = world_T_body * decoder.description().body_T_sensor;
                   for (std::size_t i = 0; i < points.size(); ++i)
                   {
                     const Eigen::Vector3d in_body = points.position(i).cast<double>();
                     const Eigen::Vector3d p = world_T_body * in_body;
                     if (isOnMachine(in_body) || points.range[i] < 3000) continue;
                     const Eigen::Vector3d direction = (p - world_T_sensor.translation).normalized();
                     const Surroundings surface = nearestSurface(world, p);
                     const double cosine = -surface.normal.dot(direction);
                     if (cosine < 0.3) continue;  // there the surface bends away within the noise
                     const double error = surface.distance / cosine;
                     ++(std::abs(error) < 0.15 ? count : outliers);
                     if (std::abs(error) >= 0.15) continue;
                     squares += error * error;
                     sum += error;
                   }
                 });
    const double injected = std::hypot(shortDrive().ranging.range_noise, 0.008 / std::sqrt(12));
    EXPECT_GT(count, 10'000) << name;
    EXPECT_LT(outliers / count, 1e-3) << name;
    EXPECT_NEAR(std::sqrt(squares / count), injected, 0.05 * injected) << name;
    EXPECT_NEAR(sum / count, 0, 1e-3) << name << ": no bias";
    RecordProperty(fmt::format("{}_rms_mm", name), fmt::format("{:.2f}", 1e3 * std::sqrt(squares / count)));
    RecordProperty(fmt::format("{}_injected_mm", name), fmt::format("{:.2f}", 1e3 * injected));
    RecordProperty(fmt::format("{}_mean_mm", name), fmt::format("{:.3f}", 1e3 * sum / count));
  }
}

TEST(RecordingFolder, hasTheSameBytesForTheSameSeedOnAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  record(folder / "a");
  {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    record(folder / "b");
  }
  record(folder / "c", 2);

  EXPECT_TRUE(contents(folder / "a") == contents(folder / "b"));
  EXPECT_FALSE(contents(folder / "a").at("recording.pcap") == contents(folder / "c").at("recording.pcap"));
  EXPECT_FALSE(contents(folder / "a").at("imu.csv") == contents(folder / "c").at("imu.csv"));
}

TEST(RecordingFolder, holdsEveryColumnOnceInOrderAndEveryReceiptAfterItsMeasurement)
{
  const TemporaryFolder folder;
  record(folder / "a");
  CaptureReader capture(folder / "a" / "recording.pcap");
  const OusterDecoder decoder = decoderOf(folder / "a", "right");
  Timestamp last_received, last_stamp;
  std::vector<MeasurementBlock> blocks;
  std::optional<std::uint64_t> last_column;
  bool wrapped = false;
  for (Datagram datagram; capture.next(datagram);)
  {
    ASSERT_GE(datagram.received, last_received);
    last_received = datagram.received;
    if (datagram.destination_port != decoder.description().lidar_port) continue;
    decoder.readBlocks(datagram.payload, blocks);
    for (const MeasurementBlock& block : blocks)
    {
      const std::uint64_t column = block.frame_id * 512ULL + block.measurement_id;
      ASSERT_EQ(column, last_column ? (*last_column + 1) % (65536ULL * 512) : column) << "frame " << block.frame_id;
      wrapped |= last_column && column < *last_column;
      ASSERT_GT(block.stamp, last_stamp);
      ASSERT_LT(block.stamp, datagram.received);
      last_column = column;
      last_stamp = block.stamp;
    }
  }
  EXPECT_TRUE(wrapped) << "40 turns from 65500 on";
}

TEST(RecordingFolder, tellsWhereEveryReturnCameFrom)
{
  const TemporaryFolder folder;
  record(folder / "a");
  const auto summary = nlohmann::json::parse(contentOf(folder / "a" / "summary.json"));

  std::uint64_t blocks = 0, points = 0, channels = 0;
  for (const char* name : {"left", "right"})
  {
    const OusterDecoder decoder = decoderOf(folder / "a", name);
    channels = static_cast<std::uint64_t>(decoder.description().channels);
    forEachBlock(folder / "a", decoder,
                 [&](const MeasurementBlock&, const PointCloud& cloud)
                 {
                   ++blocks;
                   points += cloud.size();
                 });
  }

  EXPECT_EQ(summary["rays"], channels * blocks);
  EXPECT_EQ(summary["returns"]["none"], channels * blocks - points);
  EXPECT_GT(summary["returns"]["ground"], summary["returns"]["stem"]);
  EXPECT_EQ(summary["returns"]["crown"], 0) << "this stand is bare";
}

TEST(RecordingFolder, hasBothImusAndTheTruthOnOneClock)
{
  const TemporaryFolder folder;
  record(folder / "a");

  const auto imu = readImuCsv(folder / "a" / "imu.csv").readings.samples;
  const Trajectory truth = readTum(folder / "a" / "groundtruth.tum");

  EXPECT_EQ(imu.size(), 800U);
  EXPECT_EQ(truth.size(), 401U);
  EXPECT_LT(imu.front().stamp - truth.front().stamp, 5ms);
  EXPECT_LT(truth.back().stamp - imu.back().stamp, 5ms);
}

TEST(RecordingFolder, isReadLikeTheRecordingOfAStranger)
{
  const TemporaryFolder folder;
  record(folder / "a");
  const OusterDecoder decoder = decoderOf(folder / "a", "left");
  CaptureReader capture(folder / "a" / "recording.pcap");
  std::map<std::uint16_t, int> packets;
  double gravity = 0;
  for (Datagram datagram; capture.next(datagram);)
  {
    ++packets[datagram.destination_port];
    if (datagram.destination_port != decoder.description().imu_port) continue;
    ASSERT_EQ(decoder.kind(datagram.payload), PacketKind::Imu);
    gravity += decoder.imuSamples(datagram.payload).front().accel.norm();
  }
  EXPECT_NEAR(packets[7502], 4 * 320, 32);
  EXPECT_NEAR(packets[7504], 4 * 320, 32);
  EXPECT_NEAR(packets[7503], 400, 11);
  EXPECT_NEAR(packets[7505], 400, 11);
  EXPECT_NEAR(gravity / packets[7503], kGravity, 0.6);  // with the bias and the vibration
}

TEST(RecordingOptions, ofTheDemonstrationAreTheDefaults)
{
  const Configuration demo =
      Configuration::fromFiles({std::filesystem::path(SCANLOOM_SOURCE_DIR) / "params/simulation/demo.ini"});
  const Schema schema = schemaOf<SimulationSettings>();

  EXPECT_EQ(toIni(schemaOf(readSettings<SimulationSettings>(demo, schema))), toIni(schema));
}

TEST(Scene, namesTheOptionThatCannotBe)
{
  SimulationSettings settings = shortDrive();
  settings.lidars[1].pose = "1 2 3";
  EXPECT_THAT(messageOf<std::invalid_argument>([&] { makeScene(settings, 1); }), testing::HasSubstr("lidar2_pose"));
  settings = shortDrive();
  settings.lidars[0].mode = "512x11";
  EXPECT_THROW(makeScene(settings, 1), std::invalid_argument);
}
}  // namespace
}  // namespace scanloom::recording_folder_unittest
