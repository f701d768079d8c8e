#include "base/core/AtomicFile.h"

#include "base/core/ConfigError.h"
#include "support/FullDisk.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace scanloom::atomic_file_unittest
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
  const FullDisk full(1000);
  EXPECT_THROW(writeAtomically(folder / "full.csv", [](std::ostream& out) { out << std::string(100'000, 'x'); }),
               std::runtime_error);
  EXPECT_EQ(files(), 0);
}

TEST_F(AtomicFileTest, leavesAloneWhatHasItsTemporaryNameAlsoALink)
{
  std::ofstream(folder / "victim") << "precious";
  const auto taken = folder / ("a.partial-" + std::to_string(::getpid()) + ".tum");
  std::filesystem::create_symlink(folder / "victim", taken);

  writeAtomically(folder / "a.tum", [](std::ostream& out) { out << "new"; });

  EXPECT_EQ(contentOf(folder / "victim"), "precious");
  EXPECT_TRUE(std::filesystem::is_symlink(taken));
  EXPECT_EQ(contentOf(folder / "a.tum"), "new");
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "a.tum"));
}

TEST_F(AtomicFileTest, isPutBesideAWholeFileIfItIsPartial)
{
  const auto writePartial = [&](const std::string& text)
  {
    AtomicFile file(folder / "map.bt");
    std::ofstream(file.temporary()) << text;
    return file.commit(Completeness::Partial);
  };
  EXPECT_EQ(writePartial("first"), folder / "map.bt") << "there was no file";
  EXPECT_EQ(writePartial("second"), folder / "map.partial.bt");
  EXPECT_EQ(writePartial("third"), folder / "map.partial-2.bt");
  EXPECT_EQ(contentOf(folder / "map.bt"), "first");
  EXPECT_EQ(contentOf(folder / "map.partial.bt"), "second");
}

TEST_F(AtomicFileTest, inputsAreNoOutputsByWhateverName)
{
  std::ofstream(folder / "in.rawlog") << "precious";
  std::filesystem::create_symlink(folder / "in.rawlog", folder / "link.rawlog");
  std::filesystem::create_hard_link(folder / "in.rawlog", folder / "twin.rawlog");

  EXPECT_NO_THROW(refuseInputsAsOutputs({folder / "in.rawlog", ""}, {folder / "out.rawlog"}));
  for (const char* name : {"in.rawlog", "link.rawlog", "twin.rawlog", "./in.rawlog"})
    EXPECT_THROW(refuseInputsAsOutputs({folder / "other", folder / "in.rawlog"}, {folder / name}), UsageError) << name;
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
}  // namespace scanloom::atomic_file_unittest
