#include "base/formats/ImuCsv.h"

#include "input/packets/HandmadeCapture.h"
#include "support/TestData.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <fstream>

namespace scanloom::imu_csv_unittest
{
namespace
{
using testing::HasSubstr;

struct Table : HandmadeCapture
{
  explicit Table(const std::string& text) : path(folder() / "imu.csv") { std::ofstream(path) << text; }
  std::filesystem::path path;
};

std::string errorOf(const std::string& text)
{
  const Table csv(text);
  return messageOf<std::runtime_error>([&] { readImuCsv(csv.path); });
}

TEST(ImuCsv, readsSamplesBehindAnyHeading)
{
  for (const char* heading : {"", "#timestamp [ns],w_x\n", "timestamp,wx,wy,wz,ax,ay,az\n", "\n# a\n# b\n"})
  {
    const Table csv(std::string(heading) +
                    "1750000000001230000,0.5,-1e-3,2, 3 ,4,9.75\r\n1750000000006230000,0,0,0,0,0,9.8");
    const auto samples = readImuCsv(csv.path).readings.samples;
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(nanoseconds(samples[0].stamp), 1750000000001230000);
    EXPECT_EQ(samples[0].gyro, Eigen::Vector3d(0.5, -1e-3, 2));
    EXPECT_EQ(samples[0].accel, Eigen::Vector3d(3, 4, 9.75));
  }
}

TEST(ImuCsv, namesFileAndLineOfWhatItCannotRead)
{
  EXPECT_THAT(errorOf("1,0,0,0,0,0,9\n2,0,0,0,0,9\n"), HasSubstr("imu.csv:2: "));
  EXPECT_THAT(errorOf("1,0,0,0,0,0,9\n\n2,0,0,0,0,0,9,1\n"), HasSubstr("imu.csv:3: "));
  EXPECT_THAT(errorOf("1.5s,0,0,0,0,0,9\n1,0\n"), HasSubstr("imu.csv:2: "));
  EXPECT_THAT(errorOf("1,0,0,0,0,0,nan\n"), HasSubstr("imu.csv:1: "));
  EXPECT_THAT(errorOf("1,0,0,0,0,0,9x\n"), HasSubstr("imu.csv:1: "));
  EXPECT_THAT(errorOf("t,x\nanother,heading\n"), HasSubstr("imu.csv:2: "));
  EXPECT_THAT(errorOf("2,0,0,0,0,0,9\n1,0,0,0,0,0,9\n"), HasSubstr("not after 2 ns"));
  EXPECT_THROW(readImuCsv("/no/such/imu.csv"), std::runtime_error);
}

TEST(ImuCsv, findsItsColumnsByTheirNamesAndSaysWhatItConverted)
{
  const Table ros(
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.orientation.x,"
      "field.angular_velocity.x,field.angular_velocity.y,field.angular_velocity.z,"
      "field.angular_velocity_covariance0,field.linear_acceleration.x,field.linear_acceleration.y,"
      "field.linear_acceleration.z\n"
      "1750000000900000000,7,1750000000000000001,imu_link,0.5,1,2,3,-1,4,5,6\n");
  const ImuOfFile by_name = readImuCsv(ros.path);
  ASSERT_EQ(by_name.readings.samples.size(), 1u);
  EXPECT_EQ(nanoseconds(by_name.readings.samples[0].stamp), 1750000000000000001)
      << "of the header, not of the reception";
  EXPECT_EQ(by_name.readings.samples[0].gyro, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(by_name.readings.samples[0].accel, Eigen::Vector3d(4, 5, 6));

  const Table units(
      "t [s],acc_x [g],acc_y [g],acc_z [g],gyro_x (deg/s),gyro_y (deg/s),gyro_z (deg/s)\n"
      "100.005,0,0,1,180,0,0\n100.01,0,0,1,0,0,0\n");
  const ImuOfFile converted = readImuCsv(units.path);
  ASSERT_EQ(converted.readings.samples.size(), 2u);
  EXPECT_EQ(nanoseconds(converted.readings.samples[0].stamp), 100'005'000'000);
  EXPECT_NEAR(converted.readings.samples[0].gyro.x(), M_PI, 1e-12);
  EXPECT_NEAR(converted.readings.samples[0].accel.z(), 9.80665, 1e-12);
  EXPECT_EQ(converted.notes.size(), 3u);
}

TEST(ImuCsv, takesStampsInTheUnitOfAnImusPace)
{
  const auto second = [](const std::string& first_stamp, const std::string& second_stamp)
  {
    const Table csv(first_stamp + ",0,0,0,0,0,9.8\n" + second_stamp + ",0,0,0,0,0,9.8\n");
    return nanoseconds(readImuCsv(csv.path).readings.samples.at(1).stamp);
  };
  EXPECT_EQ(second("1750000000000000000", "1750000000005000000"), 1750000000005000000);
  EXPECT_EQ(second("1750000000000000", "1750000000005000"), 1750000000005000000);
  EXPECT_EQ(second("1750000000000", "1750000000005"), 1750000000005000000);
}

TEST(ImuCsv, leavesOutALineThatIsThereTwiceAndCountsIt)
{
  const Table csv("1000000000,0,0,0,0,0,9\n1005000000,0,0,0,0,0,9\n1005000000,0,0,0,0,0,9\n");
  const ImuOfFile imu = readImuCsv(csv.path);
  EXPECT_EQ(imu.readings.samples.size(), 2u);
  EXPECT_EQ(imu.readings.copies, 1u);
}

TEST(ImuCsv, isRecognisedByItsFirstLines)
{
  EXPECT_TRUE(beginsLikeImuCsv("#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y,w_RS_S_z,a_RS_S_x,a_RS_S_y,a_RS_S_z\n"));
  EXPECT_TRUE(beginsLikeImuCsv("\n# of a machine\n1750000000001230000,0,0,0,0,0,9.8\n"));
  EXPECT_TRUE(beginsLikeImuCsv("12.5,0.01,0,0,0.1,0,9.7\n"));
  EXPECT_FALSE(beginsLikeImuCsv("12.5,1,2,0,0,0,0.5\n")) << "a pose in roll, pitch and yaw weighs nothing";
  EXPECT_FALSE(beginsLikeImuCsv("1750000000001230000,0,0,0,1,0,0,0\n")) << "a pose of EuRoC";
  EXPECT_FALSE(beginsLikeImuCsv("x,y,z\n"));
  EXPECT_FALSE(beginsLikeImuCsv(""));
}

TEST(ImuCsv, writesWhatReadsBackToTheBit)
{
  const Table csv("");
  std::vector<ImuSample> samples{{fromNanoseconds(-5), {0.1, 1.0 / 3, -0.0}, {1e-300, 9.80665, -1e17}},
                                 {fromNanoseconds(1750000000001230001), {1, 2, 3}, {4, 5, 6}}};
  ImuCsvWriter writer(csv.path);
  for (const ImuSample& sample : samples) writer.add(sample);
  writer.close();
  const auto again = readImuCsv(csv.path).readings.samples;

  ASSERT_EQ(again.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    EXPECT_EQ(again[i].stamp, samples[i].stamp);
    EXPECT_EQ(again[i].gyro, samples[i].gyro);
    EXPECT_EQ(again[i].accel, samples[i].accel);
  }
}

TEST(ImuCsv, saysWhenItCannotWrite)
{
  EXPECT_THROW(ImuCsvWriter("/no/such/folder/imu.csv").close(), std::runtime_error);
}

TEST(ImuCsv, readsTheRecordingsAt200Hz)
{
  SCANLOOM_NEEDS_DATA(csv, "recordings/sparse/imu.csv");
  const auto samples = readImuCsv(csv).readings.samples;
  EXPECT_NEAR(seconds(samples.back().stamp - samples.front().stamp) / static_cast<double>(samples.size() - 1), 0.005,
              1e-6);
  EXPECT_NEAR(samples.front().accel.norm(), 9.80665, 0.1);
}
}  // namespace
}  // namespace scanloom::imu_csv_unittest
