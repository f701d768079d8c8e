/** The program as a person or a script meets it. */
#include "support/runProgram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

namespace scanloom::main_unittest
{
namespace
{
using testing::HasSubstr;
using testing::StartsWith;

Ended scanloom(const std::string& arguments, const std::string& redirection = "2>&1")
{
  return runProgram(SCANLOOM_BIN_DIR "/scanloom " + arguments + " " + redirection);
}

TEST(Executable, tellsItsVersionAndItsVerbs)
{
  EXPECT_EQ(scanloom("--version").status, 0);
  EXPECT_THAT(scanloom("--version").output, StartsWith("scanloom "));
  EXPECT_EQ(scanloom("--help").status, 0);
  EXPECT_THAT(scanloom("--help").output, HasSubstr("config"));
  EXPECT_EQ(scanloom("config --help").status, 0);
  EXPECT_THAT(scanloom("config --help").output, HasSubstr("--default VERB"));
}

TEST(Executable, endsWithTwoAndTheNearestNameOnWrongUsage)
{
  const Ended wrong_verb = scanloom("confg --parameters");
  EXPECT_EQ(wrong_verb.status, 2);
  EXPECT_EQ(wrong_verb.output,
            "scanloom: unknown argument confg: did you mean 'config'?\n'scanloom --help' lists all arguments\n");

  const Ended wrong_option = scanloom("config --paramters");
  EXPECT_EQ(wrong_option.status, 2);
  EXPECT_EQ(wrong_option.output,
            "scanloom config: unknown argument --paramters: did you mean '--parameters'?\n"
            "'scanloom config --help' lists all arguments\n");

  EXPECT_THAT(scanloom("frobnicate").output, testing::HasSubstr("verbs are record, info, "));
  EXPECT_THAT(scanloom("edit /dev/null").output, testing::HasSubstr("a file is given as -i FILE"));

  EXPECT_EQ(scanloom("").status, 2);
  EXPECT_EQ(scanloom("config").status, 2);
  EXPECT_EQ(scanloom("config --default").status, 2);
}

TEST(Executable, namesTheVerbsThatHaveParameters)
{
  const Ended ended = scanloom("config --default nonsense");

  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.output, StartsWith("scanloom config: --default nonsense: is no verb with parameters"));
}

TEST(Executable, keepsResultsOnStdoutAndMessagesOnStderr)
{
  EXPECT_THAT(scanloom("config --parameters", "2>/dev/null").output, StartsWith("# Parameters\n"));
  EXPECT_EQ(scanloom("config --parameters", "2>&1 >/dev/null").output, "");
  EXPECT_EQ(scanloom("config --default nonsense", "2>/dev/null").output, "");
}

TEST(Executable, wroteThePagesOfParametersInTheManual)
{
  for (const std::string name : {"parameters", "laboratory_parameters"})
  {
    std::ifstream page(SCANLOOM_SOURCE_DIR "/doc/" + name + ".md");
    const std::string command = "config --parameters" + std::string(name == "parameters" ? "" : " laboratory");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(page), {}), scanloom(command).output)
        << "mend it by: scanloom " << command << " > doc/" << name << ".md";
  }
}

TEST(Executable, namesTenKeysFirstInTheManual)
{
  const std::string page = scanloom("config --parameters").output;
  const std::string head = page.substr(0, page.find("| verb |"));
  EXPECT_EQ(std::count(head.begin(), head.end(), '`') / 2 - 4, 10) << head;
}

TEST(Executable, mindsNoClosedStandardStream)
{
  EXPECT_EQ(scanloom("config --parameters", "<&-").status, 0);
  EXPECT_EQ(scanloom("config --parameters", ">&-").status, 0);
  EXPECT_EQ(scanloom("config --parameters", "2>&-").status, 0);
}

TEST(Executable, saysThatStdoutIsFull)
{
  const Ended ended = scanloom("config --parameters", "2>&1 >/dev/full");

  EXPECT_EQ(ended.status, 1);
  EXPECT_EQ(ended.output, "scanloom config: stdout cannot be written\n");
}
}  // namespace
}  // namespace scanloom::main_unittest
