// `scanloom site` on drives through stands of stems.
#include "site/DriveOfStems.h"

#include "support/TemporaryFolder.h"
#include "support/runProgram.h"

#include <gmock/gmock.h>

#include <fstream>

namespace scanloom::site_verb_unittest
{
namespace
{
using testing::HasSubstr;

struct SiteVerb : testing::Test
{
  TemporaryFolder folder;

  Ended site(const std::string& arguments) const
  {
    return runProgram("cd " + folder.path().string() + " && " SCANLOOM_BIN_DIR "/scanloom site " + arguments +
                      " --out-dir forest 2>&1 </dev/null");
  }

  void drive(const std::string& name, const std::vector<Rigid>& poses, unsigned stand = 1) const
  {
    DriveOfStems{poses}.write(folder / name, StandOfStems(stand));
  }

  bool has(const std::string& name) const { return std::filesystem::exists(folder / "forest" / name); }
};
}  // namespace

TEST_F(SiteVerb, joinsTwoDrivesAndWritesAMapOfBoth)
{
  drive("monday", straight(-10, 0, 4));
  drive("tuesday", straight(-4, 2, 3));
  const Ended ended = site("monday tuesday");
  ASSERT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("9 keyframes, "));
  for (const char* name : {"keyframes.simplemap", "drives/monday.tum", "drives/tuesday.tum", "loops.csv",
                           "tiles/0_0.bt", "gone.csv", "site.png", "site.json"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_FALSE(has("pieces"));
}

TEST_F(SiteVerb, namesThePiecesThatHaveNoPlaceInCommon)
{
  drive("monday", straight(-10, 0, 3));
  drive("elsewhere", straight(-10, 0, 1), 2);
  const Ended ended = site("monday elsewhere");
  EXPECT_EQ(ended.status, 3) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("1: 4 keyframes: monday"));
  EXPECT_THAT(ended.output, HasSubstr("2: 2 keyframes: elsewhere"));
  EXPECT_TRUE(has("pieces/2.simplemap"));
}

TEST_F(SiteVerb, saysThatAReferenceIsNotUsed)
{
  drive("monday", straight(-10, 0, 3));
  std::ofstream(folder / "station.csv") << "t,x,y,z\n1000,1,2,3\n1010,5,2,3\n";
  const Ended few = site("monday --reference station.csv --lever-arm '0 0 2'");
  EXPECT_EQ(few.status, 3) << few.output;
  EXPECT_THAT(few.output, HasSubstr("references are not used"));
  std::ofstream(folder / "station.csv") << "t,x,y,z\n1,1,2,3\n";
  EXPECT_THAT(site("-w monday --reference station.csv --lever-arm '0 0 2'").output,
              HasSubstr("no reference has a time in common"));
}

TEST_F(SiteVerb, refusesWhatCannotBeMeant)
{
  drive("monday", straight(-10, 0, 1));
  std::ofstream(folder / "station.csv") << "t,x,y,z\n1000,1,2,3\n";
  std::ofstream(folder / "gnss.csv") << "t,lat,lon,height\n1000,62,25,3\n";
  EXPECT_THAT(site("monday --reference station.csv").output, HasSubstr("--lever-arm"));
  EXPECT_THAT(site("monday ./monday").output, HasSubstr("is given twice"));
  EXPECT_THAT(site("monday --lever-arm '0 0 2' --reference station.csv --reference gnss.csv").output,
              HasSubstr("different frames"));
  DriveOfStems{straight(-10, 0, 1), Timestamp{1'750'100'000s}}.write(folder / "later", StandOfStems());
  DriveOfStems{straight(-10, 0, 1), Timestamp{1'750'000'000s}}.write(folder / "earlier", StandOfStems());
  EXPECT_THAT(site("later earlier").output, HasSubstr("earlier was driven before later"));
  EXPECT_THAT(site("monday --crs EPSG:3067").output, HasSubstr("without --reference nothing says where"));
  EXPECT_THAT(site("monday --lever-arm '0 0 2' --reference station.csv --crs EPSG:3067").output,
              HasSubstr("x and y of station.csv are not in it"));
  const Ended no_drive = site(".");
  EXPECT_EQ(no_drive.status, 1);
  EXPECT_THAT(no_drive.output, HasSubstr("has no keyframes.simplemap"));
  EXPECT_FALSE(has("site.json"));
}
}  // namespace scanloom::site_verb_unittest
