#include "evaluation/PositionTrack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "support/TemporaryFolder.h"

namespace scanloom
{
namespace
{
PositionTrack read(const std::string& text)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "station.csv") << text;
  return readTotalStation(folder / "station.csv");
}

std::string complaintAbout(const std::string& text)
{
  try
  {
    read(text);
  }
  catch (const std::invalid_argument& e)
  {
    return e.what();
  }
  return "";
}

TEST(PositionTrack, isReadToTheNanosecond)
{
  const PositionTrack track =
      read("#t [s],x [m],y [m],z [m]\n1750000000.000000007,512.5769,-88.2291,48.3286\n\n1750000001.5, 1, 2, 3\r\n");

  ASSERT_EQ(track.size(), 2U);
  EXPECT_EQ(nanoseconds(track[0].stamp), 1750000000000000007);
  EXPECT_EQ(track[0].position, Eigen::Vector3d(512.5769, -88.2291, 48.3286));
  EXPECT_EQ(nanoseconds(track[1].stamp), 1750000001500000000);
}

TEST(PositionTrack, mayHaveAHeaderWithoutMark) { EXPECT_EQ(read("time,x,y,z\n1,1,2,3\n").size(), 1U); }

TEST(PositionTrack, namesFileAndLineOfWhatIsNoMeasurement)
{
  EXPECT_THAT(complaintAbout("1,1,2,3\n2,1,two,3\n"), testing::HasSubstr("station.csv:2: expected 't,x,y,z'"));
  EXPECT_THAT(complaintAbout("2,1,2,3\n2,1,2,3\n"),
              testing::HasSubstr("station.csv:2: stamp 2.000000000 is not after"));
  EXPECT_THROW(readTotalStation("/nowhere.csv"), std::invalid_argument);
}

/** A quarter turn to the left about the origin in a second. */
Trajectory turning()
{
  return {{Timestamp{0s}, {}},
          {Timestamp{1s}, {Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ())), {0, 0, 0}}}};
}

TEST(PositionTrack, thePrismFollowsTheInterpolatedRotation)
{
  const auto pairs = pairsAtReference(turning(), {1, 0, 0}, {{Timestamp{500ms}, {7, 8, 9}}});

  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_TRUE(pairs[0].map_p.isApprox(Eigen::Vector3d(std::sqrt(0.5), std::sqrt(0.5), 0), 1e-12));
  EXPECT_EQ(pairs[0].reference_p, Eigen::Vector3d(7, 8, 9));
}

TEST(PositionTrack, pairsNothingOutsideTheEstimateAndInItsGaps)
{
  const Trajectory gap{{Timestamp{1s}, {}}, {Timestamp{3s}, {}}, {Timestamp{5001ms}, {}}, {Timestamp{6s}, {}}};
  PositionTrack reference;
  for (Duration t{500ms}; t < 8s; t += 1s) reference.push_back({Timestamp{t}, {0, 0, 0}});

  const auto pairs = pairsAtReference(gap, {0, 0, 0}, reference);

  ASSERT_EQ(pairs.size(), 3U);  // 1.5, 2.5 and 5.5 s; from 3 to 5.001 s is wider than 2 s
  EXPECT_EQ(pairs[1].stamp, Timestamp{2500ms});
  EXPECT_EQ(pairs[2].stamp, Timestamp{5500ms});
}
}  // namespace
}  // namespace scanloom
