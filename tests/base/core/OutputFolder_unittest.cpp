#include "base/core/OutputFolder.h"

#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>

namespace scanloom::output_folder_unittest
{
namespace
{
using testing::UnorderedElementsAre;

struct Results : testing::Test
{
  TemporaryFolder place;
  const std::filesystem::path folder = place / "out";

  const std::vector<std::string> names{"poses.tum", "map.bt", "summary.json"};

  static void write(const OutputFolder& results, const std::vector<std::string>& names, const std::string& run)
  {
    for (const std::string& name : names) std::ofstream(results.running() / name) << run;
  }

  /** "name: content" of each. */
  static std::vector<std::string> filesIn(const std::filesystem::path& folder)
  {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      files.push_back(entry.path().filename().string() + (entry.is_directory() ? "/" : ": " + contentOf(entry.path())));
    return files;
  }
};

TEST_F(Results, appearTogetherWhenTheyAreCommitted)
{
  OutputFolder first(folder);
  write(first, {"poses.tum", "summary.json"}, "first");
  EXPECT_FALSE(std::filesystem::exists(folder / "poses.tum"));
  EXPECT_EQ(first.commit(names, Completeness::Whole), folder);
  EXPECT_THAT(filesIn(folder), UnorderedElementsAre("poses.tum: first", "summary.json: first"));
}

TEST_F(Results, ofAnEarlierRunGoAlsoWhereTheNewRunHasNone)
{
  OutputFolder first(folder);
  write(first, {"poses.tum", "map.bt", "summary.json"}, "first");
  first.commit(names, Completeness::Whole);
  std::ofstream(folder / "notes.txt") << "mine";
  OutputFolder second(folder);
  write(second, {"poses.tum", "summary.json"}, "second");
  second.commit(names, Completeness::Whole);
  EXPECT_THAT(filesIn(folder), UnorderedElementsAre("poses.tum: second", "summary.json: second", "notes.txt: mine"));
}

TEST_F(Results, thatArePartialStayBesideThoseOfAnEarlierRun)
{
  OutputFolder first(folder);
  write(first, {"poses.tum"}, "first");
  EXPECT_EQ(first.commit(names, Completeness::Partial), folder) << "there was no earlier run";
  for (const std::string kept : {"partial", "partial-2"})
  {
    OutputFolder next(folder);
    write(next, {"poses.tum", "map.bt"}, kept);
    EXPECT_EQ(next.commit(names, Completeness::Partial), folder / kept);
    EXPECT_THAT(filesIn(folder / kept), UnorderedElementsAre("poses.tum: " + kept, "map.bt: " + kept));
  }
  EXPECT_THAT(filesIn(folder), UnorderedElementsAre("poses.tum: first", "partial/", "partial-2/"));
}

TEST_F(Results, thatAreNotCommittedLeaveTheFolderAsItWas)
{
  OutputFolder first(folder);
  write(first, {"poses.tum"}, "first");
  first.commit(names, Completeness::Whole);
  {
    OutputFolder failed(folder);
    write(failed, {"poses.tum", "map.bt"}, "failed");
  }
  EXPECT_THAT(filesIn(folder), UnorderedElementsAre("poses.tum: first"));
}
}  // namespace
}  // namespace scanloom::output_folder_unittest
