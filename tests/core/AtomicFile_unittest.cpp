#include "core/AtomicFile.h"

#include "core/ConfigError.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
struct AtomicFileTest : testing::Test
{
  TemporaryFolder workplace;
  std::filesystem::path folder = workplace.path();

  std::ptrdiff_t files() const { return std::distance(std::filesystem::directory_iterator(folder), {}); }
};

TEST_F(AtomicFileTest, appearsUnderItsNameWhenItIsCommitted)
{
  AtomicFile file(folder / "map.bt");
  std::ofstream(file.temporary()) << "tree";
  EXPECT_FALSE(std::filesystem::exists(folder / "map.bt"));
  EXPECT_EQ(file.temporary().parent_path(), folder);
  EXPECT_EQ(file.temporary().extension(), ".bt");

  file.commit();

  EXPECT_EQ(contentOf(folder / "map.bt"), "tree");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, leavesNothingBehindWithoutCommit)
{
  {
    AtomicFile file(folder / "map.bt");
    EXPECT_EQ(files(), 1);
  }
  EXPECT_EQ(files(), 0);
}

TEST_F(AtomicFileTest, keepsTheOldFileIfWritingFails)
{
  writeAtomically(folder / "a.tum", [](std::ostream& out) { out << "old"; });

  EXPECT_THROW(writeAtomically(folder / "a.tum",
                               [](std::ostream& out)
                               {
                                 out << "half";
                                 throw std::length_error("no more");
                               }),
               std::length_error);
  EXPECT_EQ(contentOf(folder / "a.tum"), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, replacesTheOldFile)
{
  writeAtomically(folder / "a.tum", [](std::ostream& out) { out << "old"; });
  writeAtomically(folder / "a.tum", [](std::ostream& out) { out << "new"; });

  EXPECT_EQ(contentOf(folder / "a.tum"), "new");
}

TEST_F(AtomicFileTest, saysWhyItCannotBeWritten)
{
  const auto reason = [](const std::filesystem::path& file) -> std::string
  {
    try
    {
      AtomicFile{file};
    }
    catch (const std::runtime_error& e)
    {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(reason(folder / "none" / "a.tum"),
            (folder / "none" / "a.tum").string() + ": cannot be written: No such file or directory");
  EXPECT_EQ(reason(folder), folder.string() + ": cannot be written: Is a directory");
}

TEST_F(AtomicFileTest, failsWhenTheDiskIsFull)
{
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const auto file = folder / "full.csv";
  std::filesystem::create_symlink("/dev/full", folder / ("full.partial-" + std::to_string(::getpid()) + ".csv"));

  EXPECT_THROW(writeAtomically(file, [](std::ostream& out) { out << "x"; }), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(AtomicFileTest, refusesToReplaceFilesUnlessAsked)
{
  const std::vector<std::filesystem::path> outputs{folder / "a.tum", folder / "b.tum", folder / "c.tum"};
  EXPECT_NO_THROW(refuseExisting(outputs, false));
  std::ofstream(outputs[0]) << "a";
  std::ofstream(outputs[2]) << "c";

  try
  {
    refuseExisting(outputs, false);
    FAIL() << "must refuse";
  }
  catch (const UsageError& e)
  {
    EXPECT_EQ(e.what(), outputs[0].string() + ", " + outputs[2].string() + " exist already: give -w to overwrite");
  }
  EXPECT_NO_THROW(refuseExisting(outputs, true));
}
}  // namespace
}  // namespace scanloom
