#include "output/OutputFile.h"

#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>

namespace scanloom
{
namespace
{
TEST(OutputFile, leavesTheOldFileUntilItIsCommitted)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "a") << "old";
  OutputFile file(folder / "a");
  file.stream() << "new";

  EXPECT_EQ(contentOf(folder / "a"), "old");
  file.commit();
  EXPECT_EQ(contentOf(folder / "a"), "new");
}

TEST(OutputFile, leavesNothingBehindIfItIsNotCommitted)
{
  const TemporaryFolder folder;
  OutputFile(folder / "a").stream() << "half";

  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(OutputFile, saysWhatItCannotWriteAndWhy)
{
  EXPECT_THAT([] { OutputFile("/no/such/folder/a"); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::AllOf(testing::HasSubstr("/no/such/folder/a"), testing::HasSubstr("No such file"))));
}

TEST(OutputFile, noticesAFullDisk)
{
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "a.part");
  OutputFile file(folder / "a");
  file.stream() << std::string(100'000, 'x');

  EXPECT_THROW(file.commit(), std::runtime_error);
}
}  // namespace
}  // namespace scanloom
