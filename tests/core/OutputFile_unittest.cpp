#include "core/OutputFile.h"

#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

namespace scanloom
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
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::signal(SIGXFSZ, SIG_IGN);
  {
    OutputFile file(folder / "a");
    file.stream() << std::string(100'000, 'x');
    EXPECT_THROW(file.commit(), std::runtime_error);
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}
}  // namespace
}  // namespace scanloom
