#include "base/core/OutputFile.h"

#include "support/FullDisk.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace scanloom::output_file_unittest
{
namespace
{
TEST(OutputFile, appearsWhenItIsCommitted)
{
  const TemporaryFolder folder;
  OutputFile file(folder / "a");
  file.stream() << "whole";

  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  file.commit();
  EXPECT_EQ(contentOf(folder / "a"), "whole");
}

TEST(OutputFile, noticesThatTheDiskTookNoMore)
{
  const TemporaryFolder folder;
  {
    const FullDisk full(1000);
    OutputFile file(folder / "a");
    file.stream() << std::string(100'000, 'x');
    EXPECT_THROW(file.commit(), std::runtime_error);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}
}  // namespace
}  // namespace scanloom::output_file_unittest
