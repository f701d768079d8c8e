#include "base/config/iniValue.h"

#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>

#include <fstream>
#include <stdexcept>

namespace scanloom::ini_value_unittest
{
namespace
{
std::string asMrptReads(const std::string& text)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "a.ini") << "[section]\nkey = " << text << "\nnext = 1\n";
  return mrpt::config::CConfigFile((folder / "a.ini").string()).read_string("section", "key", "", true);
}
}  // namespace

TEST(IniValue, isReadByMrptAsItWasWritten)
{
  for (const char* text : {"/points", "/left/lidar_packets", "a b", "a, b", "x=y", "x # y", "[s]", "\"q\"", "$HOME"})
    EXPECT_EQ(asMrptReads(iniValue(text)), text);
}

TEST(IniValue, isNoKeyNoFormulaAndNoComment)
{
  for (const char* text : {"/a\nimu_csv = /etc/passwd", "/a\r[output]", "/$eval{1+1}", "/$env{HOME}", "${x}", "a // b",
                           "//a", " a", "a ", "a\\"})
    EXPECT_THROW(iniValue(text), std::invalid_argument) << text;
}
}  // namespace scanloom::ini_value_unittest
