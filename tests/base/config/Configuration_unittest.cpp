#include "base/config/Configuration.h"

#include "support/TemporaryFolder.h"
#include "support/with.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>

namespace scanloom::configuration_unittest
{
namespace
{
using testing::ElementsAre;

struct NdtOptions
{
  double cell_size = 1.0;
  double overlap = 0.3;
  int neighbours = 27;
  bool fine = true;
  std::string method = "d2d";

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.cell_size, Field{"cell_size", "m", "edge of a cell", above(0)});
    visit(o.overlap, Field{"overlap", "", "least share of cells that must meet", between(0, 1)});
    visit(o.neighbours, Field{"neighbours", "", "cells looked at", between(1, 27)});
    visit(o.fine, Field{"fine", "", "align a second time with small cells"});
    visit(o.method, Field{"method", "", "objective"});
  }
};

struct LidarOptions
{
  double min_range = 0.5;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.min_range, Field{"min_range", "m", "points nearer than this are dropped", atLeast(0)});
  }
};

struct TestSettings
{
  NdtOptions ndt;
  std::array<LidarOptions, 2> lidars;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.ndt, Section{"ndt", "registration"});
    visit(s.lidars[0], Section{"lidars", "the two lidars", "lidar1_"});
    visit(s.lidars[1], Section{"lidars", "the two lidars", "lidar2_"});
  }
};

Configuration from(const std::string& text) { return Configuration::fromText(text, "harvester.ini"); }

template <typename Action>
std::vector<std::string> problemsOf(Action&& action)
{
  try
  {
    action();
  }
  catch (const ConfigError& e)
  {
    return e.problems;
  }
  return {};
}

std::vector<std::string> problemsOfSettings(const std::string& text)
{
  return problemsOf([&] { readSettings<TestSettings>(from(text), schemaOf<TestSettings>()); });
}

std::string problemOfNdt(const std::string& line)
{
  const auto problems = problemsOf([&] { from("[ndt]\n" + line + "\n").read<NdtOptions>("ndt"); });
  return problems.empty() ? "" : problems.front();
}

struct ConfigurationFiles : testing::Test
{
  TemporaryFolder workplace;
  std::filesystem::path folder = workplace.path();

  std::filesystem::path write(const std::string& name, const std::string& text)
  {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
};

TEST(Configuration, overwritesTheDefaultsWithWhatIsThere)
{
  const auto options = from("[NDT]\nCell_Size = 2.5 // m\nneighbours = $eval{3*3}\nfine = No\nmethod = p2d\n")
                           .read<NdtOptions>("ndt", with(&NdtOptions::overlap, 0.5));

  EXPECT_EQ(options.cell_size, 2.5);
  EXPECT_EQ(options.overlap, 0.5);
  EXPECT_EQ(options.neighbours, 9);
  EXPECT_FALSE(options.fine);
  EXPECT_EQ(options.method, "p2d");
}

TEST(Configuration, readsTheSameOptionsUnderSeveralPrefixes)
{
  const auto settings = readSettings<TestSettings>(from("[lidars]\nlidar2_min_range = 3\n"), schemaOf<TestSettings>());

  EXPECT_EQ(settings.lidars[0].min_range, 0.5);
  EXPECT_EQ(settings.lidars[1].min_range, 3.0);
}

TEST(Configuration, saysPlaceUnitBoundsAndMeaningOfAValueOutOfBounds)
{
  EXPECT_EQ(problemOfNdt("cell_size = -1"), "harvester.ini:2: [ndt] cell_size = -1 m: must be > 0 (edge of a cell)");
  EXPECT_EQ(problemOfNdt("cell_size = 0"), "harvester.ini:2: [ndt] cell_size = 0 m: must be > 0 (edge of a cell)");
  EXPECT_EQ(problemOfNdt("overlap = 1.1"),
            "harvester.ini:2: [ndt] overlap = 1.1: must be between 0 and 1 (least share of cells that must meet)");
  EXPECT_EQ(problemOfNdt("neighbours = 28"),
            "harvester.ini:2: [ndt] neighbours = 28: must be between 1 and 27 (cells looked at)");
}

TEST(Configuration, saysWhatTypeAValueMustHave)
{
  EXPECT_EQ(problemOfNdt("cell_size = 1 m"),
            "harvester.ini:2: [ndt] cell_size = 1 m m: must be a number (edge of a cell)");
  EXPECT_EQ(problemOfNdt("cell_size ="),
            "harvester.ini:2: [ndt] cell_size = (nothing) m: must be a number (edge of a cell)");
  EXPECT_EQ(problemOfNdt("cell_size = 1 # m"),
            "harvester.ini:2: [ndt] cell_size = 1 # m m: must be a number (a comment behind a value begins with ' //') "
            "(edge of a cell)");
  EXPECT_EQ(problemOfNdt("neighbours = 1.5"),
            "harvester.ini:2: [ndt] neighbours = 1.5: must be a whole number (cells looked at)");
  EXPECT_EQ(problemOfNdt("fine = maybe"),
            "harvester.ini:2: [ndt] fine = maybe: must be true, false, yes, no, 1 or 0 (align a second time with small "
            "cells)");
}

TEST(Configuration, acceptsNoNumberThatIsNotFinite)
{
  for (const char* text : {"nan", "inf", "1e999", "0x10", "--1", "+-1"})
    EXPECT_NE(problemOfNdt(std::string("cell_size = ") + text), "") << text;
  EXPECT_EQ(problemOfNdt("cell_size = +1.5e-1"), "");
}

TEST(Configuration, acceptsNoNumberWithoutMeaning)
{
  for (const char* text : {"1e300", "-1e10", "1e-300"})
    EXPECT_NE(problemOfNdt(std::string("cell_size = ") + text), "") << text;
  EXPECT_EQ(problemOfNdt("cell_size = 1e-9"), "");
}

struct BoxOptions
{
  double low = -4, high = 10;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.low, Field{"low", "m", "rear"});
    visit(o.high, Field{"high", "m", "front"});
  }
  template <typename Self, typename Visitor>
  static void order(const Self& o, Visitor&& visit)
  {
    visit("low", o.low, "high", o.high);
  }
};

