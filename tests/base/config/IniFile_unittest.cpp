#include "base/config/internal/IniFile.h"

#include "base/core/ConfigError.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>

#include <cstdlib>
#include <fstream>
#include <map>

namespace scanloom::ini_file_unittest
{
namespace
{
using testing::AnyOf;
using testing::ElementsAre;

std::vector<std::string> problemsOf(const std::string& text)
{
  try
  {
    parseIni(text, "x.ini");
  }
  catch (const ConfigError& e)
  {
    return e.problems;
  }
  return {};
}

using Values = std::map<std::string, std::string>;  // "section key" -> value

Values ours(const std::string& text)
{
  Values values;
  for (const IniEntry& entry : parseIni(text, "x.ini")) values[entry.section + " " + entry.key] = entry.value;
  return values;
}

Values mrpts(const std::string& text)
{
  const TemporaryFolder folder;
  const auto file = folder / "dialect.ini";
  std::ofstream(file, std::ios::binary) << text;
  const mrpt::config::CConfigFile parsed(file.string());

  Values values;
  std::vector<std::string> sections, keys;
  parsed.getAllSections(sections);
  for (const auto& section : sections)
  {
    parsed.getAllKeys(section, keys);
    for (const auto& key : keys) values[section + " " + key] = parsed.read_string(section, key, "", true);
  }
  return values;
}

using Dialect = testing::TestWithParam<const char*>;

TEST_P(Dialect, givesTheValuesOfMrpt)
{
  ::setenv("SCANLOOM_TEST_FOLDER", "/data/drive 1", 1);

  EXPECT_EQ(ours(GetParam()), mrpts(GetParam()));
  EXPECT_FALSE(ours(GetParam()).empty());
}

INSTANTIATE_TEST_SUITE_P(IniFile, Dialect,
                         testing::Values("[a]\nk = 1\n[b]\nk=2\n",                          //
                                         "[ a ] // comment\n  k  =  x  y  \n",              //
                                         "# c\n; c\n // c\n[a] ; c\n # c\nk = 1 // two\n",  //
                                         "[a]\nk = 1 // b // c\nl = 1\t// tab\n",           //
                                         "[a]\nurl = http://host//path\n",                  //
                                         "[a]\nhash = 1 # two\nsemicolon = 1 ; two\n",      //
                                         "[a]\nk = b=c\nquoted = \"x y\"\nempty =\n",       //
                                         "[a]\nk = one \\\n  two\nl = 1\n",                 //
                                         "[a]\r\nk = 1 \\\r\n 2\r\nl = 3\r\n",              //
                                         "\xEF\xBB\xBF[a]\nk = 1\n",                        //
                                         "[a]\nk\\\ney = 7",                                //
                                         "# goes on \\\n[z]\n[a]\nk = 1\n",                 //
                                         "@define N 5\n[a]\nk = ${N}\nl = ${N}x${N}\n",     //
                                         "[a]\n  @define\tNAME left lidar \nk = ${NAME}.pcap\n",
                                         "@define A 5\n@define B $eval{A*2}\n[a]\nk = ${B}\nl = $eval{A+B*PI}\n",
                                         "[a]\nk = $eval{sqrt(2)} m\nl = [$eval{1/3} 0 0]\nm = $eval{1>0}\n",
                                         "[a]\nk = $env{SCANLOOM_TEST_FOLDER}/left.pcap\n",
                                         "@define F $env{SCANLOOM_TEST_FOLDER}\n[a]\nk = ${F}/left.pcap\n",
                                         "[a]\nk = 5 $ 5\nl = $x{y}\nm = {1}\n"));

TEST(IniFile, remembersFileAndLineOfEveryValue)
{
  const auto entries = parseIni("[a]\n\nk = 1 \\\n  2\nl = 3\n", "x.ini");

  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(toString(entries[0].place), "x.ini:3");
  EXPECT_EQ(toString(entries[1].place), "x.ini:5");
}

TEST(IniFile, namesAMissingEnvironmentVariable)
{
  ::unsetenv("SCANLOOM_TEST_MISSING");
  EXPECT_THAT(problemsOf("[sensor]\npcap_input = $env{SCANLOOM_TEST_MISSING}/a.pcap\n"),
              ElementsAre("x.ini:2: [sensor] pcap_input: the environment variable SCANLOOM_TEST_MISSING is not set"));
}

TEST(IniFile, namesTheNearestDefinition)
{
  EXPECT_THAT(problemsOf("@define RATE 10\n[a]\nk = ${RAET}\n"),
              ElementsAre("x.ini:3: [a] k: ${RAET} is not defined: did you mean 'RATE'?"));
  EXPECT_THAT(problemsOf("[a]\nk = ${RATE}\n"), ElementsAre("x.ini:2: [a] k: ${RATE} is not defined"));
}

TEST(IniFile, saysWhatIsWrongWithAFormula)
{
  EXPECT_THAT(problemsOf("[a]\nk = $eval{2*foo}\n"),
              ElementsAre(AnyOf("x.ini:2: [a] k: $eval{2*foo}: ERR201 - Undefined symbol: 'foo'",
                                "x.ini:2: [a] k: $eval{2*foo}: ERR232 - Undefined symbol: 'foo'")));
  EXPECT_THAT(problemsOf("@define NAME left\n[a]\nk = $eval{NAME+1}\n"),
              ElementsAre(AnyOf("x.ini:3: [a] k: $eval{NAME+1}: ERR201 - Undefined symbol: 'NAME'",
                                "x.ini:3: [a] k: $eval{NAME+1}: ERR232 - Undefined symbol: 'NAME'")));
}

TEST(IniFile, refusesAFormulaThatMayNeverEnd)
{
  EXPECT_THAT(
      problemsOf("[a]\nk = $eval{repeat 1; until (false)}\nl = $eval{While(1 > 0) 2}\n"),
      ElementsAre("x.ini:2: [a] k: $eval{repeat 1; until (false)}: 'repeat' is not allowed: a formula has no loops",
                  "x.ini:3: [a] l: $eval{While(1 > 0) 2}: 'While' is not allowed: a formula has no loops"));
}

TEST(IniFile, reportsAllProblemsOfAFile)
{
  EXPECT_THAT(problemsOf("k = 1\n[a\n[a]\nnonsense\n= 5\nl = ${X\n[b] c\n"),
              ElementsAre("x.ini:1: k stands before any [section]", "x.ini:2: '[a' lacks its closing ']'",
                          "x.ini:4: 'nonsense' must be 'key = value', '[section]' or a comment",
                          "x.ini:5: '= 5' must be 'key = value', '[section]' or a comment",
                          "x.ini:6: [a] l: '${X' lacks its closing '}'", "x.ini:7: 'c' behind a section's name"));
}

TEST(IniFile, refusesDefinitionsThatMrptWouldMisread)
{
  EXPECT_THAT(problemsOf("@define\n@define A\n"),
              ElementsAre("x.ini:1: must be '@define NAME value'", "x.ini:2: must be '@define NAME value'"));
  EXPECT_THAT(problemsOf("@define A 1\n@define A 2\n"), ElementsAre("x.ini:2: @define A: is already defined"));
  EXPECT_THAT(
      problemsOf("@define A 1 // one\n"),
      ElementsAre("x.ini:1: MRPT would take the comment for a part of the definition: write it on a line of its "
                  "own"));
  EXPECT_THAT(
      problemsOf("@define A 1\n@define B ${A}\n"),
      ElementsAre("x.ini:2: @define B: MRPT does not expand ${} within a definition: write $eval{} for a number, "
                  "or the text itself"));
}

TEST(IniFile, refusesCommentsThatMrptWouldTakeForTheValue)
{
  EXPECT_THAT(problemsOf("[a]\nk = // none\n"),
              ElementsAre("x.ini:2: [a] k: MRPT would take the comment for the value: write it on a line of its own"));
  EXPECT_THAT(problemsOf("[a]\nk = http://host // ours\n"),
              ElementsAre("x.ini:2: [a] k: behind a value that holds '//' MRPT takes a comment for a part of it: write "
                          "it on a line of its own"));
}
}  // namespace
}  // namespace scanloom::ini_file_unittest
