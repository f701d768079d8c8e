/** The frame around every verb, tried with a verb of its own. */
#include "Program.h"

#include "Settings.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace scanloom::program_unittest
{
namespace
{
struct WeavingOptions
{
  double cell_size = 1.0;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.cell_size, Field{"cell_size", "m", "edge of a cell", above(0)});
  }
};

template <int kSection>
struct WeavingSettings
{
  WeavingOptions weaving;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.weaving, Section{kSection == 0 ? "weaving" : "knitting", "of scans"});
  }
};

struct WeaveArguments
{
  ConfigurationArguments configuration;
  OutputFolderArguments output;
  std::uint64_t seed = 1;
  int jobs = 0;
  bool json = false;
  std::string failure;
  double speed = 1;
  std::optional<double> share;
  std::optional<std::uint64_t> first;
};

WeaveArguments g_parsed;  // what the latest run was given

int weave(const WeaveArguments& arguments)
{
  g_parsed = arguments;
  const auto loaded = load<WeavingSettings<0>>(arguments.configuration);
  refuseExisting(arguments.output, {"scan.txt"});
  if (arguments.configuration.dry_run)
  {
    std::cout << toIni(loaded);
    return kDone;
  }
  if (!arguments.failure.empty()) throw std::runtime_error(arguments.failure);
  return kQualityGate;
}

std::function<int()> addWeave(CLI::App& app)
{
  auto arguments = std::make_shared<WeaveArguments>();
  addConfiguration(app, arguments->configuration);
  addOutputFolder(app, arguments->output);
  addDryRun(app, arguments->configuration);
  addOption(app, "--seed", arguments->seed, "of the yarn");
  addOption(app, "--jobs", arguments->jobs, "looms").notNegative();
  addJson(app, arguments->json);
  addOption(app, "--fail", arguments->failure, "an error");
  addOption(app, "--speed", arguments->speed, "of the loom").positive();
  addOption(app, "--share", arguments->share, "of the yarn").between(0, 1);
  addOption(app, "--first", arguments->first, "thread");
  return [arguments] { return weave(*arguments); };
}

struct Ended
{
  int status;
  std::string results;
  std::string messages;
};