TEST(Configuration, namesTheLimitsThatAreInTheWrongOrder)
{
  const auto problems = [](const std::string& text)
  { return problemsOf([&] { from(text).read<BoxOptions>("crop", {}, "lidar1_"); }); };
  EXPECT_THAT(problems("[crop]\nlidar1_low = 20\n"),
              ElementsAre("harvester.ini:2: [crop] lidar1_low = 20: must be <= lidar1_high = 10"));
  EXPECT_THAT(problems("[crop]\n\nlidar1_high = -5\n"),
              ElementsAre("harvester.ini:3: [crop] lidar1_low = -4: must be <= lidar1_high = -5"));
  EXPECT_THAT(problems("[crop]\nlidar1_low = 10\n"), ElementsAre());
}

TEST(Configuration, reportsAllProblemsTogether)
{
  EXPECT_THAT(
      problemsOfSettings("[ndt]\ncell_size = -1\nneighbours = x\ncel_size = 1\n[lidars]\nlidar1_min_range = -2\n"),
      ElementsAre("harvester.ini:2: [ndt] cell_size = -1 m: must be > 0 (edge of a cell)",
                  "harvester.ini:3: [ndt] neighbours = x: must be a whole number (cells looked at)",
                  "harvester.ini:6: [lidars] lidar1_min_range = -2 m: must be >= 0 (points nearer than this are "
                  "dropped)",
                  "harvester.ini:4: [ndt] cel_size is an unknown key: did you mean 'cell_size'?"));
}

TEST(Configuration, namesTheNearestKey)
{
  EXPECT_THAT(problemsOfSettings("[ndt]\nneigbors = 7\n"),
              ElementsAre("harvester.ini:2: [ndt] neigbors is an unknown key: did you mean 'neighbours'?"));
  EXPECT_THAT(problemsOfSettings("[lidars]\nvoxel_volume_of_everything = 7\n"),
              ElementsAre("harvester.ini:2: [lidars] voxel_volume_of_everything is an unknown key: known are "
                          "'lidar1_min_range' and 'lidar2_min_range'"));
}

TEST(Configuration, namesTheNearestSectionOnce)
{
  EXPECT_THAT(problemsOfSettings("[nfdt]\ncell_size = 1\noverlap = 1\n"),
              ElementsAre("harvester.ini:2: [nfdt] is an unknown section: did you mean 'ndt'?"));
}

