#include "mrpt/maps/KeyframeTable.h"

#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <fstream>

namespace scanloom::keyframe_table_unittest
{
TEST(KeyframeTable, givesBackWhatWasWritten)
{
  const TemporaryFolder folder;
  Matrix6d covariance = 1e-4 * Matrix6d::Identity();
  covariance(0, 5) = covariance(5, 0) = 3.25e-5;
  KeyframeTableWriter table(folder / "keyframes.csv");
  table.add({fromNanoseconds(1'750'000'000'000'000'100), false, covariance});
  table.add({fromNanoseconds(1'750'000'004'000'000'100), true, 2 * covariance});
  table.close();

  const std::vector<KeyframeRow> rows = readKeyframeTable(folder / "keyframes.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(nanoseconds(rows[0].stamp), 1'750'000'000'000'000'100);
  EXPECT_FALSE(rows[0].begins_map);
  EXPECT_TRUE(rows[1].begins_map);
  EXPECT_LT((rows[0].covariance - covariance).norm(), 1e-12);
  EXPECT_LT((rows[1].covariance - 2 * covariance).norm(), 1e-12);
}

TEST(KeyframeTable, namesTheLineThatIsNoRow)
{
  const TemporaryFolder folder;
  std::string zeros;
  for (int i = 0; i < 21; ++i) zeros += ",0";
  for (const std::string& line :
       {std::string("5,0"), "5,2" + zeros, "x,0" + zeros, "5,0" + zeros, "5,0" + zeros + ",0"})
  {
    std::ofstream(folder / "keyframes.csv") << "names\n" << line << '\n';
    EXPECT_THAT(messageOf([&] { readKeyframeTable(folder / "keyframes.csv"); }), testing::HasSubstr("keyframes.csv:2"))
        << line;
  }
}
}  // namespace scanloom::keyframe_table_unittest
