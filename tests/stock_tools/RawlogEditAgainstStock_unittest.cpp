/** Where MRPT's rawlog-edit has the same operation, it gives the same bytes. */
#include "mrpt/edit/internal/RawlogCut.h"
#include "mrpt/edit/internal/RawlogLabels.h"
#include "mrpt/edit/internal/SplitLidars.h"
#include "mrpt/edit/smallRawlog.h"
#include "stockTool.h"

#include <gtest/gtest.h>

namespace scanloom::rawlog_edit_against_stock_unittest
{
namespace
{
struct AgainstStock : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog");
  std::filesystem::path ours = folder / "ours.rawlog";
  std::filesystem::path theirs = folder / "theirs.rawlog";

  std::string stock(const std::string& operation) const
  {
    rawlogEdit(operation + " -i " + in.string() + " -o " + theirs.string());
    return uncompressed(theirs);
  }
};

TEST_F(AgainstStock, removingALabelGivesTheSameBytes)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-edit");
  if (!kStockFiltersRemove) GTEST_SKIP() << "removes nothing";
  edited(in, removeLabels({"imu_right"}), ours);
  EXPECT_TRUE(uncompressed(ours) == stock("--remove-label imu_right"));
}

TEST_F(AgainstStock, aCutHoldsTheSameObjectsAndTheHeader)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-edit");
  if (!kStockFiltersRemove) GTEST_SKIP() << "removes nothing";
  RawlogSpan span;
  span.from_index = 3;
  span.to_index = 11;
  edited(in, cutTo(span), ours);
  const std::string mine = uncompressed(ours), stocks = stock("--cut --from-index 3 --to-index 11");
  ASSERT_GT(mine.size(), stocks.size());
  EXPECT_TRUE(mine.substr(mine.size() - stocks.size()) == stocks);
}

TEST_F(AgainstStock, partsOfLidarsAreReadWhole)
{
  SCANLOOM_NEEDS_PROGRAM("rawlog-edit");
  edited(in, splitLidars(someHeader()), ours);
  const std::string info = rawlogEdit("--info -i " + ours.string());
  EXPECT_EQ(occurrences(info, "lidar_left"), 4) << info;
  EXPECT_EQ(occurrences(info, "lidar_right"), 4) << info;
  EXPECT_EQ(occurrences(info, "imu"), 8) << info;
}
}  // namespace
}  // namespace scanloom::rawlog_edit_against_stock_unittest
