#include "base/core/fileNameOf.h"

#include <gtest/gtest.h>

namespace scanloom::file_name_of_unittest
{
TEST(FileNameOf, keepsOrdinaryLabels)
{
  for (const char* label : {"lidar", "imu_left", "a.b", "OS-0 128", "\xc3\xa4"}) EXPECT_EQ(fileNameOf(label), label);
}

TEST(FileNameOf, leavesNoWayOutOfTheFolder)
{
  EXPECT_EQ(fileNameOf("../../x"), "%2E.%2F..%2Fx");
  EXPECT_EQ(fileNameOf("/etc/passwd"), "%2Fetc%2Fpasswd");
  EXPECT_EQ(fileNameOf(".."), "%2E.");
  EXPECT_EQ(fileNameOf("a\x1b[2J\n"), "a%1B[2J%0A");
  EXPECT_NE(fileNameOf("%2F"), fileNameOf("/"));
}

TEST(FileNameOf, isShortEnoughForAFileSystem)
{
  const std::string label(5000, 'a');
  EXPECT_LT(fileNameOf(label).size(), 200u);
  EXPECT_NE(fileNameOf(label), fileNameOf(label + "b"));
}
}  // namespace scanloom::file_name_of_unittest
