#include "base/formats/EurocImu.h"

#include "input/packets/HandmadeCapture.h"
#include "support/TestData.h"

#include <gmock/gmock.h>

#include <fstream>

namespace scanloom::euroc_imu_unittest
{
namespace
{
using testing::HasSubstr;

struct Csv : HandmadeCapture
{
  explicit Csv(const std::string& text) : path(folder() / "imu.csv") { std::ofstream(path) << text; }
  std::filesystem::path path;
};

std::string errorOf(const std::string& text)
{
  const Csv csv(text);
  try
  {
    readEurocImu(csv.path);
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(EurocImu, readsSamplesBehindAnyHeading)
{
  for (const char* heading : {"", "#timestamp [ns],w_x\n", "timestamp,wx,wy,wz,ax,ay,az\n", "\n# a\n# b\n"})
  {
    const Csv csv(std::string(heading) +
                  "1750000000001230000,0.5,-1e-3,2, 3 ,4,9.75\r\n1750000000006230000,0,0,0,0,0,9.8");
    const auto samples = readEurocImu(csv.path);
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(nanoseconds(samples[0].stamp), 1750000000001230000);
    EXPECT_EQ(samples[0].gyro, Eigen::Vector3d(0.5, -1e-3, 2));
    EXPECT_EQ(samples[0].accel, Eigen::Vector3d(3, 4, 9.75));
  }
}

TEST(EurocImu, namesFileAndLineOfWhatItCannotRead)
{
  EXPECT_THAT(errorOf("1,0,0,0,0,0,9\n2,0,0,0,0,9\n"), HasSubstr("imu.csv:2: "));
  EXPECT_THAT(errorOf("1,0,0,0,0,0,9\n\n2,0,0,0,0,0,9,1\n"), HasSubstr("imu.csv:3: "));
  EXPECT_THAT(errorOf("1.5,0,0,0,0,0,9\n"), HasSubstr("imu.csv:1: "));
  EXPECT_THAT(errorOf("1,0,0,0,0,0,nan\n"), HasSubstr("imu.csv:1: "));
  EXPECT_THAT(errorOf("1,0,0,0,0,0,9x\n"), HasSubstr("imu.csv:1: "));
  EXPECT_THAT(errorOf("t,x\nanother,heading\n"), HasSubstr("imu.csv:2: "));
  EXPECT_THAT(errorOf("2,0,0,0,0,0,9\n2,0,0,0,0,0,9\n"), HasSubstr("not after 2 ns"));
  EXPECT_THROW(readEurocImu("/no/such/imu.csv"), std::runtime_error);
}

TEST(EurocImu, writesWhatReadsBackToTheBit)
{
  const Csv csv("");
  std::vector<ImuSample> samples{{fromNanoseconds(-5), {0.1, 1.0 / 3, -0.0}, {1e-300, 9.80665, -1e17}},
                                 {fromNanoseconds(1750000000001230001), {1, 2, 3}, {4, 5, 6}}};
  EurocImuWriter writer(csv.path);
  for (const ImuSample& sample : samples) writer.add(sample);
  writer.close();
  const auto again = readEurocImu(csv.path);

  ASSERT_EQ(again.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    EXPECT_EQ(again[i].stamp, samples[i].stamp);
    EXPECT_EQ(again[i].gyro, samples[i].gyro);
    EXPECT_EQ(again[i].accel, samples[i].accel);
  }
}

TEST(EurocImu, saysWhenItCannotWrite)
{
  EXPECT_THROW(EurocImuWriter("/no/such/folder/imu.csv").close(), std::runtime_error);
}

TEST(EurocImu, readsTheRecordingsAt200Hz)
{
  SCANLOOM_NEEDS_DATA(csv, "recordings/sparse/imu.csv");
  const auto samples = readEurocImu(csv);
  EXPECT_NEAR(seconds(samples.back().stamp - samples.front().stamp) / static_cast<double>(samples.size() - 1), 0.005,
              1e-6);
  EXPECT_NEAR(samples.front().accel.norm(), 9.80665, 0.1);
}
}  // namespace
}  // namespace scanloom::euroc_imu_unittest
