#include "base/core/PartFile.h"

#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <unistd.h>

namespace scanloom::part_file_unittest
{
namespace
{
void write(const PartFile& file, const std::string& text)
{
  const int descriptor = file.descriptor();
  ASSERT_EQ(::write(descriptor, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(descriptor);
}

TEST(PartFile, staysAsPartUntilItIsCommitted)
{
  const TemporaryFolder folder;
  write(PartFile(folder / "a.rawlog"), "lost");
  EXPECT_EQ(contentOf(folder / "a.rawlog.part"), "lost");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.rawlog"));
}

TEST(PartFile, keepsThePartsOfTwoRunsThatDied)
{
  const TemporaryFolder folder;
  write(PartFile(folder / "a.rawlog"), "first");
  PartFile second(folder / "a.rawlog");
  write(second, "second");
  EXPECT_EQ(second.earlier(), folder / "a.rawlog.part.1");
  EXPECT_EQ(contentOf(second.earlier()), "first");
  EXPECT_EQ(second.commit(Completeness::Whole), folder / "a.rawlog");
  EXPECT_EQ(contentOf(folder / "a.rawlog"), "second");

  write(PartFile(folder / "a.rawlog"), "third");
  EXPECT_EQ(PartFile(folder / "a.rawlog").earlier(), folder / "a.rawlog.part.2");
}

TEST(PartFile, followsNoLink)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "victim") << "precious";
  std::filesystem::create_symlink(folder / "victim", folder / "a.rawlog.part");
  write(PartFile(folder / "a.rawlog"), "new");
  EXPECT_EQ(contentOf(folder / "victim"), "precious");
  EXPECT_EQ(contentOf(folder / "a.rawlog.part"), "new");
}

TEST(PartFile, leavesThatOfARunningWriterAlone)
{
  const TemporaryFolder folder;
  const PartFile running(folder / "a.rawlog");
  write(running, "running");
  EXPECT_THROW(PartFile(folder / "a.rawlog"), std::runtime_error);
  EXPECT_EQ(contentOf(folder / "a.rawlog.part"), "running");
}
}  // namespace
}  // namespace scanloom::part_file_unittest