TEST(Configuration, saysOfARemovedKeyOrSectionThatItIsAConstantNow)
{
  const std::string is_constant = " is a constant now, no key: leave it out";
  EXPECT_THAT(problemsOfSettings("[smoother]\nwindow = 8\n"), ElementsAre("harvester.ini:2: [smoother]" + is_constant));
  EXPECT_THAT(problemsOfSettings("[lidars]\nlidar2_min_range = 1\nqueue_packets = 7\n"),
              ElementsAre("harvester.ini:3: [lidars] queue_packets" + is_constant));
}

TEST(Configuration, leavesSensorsAndTheGrabbersSectionToMrpt)
{
  EXPECT_THAT(
      problemsOfSettings("[global]\nGRABBER_PERIOD_MS = 200\n[left]\ndriver = CMultiLidarSensor\nprocess_rate = 9\n"),
      ElementsAre());
  EXPECT_TRUE(from("[left]\ndriver = CMultiLidarSensor\n").isSensor("left"));
}

TEST_F(ConfigurationFiles, areReadTogether)
{
  const auto configuration =
      Configuration::fromFiles({write("a.ini", "[ndt]\ncell_size = 2\n"), write("b.ini", "[ndt]\noverlap = 0.5\n")});

  EXPECT_EQ(configuration.text("ndt", "cell_size"), "2");
  EXPECT_EQ(configuration.place("ndt", "overlap").file, (folder / "b.ini").string());
  EXPECT_THAT(configuration.sections(), ElementsAre("ndt"));
  EXPECT_THAT(configuration.keys("NDT"), ElementsAre("cell_size", "overlap"));
}

TEST_F(ConfigurationFiles, mayGiveOneValueTwice)
{
  const auto a = write("a.ini", "[ndt]\ncell_size = 2\n"), b = write("b.ini", "[NDT]\nCELL_SIZE = 2\n");
  EXPECT_EQ(Configuration::fromFiles({a, b}).text("ndt", "cell_size"), "2");
}

TEST_F(ConfigurationFiles, refuseTwoValuesOfAKeyNamingBothPlaces)
{
  const auto a = write("a.ini", "[ndt]\ncell_size = 2\n");
  const auto b = write("b.ini", "[NDT]\n\nCELL_SIZE = 3\n");

  EXPECT_THAT(problemsOf(
                  [&] {
                    Configuration::fromFiles({a, b});
                  }),
              ElementsAre(b.string() + ":3: [NDT] CELL_SIZE = 3: is already set to 2 at " + a.string() + ":2"));
}

TEST_F(ConfigurationFiles, areAllNamedIfTheyAreMissing)
{
  EXPECT_THAT(problemsOf(
                  [&] {
                    Configuration::fromFiles({"no/such.ini", folder, "nor/this.ini"});
                  }),
              ElementsAre("no/such.ini: cannot be read: No such file or directory",
                          folder.string() + ": is a folder, not a file",
                          "nor/this.ini: cannot be read: No such file or directory"));
}

TEST_F(ConfigurationFiles, startRelativePathsAtTheirOwnFolder)
{
  std::filesystem::create_directory(folder / "rig");
  const auto file = write("rig/paths.ini",
                          "[ndt]\n"
                          "lidar1_map = maps/a.ply\n"
                          "lidar7_map = ../b.ply\n"
                          "lidar1_label = maps/a.ply\n"
                          "lidar2_map = $env{SCANLOOM_TEST_FOLDER}/c.ply\n"
                          "lidar3_map = /d.ply\n"
                          "lidar4_map = e.ply\n");
  setenv("SCANLOOM_TEST_FOLDER", "here", 1);
  Configuration configuration = Configuration::fromFiles({file});
  unsetenv("SCANLOOM_TEST_FOLDER");
  configuration.set("ndt.lidar4_map=f.ply");

  const Field map{"lidar1_map", "", "", unbounded(), pathFrom}, label{"lidar1_label", "", ""};
  configuration.makePathsAbsolute({{"ndt", ""}, {{map, "text", ""}, {label, "text", ""}}, "lidar"});

  const auto here = std::filesystem::current_path();
  const auto value = [&](const char* key) { return std::filesystem::path(configuration.text("ndt", key)); };
  EXPECT_EQ(value("lidar1_map"), file.parent_path() / "maps/a.ply");
  EXPECT_EQ(value("lidar7_map"), file.parent_path().parent_path() / "b.ply");
  EXPECT_EQ(value("lidar1_label"), "maps/a.ply");
  EXPECT_EQ(value("lidar2_map"), here / "here/c.ply");
  EXPECT_EQ(value("lidar3_map"), "/d.ply");
  EXPECT_EQ(value("lidar4_map"), here / "f.ply");
}

