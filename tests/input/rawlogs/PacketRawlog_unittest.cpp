#include "input/rawlogs/PacketRawlog.h"

#include <gmock/gmock.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include "../lidar/velodynePackets.h"
#include "input/rawlogs/Conversions.h"
#include "support/PacketRawlogFile.h"
#include "support/TemporaryFolder.h"
#include "support/TestData.h"

namespace scanloom::packet_rawlog_unittest
{
namespace
{
const Timestamp kBegin = fromNanoseconds(1'700'000'000'000'000'000);

std::vector<std::uint8_t> packetAt(std::uint32_t microseconds)
{
  VelodyneContent content;
  content.microseconds = microseconds;
  return velodynePacket(content);
}

mrpt::obs::CObservationIMU::Ptr imuAt(Timestamp stamp)
{
  auto imu = mrpt::obs::CObservationIMU::Create();
  imu->sensorLabel = "xsens";
  imu->timestamp = toMrpt(stamp);
  using namespace mrpt::obs;
  for (const auto axis : {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC, IMU_WX, IMU_WY, IMU_WZ}) imu->set(axis, 1.0 + axis);
  return imu;
}

std::vector<RawlogMeasurement> measurementsIn(const std::filesystem::path& file)
{
  PacketRawlog rawlog(file);
  std::vector<RawlogMeasurement> all;
  for (RawlogMeasurement measurement; rawlog.next(measurement);) all.push_back(measurement);
  EXPECT_EQ(rawlog.damage(), "");
  return all;
}
}  // namespace

TEST(PacketRawlog, givesPacketsWithTheirBytesLabelAndPose)
{
  const TemporaryFolder folder;
  const auto first = packetAt(5000), second = packetAt(6327);
  writeRawlog(folder / "drive.rawlog",
              {velodyneScan({first, second}, toMrpt(kBegin), "front", mrpt::poses::CPose3D(1, 2, 3, 0.1, 0, 0)),
               imuAt(kBegin + 1ms), mrpt::obs::CObservationOdometry::Create()});

  const auto measurements = measurementsIn(folder / "drive.rawlog");

  ASSERT_EQ(measurements.size(), 2U);
  EXPECT_EQ(measurements[0].label, "front");
  EXPECT_NEAR((measurements[0].body_T_sensor.translation - Eigen::Vector3d(1, 2, 3)).norm(), 0, 1e-9);
  EXPECT_NEAR(measurements[0].body_T_sensor.yawPitchRoll()[0], 0.1, 1e-9);
  const auto& turn = std::get<VelodyneTurn>(measurements[0].value);
  ASSERT_EQ(turn.packets.size(), 2U);
  EXPECT_EQ(turn.packets[0].bytes, first);
  EXPECT_EQ(turn.packets[1].bytes, second);
  EXPECT_EQ(turn.packets[0].received, kBegin);
  EXPECT_EQ(turn.packets[1].received, kBegin + 1327us);
  EXPECT_EQ(measurements[1].label, "xsens");
  EXPECT_EQ(std::get<ImuSample>(measurements[1].value).stamp, kBegin + 1ms);
}

TEST(PacketRawlog, receiveTimesGoOnOverTheHour)
{
  const TemporaryFolder folder;
  writeRawlog(folder / "drive.rawlog",
              {velodyneScan({packetAt(3'599'999'000), packetAt(327)}, toMrpt(kBegin), "front")});
  const auto measurements = measurementsIn(folder / "drive.rawlog");
  EXPECT_EQ(std::get<VelodyneTurn>(measurements.at(0).value).packets.at(1).received, kBegin + 1327us);
}

TEST(PacketRawlog, readsTheFramesOfTheOtherFormat)
{
  const TemporaryFolder folder;
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(velodyneScan({packetAt(5000)}, toMrpt(kBegin), "front"));
  frame->insert(imuAt(kBegin));
  writeRawlog(folder / "drive.rawlog", {frame});
  EXPECT_EQ(measurementsIn(folder / "drive.rawlog").size(), 2U);
}

TEST(PacketRawlog, isRecognisedByItsContentNotByItsName)
{
  const TemporaryFolder folder;
  writeRawlog(folder / "packets", {imuAt(kBegin), velodyneScan({packetAt(5000)}, toMrpt(kBegin), "front")});
  writeRawlog(folder / "samples.rawlog", {imuAt(kBegin)});
  std::ofstream(folder / "text.rawlog") << "no rawlog";
  EXPECT_TRUE(isRawlogOfPackets(folder / "packets"));
  for (const char* other : {"samples.rawlog", "text.rawlog", "missing.rawlog"})
    EXPECT_FALSE(isRawlogOfPackets(folder / other)) << other;
}

TEST(PacketRawlog, aCountThatTheFileCannotHoldIsDamageAndTakesNoMemory)
{
  const TemporaryFolder folder;
  const auto file = folder / "drive.rawlog";
  writeRawlog(file, {velodyneScan({packetAt(5000)}, toMrpt(kBegin), "front")});
  std::string bytes = contentOf(file);
  const std::string one("\1\0\0\0\xff\xee", 6);  // the count before the first block's flag
  const std::size_t count = bytes.find(one);
  ASSERT_NE(count, std::string::npos);
  bytes.replace(count, 4, "\xff\xff\xff\x7f");
  std::ofstream(file, std::ios::binary) << bytes;

  PacketRawlog rawlog(file);
  RawlogMeasurement measurement;
  EXPECT_FALSE(rawlog.next(measurement));
  EXPECT_THAT(rawlog.damage(), testing::HasSubstr("CObservationVelodyneScan of 2147483647 items"));
}

TEST(PacketRawlog, readsMrptsOwnSample)
{
  SCANLOOM_NEEDS_DATA(sample, "other-lidars/MRPT+mrpt/modules/mrpt_data/datasets/test_velodyne_VLP16.rawlog");
  const auto measurements = measurementsIn(sample);
  ASSERT_EQ(measurements.size(), 1U);
  EXPECT_EQ(measurements[0].label, "Velodyne1_SCAN");
  EXPECT_TRUE(isRawlogOfPackets(sample));
}
}  // namespace scanloom::packet_rawlog_unittest
