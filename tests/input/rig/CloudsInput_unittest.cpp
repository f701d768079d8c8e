#include "input/rig/CloudsInput.h"

#include "input/rig/RecordingFiles.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>

#include <fstream>

namespace scanloom::clouds_input_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class Clouds : public testing::Test
{
 protected:
  /** With a point 1 m ahead per time; without times one point. */
  void write(const std::string& name, const std::vector<std::string>& times = {})
  {
    std::ofstream file(folder_ / name);
    file << "ply\nformat ascii 1.0\nelement vertex " << std::max<std::size_t>(1, times.size())
         << "\nproperty float x\nproperty float y\nproperty float z\n"
         << (times.empty() ? "" : "property double timestamp\n") << "end_header\n";
    if (times.empty()) file << "1 0 0\n";
    for (const std::string& time : times) file << "1 0 0 " << time << '\n';
    clouds_.push_back(folder_ / name);
  }

  std::vector<Scan> scans() const
  {
    std::vector<Scan> all;
    CloudsInput input(clouds_);
    while (auto event = input.next()) all.push_back(std::get<Scan>(std::move(*event)));
    return all;
  }

  std::vector<double> ends() const
  {
    std::vector<double> all;
    for (const Scan& scan : scans()) all.push_back(seconds(scan.end().time_since_epoch()));
    return all;
  }

  TemporaryFolder folder_;
  std::vector<std::filesystem::path> clouds_;
};

TEST_F(Clouds, withoutAnyTimesAreTakenForTenHertz)
{
  write("a.ply");
  write("b.ply");
  EXPECT_THAT(ends(), ElementsAre(0.1, 0.2));
}

TEST_F(Clouds, thatAreMissingInTheCountAreMissingInTime)
{
  for (const std::string name : {"scan_7.ply", "scan_8.ply", "scan_11.ply"}) write(name);
  EXPECT_THAT(ends(), ElementsAre(0.1, 0.2, 0.5));
  EXPECT_THAT(CloudsInput(clouds_).takeWarnings().front(), HasSubstr("2 are missing"));
}

TEST_F(Clouds, haveTheTimesOfTimesTxt)
{
  write("a.ply");
  write("b.ply");
  std::ofstream(folder_ / "times.txt") << "100.5\n101\n";
  EXPECT_THAT(ends(), ElementsAre(100.5, 101));
}

TEST_F(Clouds, haveTheTimesOfTheirNames)
{
  write("1700000000.250000.ply");
  write("1700000000.500000.ply");
  EXPECT_EQ(scans()[0].end(), fromNanoseconds(1700000000250000000));
}

TEST_F(Clouds, haveTheNanosecondsOfTheirNames)
{
  write("1700000000250000001.ply");
  write("1700000000500000000.ply");
  EXPECT_EQ(scans()[0].end(), fromNanoseconds(1700000000250000001));
}

TEST_F(Clouds, haveTheTimesOfTheirNamesInTheUnitThatIsALidarsPace)
{
  write("1700000000250000.ply");
  write("1700000000350000.ply");
  EXPECT_EQ(scans().front().end(), fromNanoseconds(1700000000250000000)) << "us";
  write("1700000000450000.ply");
  EXPECT_EQ(scans().back().end(), fromNanoseconds(1700000000450000000));
}

TEST_F(Clouds, whoseNamesOnlyCountAreTakenForTenHertzInTheOrderOfNumbers)
{
  for (const char* name : {"0000000000.ply", "0000000001.ply", "0000000002.ply"}) write(name);
  EXPECT_EQ(scans().back().end(), Timestamp{300ms});
}

TEST_F(Clouds, withNumbersWithoutZerosComeInTheOrderOfNumbers)
{
  for (const char* name : {"10.ply", "9.ply", "100.ply"}) write(name);
  EXPECT_THAT(filesOf({folder_.path()}).clouds,
              ElementsAre(folder_ / "9.ply", folder_ / "10.ply", folder_ / "100.ply"));
}

TEST_F(Clouds, whoseNamesAreTimesInNoUnitAreRefused)
{
  write("1700000000.ply");
  write("1700000003.ply");
  EXPECT_THAT([&] { scans(); }, ThrowsMessage<std::runtime_error>(HasSubstr("their names are no times, 3 apart")));
}

TEST_F(Clouds, haveTheDatesOfKittisTimestamps)
{
  write("0000000000.ply");
  write("0000000001.ply");
  std::ofstream(folder_ / "timestamps.txt") << "2011-09-26 13:02:25.951199337\n2011-09-26 13:02:26.054847000\n";
  EXPECT_EQ(scans()[0].end(), fromNanoseconds(1317042145951199337));
}

TEST_F(Clouds, mustHaveATimeEach)
{
  write("a.ply");
  std::ofstream(folder_ / "times.txt") << "1\n2\n";
  EXPECT_THAT([&] { scans(); }, ThrowsMessage<std::runtime_error>(HasSubstr("2 times for 1 clouds")));
}

TEST_F(Clouds, ofSomeNumbersHaveTheTimesOfTheirLines)
{
  write("000001.ply");
  write("000003.ply");
  std::ofstream(folder_ / "times.txt") << "100\n101\n102\n103\n";
  EXPECT_THAT(ends(), ElementsAre(101, 103));
}

TEST_F(Clouds, mustBeLaterThanTheOnesBefore)
{
  write("a.ply");
  write("b.ply");
  std::ofstream(folder_ / "times.txt") << "1\n1\n";
  EXPECT_THAT([&] { scans(); }, ThrowsMessage<std::runtime_error>(HasSubstr("b.ply is at 1.000000000 s")));
}

TEST_F(Clouds, withTimesOfPointsAreColumnsInTheirOrder)
{
  write("a.ply", {"0.05", "0", "0.05"});
  const Scan scan = scans().at(0);
  ASSERT_EQ(scan.columns.size(), 2U);
  EXPECT_EQ(scan.columns[1].stamp - scan.columns[0].stamp, 50ms);
  EXPECT_EQ(scan.columns[1].count, 2);
  EXPECT_EQ(scan.start, fromNanoseconds(100'000'000)) << "the cloud's stamp";
}

TEST_F(Clouds, mayHaveAbsoluteTimesOfPoints)
{
  write("a.ply", {"1700000000.00", "1700000000.05"});
  EXPECT_NEAR(seconds(scans().at(0).start - fromNanoseconds(1'700'000'000'000'000'000)), 0, 1e-6);
}

TEST_F(Clouds, mayHaveTimesInNanoseconds)
{
  write("a.ply", {"0", "50000000"});
  EXPECT_EQ(scans().at(0).points.t[1], 50'000'000);
}
}  // namespace
}  // namespace scanloom::clouds_input_unittest
