#include "base/core/oneOfEachStamp.h"

#include <gmock/gmock.h>

namespace scanloom::one_of_each_stamp_unittest
{
namespace
{
ImuSample at(Duration t, double turn_rate) { return {Timestamp{t}, {0, 0, turn_rate}, {0, 0, 9.81}}; }
}  // namespace

TEST(OneOfEachStamp, copiesAreNoConflict)
{
  const ImuOfEachStamp one = oneOfEachStamp({at(0ms, 1), at(5ms, 2), at(5ms, 2), at(10ms, 3)});
  EXPECT_EQ(one.samples.size(), 3u);
  EXPECT_EQ(one.copies, 1u);
  EXPECT_FALSE(one.isStampedInBursts());
}

TEST(OneOfEachStamp, samplesStampedAsTheyArriveAreToldApartFromOneThatStrayed)
{
  std::vector<ImuSample> bursts, strayed;
  for (int i = 0; i < 200; ++i)
  {
    bursts.push_back(at(50ms * (i / 10), i));
    strayed.push_back(at(i == 100 ? 495ms : 5ms * i, i));
  }
  EXPECT_TRUE(oneOfEachStamp(bursts).isStampedInBursts());
  EXPECT_THAT(*oneOfEachStamp(bursts).leftOut(), testing::HasSubstr("180 of 200 samples have the stamp of another"));
  EXPECT_EQ(oneOfEachStamp(strayed).conflicts, 1u);
  EXPECT_FALSE(oneOfEachStamp(strayed).isStampedInBursts());
}
}  // namespace scanloom::one_of_each_stamp_unittest
