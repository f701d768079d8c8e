/** Runs all tests, or those of the files that are named: scanloom_test_batching TimeBatcher Slices. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>

namespace
{
/** Patterns of --gtest_filter for all tests of tests/<lib>/<file>_unittest.cpp. */
std::string testsOf(const std::string& file)
{
  std::string names;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s)
  {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t)
      if (std::filesystem::path(suite.GetTestInfo(t)->file()).stem() == file + "_unittest")
        names += std::string(suite.name()) + '.' + suite.GetTestInfo(t)->name() + ':';
  }
  return names;
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleMock(&argc, argv);
  std::string filter;
  for (int i = 1; i < argc; ++i)
  {
    const std::string tests = testsOf(argv[i]);
    if (tests.empty())
    {
      std::cerr << "no test in " << argv[i] << "_unittest.cpp\n";
      return 2;
    }
    filter += tests;
  }
  if (!filter.empty()) GTEST_FLAG_SET(filter, filter);
  return RUN_ALL_TESTS();
}