Ended run(std::vector<const char*> arguments)
{
  arguments.insert(arguments.begin(), "scanloom");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = runProgram(static_cast<int>(arguments.size()), arguments.data());
  return {status, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

struct Program : testing::Test
{
  TemporaryFolder workplace;
  std::filesystem::path folder = workplace.path();

  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
};

TEST_F(Program, passesOnTheStatusOfTheVerb) { EXPECT_EQ(run({"weave"}).status, kQualityGate); }

TEST_F(Program, givesTheSharedOptionsToTheVerb)
{
  const std::string a = write("a.ini", "[weaving]\ncell_size = 2\n");
  const std::string b = write("b.ini", "[knitting]\ncell_size = 3\n");
  run({"weave", "-c", a.c_str(), "--config", b.c_str(), "--seed", "7", "--jobs", "2", "--json", "-w", "--out-dir",
       "x"});

  EXPECT_THAT(g_parsed.configuration.files, testing::ElementsAre(a, b));
  EXPECT_EQ(g_parsed.seed, 7U);
  EXPECT_EQ(g_parsed.jobs, 2);
  EXPECT_TRUE(g_parsed.json);
  EXPECT_TRUE(g_parsed.output.overwrite);
  EXPECT_EQ(g_parsed.output.folder, "x");
}

TEST_F(Program, printsWhatWouldRun)
{
  const Ended ended = run({"weave", "--dry-run", "--set", "weaving.cell_size=2.5"});

  EXPECT_EQ(ended.status, kDone);
  EXPECT_EQ(ended.results, "[weaving]\n# --set\ncell_size = 2.5\n");
}

TEST_F(Program, acceptsTheSectionsOfOtherVerbsButNoOthers)
{
  const std::string file = write("a.ini", "[knitting]\ncell_size = 2\n[weving]\ncell_size = 3\n");
  const Ended ended = run({"weave", "-c", file.c_str()});

  EXPECT_EQ(ended.status, kWrongUsage);
  EXPECT_EQ(ended.messages, file + ":4: [weving] is an unknown section: did you mean 'weaving'?\n");
}

TEST_F(Program, endsWithTwoIfAnOutputExists)
{
  const std::string existing = write("scan.txt", "");
  const Ended ended = run({"weave", "--out-dir", folder.c_str()});

  EXPECT_EQ(ended.status, kWrongUsage);
  EXPECT_EQ(ended.messages, "scanloom weave: " + existing + " exists already: give -w to overwrite\n");
  EXPECT_EQ(run({"weave", "--out-dir", folder.c_str(), "-w"}).status, kQualityGate);
  EXPECT_EQ(run({"weave", "--out-dir", existing.c_str()}).messages,
            "scanloom weave: --out-dir " + existing + ": exists and is not a folder\n");
}

TEST_F(Program, saysInOneLineWhatFailed)
{
  const Ended ended =
      run({"weave", "--fail", "\n==== MRPT exception ====\nMessage:  no packets\nCall stack:\n[0] 0x1\n"});

  EXPECT_EQ(ended.status, kFailed);
  EXPECT_EQ(ended.messages, "scanloom weave: no packets\n");
}

TEST_F(Program, suggestsTheNearestOptionOfTheVerb)
{
  const Ended ended = run({"weave", "--confg", "a.ini"});

  EXPECT_EQ(ended.status, kWrongUsage);
  EXPECT_EQ(ended.messages,
            "scanloom weave: unknown argument --confg: did you mean '--config'?\n"
            "'scanloom weave --help' lists all arguments\n");
}

TEST_F(Program, saysWhichValuesAnOptionTakes)
{
  const Ended ended = run({"weave", "--jobs", "many"});

  EXPECT_EQ(ended.status, kWrongUsage);
  EXPECT_THAT(ended.messages, testing::HasSubstr("--jobs"));
  EXPECT_THAT(ended.messages, testing::HasSubstr("many"));
}

TEST_F(Program, takesNoNumberThatIsNone)
{
  const std::vector<std::pair<const char*, const char*>> values{
      {"--jobs", "many"}, {"--jobs", "-1"},     {"--jobs", "1.5"}, {"--seed", "-1"},   {"--speed", "nan"},
      {"--speed", "inf"}, {"--speed", "1e999"}, {"--speed", "-2"}, {"--share", "nan"}, {"--first", "-1"},
  };
  for (const auto& [option, value] : values)
  {
    const Ended ended = run({"weave", option, value});
    EXPECT_EQ(ended.status, kWrongUsage) << option << ' ' << value;
    EXPECT_THAT(ended.messages, testing::HasSubstr(option));
    EXPECT_THAT(ended.messages, testing::HasSubstr(std::string("'") + value + "' must be "));
    EXPECT_LT(ended.messages.size(), 200U) << "no limit of 309 digits";
  }
  EXPECT_EQ(run({"weave", "--speed", "1e-3", "--share", "0.5", "--first", "0"}).status, kQualityGate);
}

TEST_F(Program, writesTheDefaultsOfAVerb)
{
  EXPECT_EQ(run({"config", "--default", "weave"}).results,
            "# of scans\n[weaving]\n# edge of a cell [m], > 0\ncell_size = 1\n");
  EXPECT_EQ(run({"config", "--default", "weeve"}).messages,
            "scanloom config: --default weeve: is no verb with parameters; did you mean 'weave'?\n");
}

TEST_F(Program, helpOfAVerbIsWhatItsHelpOptionPrints)
{
  EXPECT_EQ(run({"help", "weave"}).results, run({"weave", "--help"}).results);
  EXPECT_EQ(run({"help"}).results, run({"--help"}).results);
  EXPECT_EQ(run({"help", "weeve"}).messages, "scanloom help: weeve: is no verb; did you mean 'weave'?\n");
}

TEST_F(Program, writesThePageOfAllParameters)
{
  const std::string page = run({"config", "--parameters"}).results;

  EXPECT_THAT(page, testing::HasSubstr("| `weave` | [weaving] |\n| `knit` | [knitting] |\n"));
  EXPECT_THAT(page, testing::HasSubstr("## [weaving]\n"));
  EXPECT_THAT(page, testing::HasSubstr("| `cell_size` | 1 | edge of a cell [m], > 0 |\n"));
}
}  // namespace
}  // namespace scanloom::program_unittest

namespace scanloom
{
Verb configVerb();

/** The program's table of verbs, which apps/scanloom/allVerbs.cpp has for users. */
const std::vector<Verb>& verbs()
{
  using namespace program_unittest;
  static const std::vector<Verb> table{
      {"weave", "a test's verb", schemaOf<WeavingSettings<0>>(), &addWeave},
      {"knit", "another one", schemaOf<WeavingSettings<1>>(), &addWeave},
      configVerb(),
  };
  return table;
}
}  // namespace scanloom
