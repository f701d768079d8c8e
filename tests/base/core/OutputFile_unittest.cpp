#include "base/core/OutputFile.h"

#include "base/core/ConfigError.h"
#include "support/FullDisk.h"
#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace scanloom::output_file_unittest
{
namespace
{
struct OutputFileTest : testing::Test
{
  TemporaryFolder workplace;
  std::filesystem::path folder = workplace.path();

  std::ptrdiff_t files() const { return std::distance(std::filesystem::directory_iterator(folder), {}); }
};

TEST_F(OutputFileTest, appearsUnderItsNameWhenItIsCommitted)
{
  OutputFile file(folder / "map.bt");
  std::ofstream(file.temporary()) << "tree";
  EXPECT_FALSE(std::filesystem::exists(folder / "map.bt"));
  EXPECT_EQ(file.temporary().parent_path(), folder);
  EXPECT_EQ(file.temporary().extension(), ".bt");

  file.commit();

  EXPECT_EQ(contentOf(folder / "map.bt"), "tree");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, leavesNothingBehindWithoutCommit)
{
  {
    OutputFile file(folder / "map.bt");
    EXPECT_EQ(files(), 1);
  }
  EXPECT_EQ(files(), 0);
}

TEST_F(OutputFileTest, keepsTheOldFileIfWritingFails)
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

TEST_F(OutputFileTest, replacesTheOldFile)
{
  writeAtomically(folder / "a.tum", [](std::ostream& out) { out << "old"; });
  writeAtomically(folder / "a.tum", [](std::ostream& out) { out << "new"; });

  EXPECT_EQ(contentOf(folder / "a.tum"), "new");
}

TEST_F(OutputFileTest, saysWhyItCannotBeWritten)
{
  const auto reason = [](const std::filesystem::path& file)
  { return messageOf<std::runtime_error>([&] { OutputFile{file}; }); };
  EXPECT_EQ(reason(folder / "none" / "a.tum"),
            (folder / "none" / "a.tum").string() + ": cannot be written: No such file or directory");
  EXPECT_EQ(reason(folder), folder.string() + ": cannot be written: Is a directory");
}

TEST_F(OutputFileTest, failsWhenTheDiskIsFull)
{
  const FullDisk full(1000);
  EXPECT_THROW(writeAtomically(folder / "full.csv", [](std::ostream& out) { out << std::string(100'000, 'x'); }),
               std::runtime_error);
  EXPECT_EQ(files(), 0);
}

TEST_F(OutputFileTest, leavesAloneWhatHasItsTemporaryNameAlsoALink)
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

TEST_F(OutputFileTest, isPutBesideAWholeFileIfItIsPartial)
{
  const auto writePartial = [&](const std::string& text)
  {
    OutputFile file(folder / "map.bt");
    std::ofstream(file.temporary()) << text;
    return file.commit(Completeness::Partial);
  };
  EXPECT_EQ(writePartial("first"), folder / "map.bt") << "there was no file";
  EXPECT_EQ(writePartial("second"), folder / "map.partial.bt");
  EXPECT_EQ(writePartial("third"), folder / "map.partial-2.bt");
  EXPECT_EQ(contentOf(folder / "map.bt"), "first");
  EXPECT_EQ(contentOf(folder / "map.partial.bt"), "second");
}

TEST_F(OutputFileTest, inputsAreNoOutputsByWhateverName)
{
  std::ofstream(folder / "in.rawlog") << "precious";
  std::filesystem::create_symlink(folder / "in.rawlog", folder / "link.rawlog");
  std::filesystem::create_hard_link(folder / "in.rawlog", folder / "twin.rawlog");

  EXPECT_NO_THROW(refuseInputsAsOutputs({folder / "in.rawlog", ""}, {folder / "out.rawlog"}));
  for (const char* name : {"in.rawlog", "link.rawlog", "twin.rawlog", "./in.rawlog"})
    EXPECT_THROW(refuseInputsAsOutputs({folder / "other", folder / "in.rawlog"}, {folder / name}), UsageError) << name;
}

TEST_F(OutputFileTest, refusesToReplaceFilesUnlessAsked)
{
  const std::vector<std::filesystem::path> outputs{folder / "a.tum", folder / "b.tum", folder / "c.tum"};
  EXPECT_NO_THROW(refuseExisting(outputs, false));
  std::ofstream(outputs[0]) << "a";
  std::ofstream(outputs[2]) << "c";

  EXPECT_EQ(messageOf<UsageError>([&] { refuseExisting(outputs, false); }),
            outputs[0].string() + ", " + outputs[2].string() + " exist already: give -w to overwrite");
  EXPECT_NO_THROW(refuseExisting(outputs, true));
}

TEST(OutputFile, ofAStreamAppearsWhenItIsCommitted)
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

void write(const OutputFile& file, const std::string& text)
{
  const int descriptor = file.descriptor();
  ASSERT_EQ(::write(descriptor, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(descriptor);
}

TEST(OutputFileThatStays, staysAsPartUntilItIsCommitted)
{
  const TemporaryFolder folder;
  write(OutputFile(folder / "a.rawlog", Uncommitted::Stays), "lost");
  EXPECT_EQ(contentOf(folder / "a.rawlog.part"), "lost");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.rawlog"));
}

TEST(OutputFileThatStays, keepsThePartsOfTwoRunsThatDied)
{
  const TemporaryFolder folder;
  write(OutputFile(folder / "a.rawlog", Uncommitted::Stays), "first");
  OutputFile second(folder / "a.rawlog", Uncommitted::Stays);
  write(second, "second");
  EXPECT_EQ(second.earlier(), folder / "a.rawlog.part.1");
  EXPECT_EQ(contentOf(second.earlier()), "first");
  EXPECT_EQ(second.commit(Completeness::Whole), folder / "a.rawlog");
  EXPECT_EQ(contentOf(folder / "a.rawlog"), "second");

  write(OutputFile(folder / "a.rawlog", Uncommitted::Stays), "third");
  EXPECT_EQ(OutputFile(folder / "a.rawlog", Uncommitted::Stays).earlier(), folder / "a.rawlog.part.2");
}

TEST(OutputFileThatStays, followsNoLink)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "victim") << "precious";
  std::filesystem::create_symlink(folder / "victim", folder / "a.rawlog.part");
  write(OutputFile(folder / "a.rawlog", Uncommitted::Stays), "new");
  EXPECT_EQ(contentOf(folder / "victim"), "precious");
  EXPECT_EQ(contentOf(folder / "a.rawlog.part"), "new");
}

TEST(OutputFileThatStays, leavesThatOfARunningWriterAlone)
{
  const TemporaryFolder folder;
  const OutputFile running(folder / "a.rawlog", Uncommitted::Stays);
  write(running, "running");
  EXPECT_THROW(OutputFile(folder / "a.rawlog", Uncommitted::Stays), std::runtime_error);
  EXPECT_EQ(contentOf(folder / "a.rawlog.part"), "running");
}

std::vector<std::filesystem::path> committed(const TemporaryFolder& folder, const std::string& text, Completeness how)
{
  std::list<OutputFile> files;
  for (const char* name : {"m.bt", "m.ply"}) files.emplace_back(folder / name);
  for (OutputFile& file : files) file.stream() << text << file.temporary().extension().string();
  return commitTogether(files, how);
}

TEST(OutputFiles, appearTogetherWithTheirEndings)
{
  const TemporaryFolder folder;
  EXPECT_THAT(committed(folder, "a", Completeness::Whole), testing::ElementsAre(folder / "m.bt", folder / "m.ply"));
  EXPECT_EQ(contentOf(folder / "m.bt"), "a.bt");
  EXPECT_EQ(contentOf(folder / "m.ply"), "a.ply");
}

TEST(OutputFiles, areAllPutBesideIfOnePartialFileWouldReplaceAnother)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "m.bt") << "good";
  EXPECT_THAT(committed(folder, "b", Completeness::Partial),
              testing::ElementsAre(folder / "m.partial.bt", folder / "m.partial.ply"));
  EXPECT_EQ(contentOf(folder / "m.bt"), "good");
  EXPECT_FALSE(std::filesystem::exists(folder / "m.ply"));
}
}  // namespace
}  // namespace scanloom::output_file_unittest
