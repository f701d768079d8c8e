#include "base/core/StagedFiles.h"

#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>

namespace scanloom::staged_files_unittest
{
namespace
{
using testing::ElementsAre;

std::vector<std::filesystem::path> commit(const TemporaryFolder& folder, const std::string& text, Completeness how)
{
  StagedFiles files({folder / "m.bt", folder / "m.ply"});
  for (const auto& path : files.running()) std::ofstream(path) << text << path.extension().string();
  return files.commit(how);
}

TEST(StagedFiles, appearTogetherWithTheirEndings)
{
  const TemporaryFolder folder;
  EXPECT_THAT(commit(folder, "a", Completeness::Whole), ElementsAre(folder / "m.bt", folder / "m.ply"));
  EXPECT_EQ(contentOf(folder / "m.bt"), "a.bt");
  EXPECT_EQ(contentOf(folder / "m.ply"), "a.ply");
}

TEST(StagedFiles, areAllPutBesideIfOnePartialFileWouldReplaceAnother)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "m.bt") << "good";
  EXPECT_THAT(commit(folder, "b", Completeness::Partial),
              ElementsAre(folder / "m.partial.bt", folder / "m.partial.ply"));
  EXPECT_EQ(contentOf(folder / "m.bt"), "good");
  EXPECT_FALSE(std::filesystem::exists(folder / "m.ply"));
}
}  // namespace
}  // namespace scanloom::staged_files_unittest
