#include "mrpt/sensors/CMultiLidarSensor.h"

#include "base/core/ConfigError.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/RawlogReader.h"
#include "support/TestData.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <fmt/format.h>

#include <thread>

namespace scanloom::c_multi_lidar_sensor_unittest
{
namespace
{
namespace fs = std::filesystem;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

constexpr const char* kCapture = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/OS-1-128_v2.3.0_1024x10_lb_n3.pcap";
constexpr const char* kMetadata = "ouster/ouster-lidar+ouster-sdk/tests/pcaps/OS-1-128_v2.3.0_1024x10.json";

std::string sectionFor(const fs::path& capture, const fs::path& metadata)
{
  return fmt::format(
      "[global]\nGRABBER_PERIOD_MS = 20\n"
      "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\nsensorLabel = lidar\n"
      "pcap_input = {}\nlidar1_name = top\nlidar1_metadata = {}\nlidar1_pose = [0 0 2 0 0 0]\n",
      capture.string(), metadata.string());
}

std::unique_ptr<mrpt::hwdrivers::CGenericSensor> sensorOf(const std::string& configuration)
{
  CMultiLidarSensor::doRegister();
  std::unique_ptr<mrpt::hwdrivers::CGenericSensor> sensor(
      mrpt::hwdrivers::CGenericSensor::createSensor("CMultiLidarSensor"));
  dynamic_cast<mrpt::system::COutputLogger&>(*sensor).setMinLoggingLevel(mrpt::system::LVL_ERROR);
  sensor->loadConfig(mrpt::config::CConfigFileMemory(configuration), "lidars");
  return sensor;
}

/** What an application gets that frees all it has, as a recorder does; and what ended it. */
struct Replayed
{
  Observations observations;  // copies: the originals are freed
  std::string end;
};

Replayed replay(const std::string& configuration)
{
  const auto sensor = sensorOf(configuration);
  sensor->initialize();
  Replayed result;
  try
  {
    for (;;)
    {
      sensor->doProcess();
      for (const auto& [stamp, object] : sensor->getObservations())
        result.observations.push_back(mrpt::ptr_cast<mrpt::obs::CObservation>::from(object->duplicateGetSmartPtr()));
      std::this_thread::sleep_for(1ms);
    }
  }
  catch (const std::exception& e)
  {
    result.end = e.what();
  }
  return result;
}

template <typename Class>
std::size_t countOf(const Observations& observations)
{
  return static_cast<std::size_t>(std::count_if(observations.begin(), observations.end(),
                                                [](const auto& observation) { return IS_CLASS(*observation, Class); }));
}

std::string complaintAbout(const std::string& configuration)
{
  return messageOf([&] { sensorOf(configuration); });
}
}  // namespace

TEST(CMultiLidarSensor, givesHeaderThenScansAndImuThenEnds)
{
  SCANLOOM_NEEDS_DATA(capture, kCapture);
  SCANLOOM_NEEDS_DATA(metadata, kMetadata);

  const Replayed all = replay(sectionFor(capture, metadata));

  EXPECT_EQ(all.end, "end of input: drained (not an error)");
  ASSERT_FALSE(all.observations.empty());
  const auto header = headerIn(*all.observations.front());
  ASSERT_TRUE(header);
  EXPECT_EQ(header->lidars.at(0).name, "top");
  EXPECT_EQ(header->lidars.at(0).beams, 128);
  EXPECT_EQ(header->lidars.at(0).body_T_sensor.translation.z(), 2);
  EXPECT_EQ(countOf<mrpt::obs::CObservationIMU>(all.observations), 30u) << "as many as there are IMU packets";
  EXPECT_GE(countOf<mrpt::obs::CObservationPointCloud>(all.observations), 3u) << "0.3 s at 10 Hz";
  EXPECT_EQ(countOf<mrpt::obs::CObservationComment>(all.observations), 2u) << "the header, and the comment at the end";
}

TEST(CMultiLidarSensor, namesImusAndTurnsGravityUpInTheBodyFrame)
{
  SCANLOOM_NEEDS_DATA(capture, kCapture);
  SCANLOOM_NEEDS_DATA(metadata, kMetadata);

  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int samples = 0;
  for (const auto& observation : replay(sectionFor(capture, metadata)).observations)
  {
    const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get());
    if (!imu) continue;
    EXPECT_EQ(imu->sensorLabel, "imu_top");
    const auto recorded = fromObservation(*imu);
    sum += recorded->body_T_imu.rotation * recorded->sample.accel;
    samples++;
  }
  EXPECT_NEAR((sum / samples).z(), 9.81, 0.5) << "m/s2, not g";
}

TEST(CMultiLidarSensor, decimatesScansButNeitherHeaderNorImu)
{
  SCANLOOM_NEEDS_DATA(capture, kCapture);
  SCANLOOM_NEEDS_DATA(metadata, kMetadata);

  const Replayed all = replay(sectionFor(capture, metadata));
  const Replayed third = replay(sectionFor(capture, metadata) + "grab_decimation = 3\n");

  EXPECT_TRUE(headerIn(*third.observations.front()));
  EXPECT_EQ(countOf<mrpt::obs::CObservationIMU>(third.observations), 30u);
  EXPECT_EQ(countOf<mrpt::obs::CObservationPointCloud>(third.observations),
            countOf<mrpt::obs::CObservationPointCloud>(all.observations) / 3);
}

TEST(CMultiLidarSensor, givesXyziCloudsIfAskedTo)
{
  SCANLOOM_NEEDS_DATA(capture, kCapture);
  SCANLOOM_NEEDS_DATA(metadata, kMetadata);

  for (const auto& observation : replay(sectionFor(capture, metadata) + "cloud_class = CPointsMapXYZI\n").observations)
  {
    const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(observation.get());
    if (!cloud) continue;
    EXPECT_STREQ(cloud->pointcloud->GetRuntimeClass()->className, "mrpt::maps::CPointsMapXYZI");
  }
}

TEST(CMultiLidarSensor, namesTheKeyThatIsWrongAndTheOneThatWasMeant)
{
  const std::string complaint = complaintAbout(sectionFor("a.pcap", "a.json") + "scan_rte = 20\n");
  EXPECT_NE(complaint.find("section 'lidars': scan_rte is an unknown key: did you mean 'scan_rate'?"),
            std::string::npos)
      << complaint;
}

TEST(CMultiLidarSensor, refusesACloudClassItDoesNotKnow)
{
  const std::string complaint = complaintAbout(sectionFor("a.pcap", "a.json") + "cloud_class = CPointsMap\n");
  EXPECT_NE(complaint.find("cloud_class = CPointsMap"), std::string::npos) << complaint;
}

TEST(CMultiLidarSensor, saysWhichMetadataItCouldNotOpen)
{
  const auto sensor = sensorOf(sectionFor("a.pcap", "nowhere/a.json"));
  EXPECT_THAT(messageOf([&] { sensor->initialize(); }), testing::HasSubstr("nowhere/a.json"));
}
}  // namespace scanloom::c_multi_lidar_sensor_unittest
