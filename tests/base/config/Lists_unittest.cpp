/** Options structs of which a section holds any number: lidar1_, lidar2_, ... */
#include "base/config/Configuration.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

namespace scanloom::lists_unittest
{
namespace
{
using testing::HasSubstr;

struct SeatOptions
{
  std::string name;
  double height = 2;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.name, Field{"name", "", "what it is called"});
    visit(o.height, Field{"height", "m", "above the ground", above(0)});
  }
};

struct SeatSettings
{
  std::vector<SeatOptions> seats{{"left", 3}, {"right", 4}};

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.seats, Section{"seats", "where they are", "seat"});
  }
};

std::vector<SeatOptions> seatsFrom(const std::string& text)
{
  return readSettings<SeatSettings>(Configuration::fromText(text, "x.ini"), schemaOf<SeatSettings>()).seats;
}

std::string problemOf(const std::string& text)
{
  return messageOf<ConfigError>([&] { seatsFrom(text); });
}
}  // namespace

TEST(Lists, areTheDefaultsWhereNothingHasAName)
{
  EXPECT_EQ(seatsFrom("").size(), 2u);
  const auto seats = seatsFrom("[seats]\nseat2_height = 9\n");
  ASSERT_EQ(seats.size(), 2u);
  EXPECT_EQ(seats[1].name, "right");
  EXPECT_EQ(seats[1].height, 9);
}

TEST(Lists, areAsLongAsThereAreNames)
{
  EXPECT_EQ(seatsFrom("[seats]\nseat1_name = only\n").size(), 1u);
  const auto seats = seatsFrom("[seats]\nseat1_name = a\nseat2_name = b\nseat3_name = c\nseat3_height = 7\n");
  ASSERT_EQ(seats.size(), 3u);
  EXPECT_EQ(seats[0].height, 3) << "the default of its place";
  EXPECT_EQ(seats[2].height, 7);
}

TEST(Lists, refuseNumbersWithoutNameAndKeysThatNoElementHas)
{
  EXPECT_THAT(problemOf("[seats]\nseat3_height = 1\n"), HasSubstr("seat3_height: number 3 is missing"));
  EXPECT_THAT(problemOf("[seats]\nseat1_name = a\nseat3_name = c\n"), HasSubstr("seat3_name: number 2 is missing"));
  EXPECT_THAT(problemOf("[seats]\nseat2_hight = 1\n"), HasSubstr("seat2_hight"));
  EXPECT_THAT(problemOf("[seats]\nseat2_height = -1\n"), HasSubstr("must be > 0"));
}

TEST(Lists, areReadBackFromWhatIsWritten)
{
  SeatSettings settings;
  settings.seats = {{"a", 1}, {"b", 2}, {"c", 5}};
  const auto seats = seatsFrom(toIni(schemaOf(settings)));
  ASSERT_EQ(seats.size(), 3u);
  EXPECT_EQ(seats[2].height, 5);
}
}  // namespace scanloom::lists_unittest