TEST(CommandLine, replacesTheValueOfAFile)
{
  Configuration configuration = from("[ndt]\ncell_size = 2\n");
  configuration.set("ndt.cell_size = 3");
  configuration.set("ndt.coarse.cell_size=4");

  EXPECT_EQ(configuration.read<NdtOptions>("ndt").cell_size, 3);
  EXPECT_EQ(configuration.read<NdtOptions>("ndt.coarse").cell_size, 4);
  EXPECT_EQ(toString(configuration.place("ndt", "cell_size")), "--set");
}

TEST(CommandLine, isCheckedLikeAFile)
{
  Configuration configuration = from("");
  configuration.set("ndt.cell_size=0");
  configuration.set("ndt.cel_size=1");

  EXPECT_THAT(problemsOf([&] { readSettings<TestSettings>(configuration, schemaOf<TestSettings>()); }),
              ElementsAre("--set: [ndt] cell_size = 0 m: must be > 0 (edge of a cell)",
                          "--set: [ndt] cel_size is an unknown key: did you mean 'cell_size'?"));
}

TEST(CommandLine, refusesWhatIsNoAssignment)
{
  for (const char* assignment : {"cell_size=3", "ndt.cell_size", "ndt.=3", ".cell_size=3", ""})
    EXPECT_THAT(problemsOf([&] { from("").set(assignment); }),
                ElementsAre(std::string("--set ") + assignment + ": must be section.key=value"));
}

TEST(CommandLine, refusesTheSameKeyTwice)
{
  Configuration configuration = from("");
  configuration.set("ndt.cell_size=3");

  EXPECT_THAT(problemsOf([&] { configuration.set("ndt.Cell_Size=4"); }),
              ElementsAre("--set ndt.Cell_Size: is given twice on the command line"));
}

TEST(Configuration, namesTheNearestKeyWhenASingleOneIsMissing)
{
  const Configuration configuration = from("[sensor]\ndriver = CMultiLidarSensor\npcap_inputs = a.pcap\n");

  EXPECT_THAT(problemsOf([&] { configuration.text("sensor", "pcap_input"); }),
              ElementsAre("[sensor] pcap_input: is not set: did you mean 'pcap_inputs'?"));
}

TEST(Configuration, writesWhatIsInEffectSoThatItCanBeRunAgain)
{
  Configuration configuration = from("[lidars]\nlidar1_min_range = 3\n[left]\ndriver = CMultiLidarSensor\n");
  configuration.set("ndt.overlap=0.5");
  const auto settings = readSettings<TestSettings>(configuration, schemaOf<TestSettings>());

  const std::string written = toIni(schemaOf(settings), configuration);

  EXPECT_EQ(written,
            "[ndt]\n"
            "# default\ncell_size = 1\n"
            "# --set\noverlap = 0.5\n"
            "# default\nneighbours = 27\n"
            "# default\nfine = true\n"
            "# default\nmethod = d2d\n"
            "[lidars]\n"
            "# harvester.ini:2\nlidar1_min_range = 3\n"
            "# default\nlidar2_min_range = 0.5\n"
            "[left]\n"
            "# harvester.ini:4\ndriver = CMultiLidarSensor\n");
  EXPECT_EQ(readSettings<TestSettings>(from(written), schemaOf<TestSettings>()).ndt.overlap, 0.5);
}

TEST(Configuration, lendsItsWordsToTheChecksOfAVerb)
{
  const Configuration configuration = from("[ndt]\ncell_size = 3\n");

  EXPECT_STREQ(configuration.invalidValue("ndt", "cell_size", "must divide 10").what(),
               "harvester.ini:2: [ndt] cell_size = 3: must divide 10");
  EXPECT_STREQ(configuration.invalidValue("ndt", "overlap", "must divide 10").what(),
               "[ndt] overlap is not set: must divide 10");
}
}  // namespace
}  // namespace scanloom::configuration_unittest
