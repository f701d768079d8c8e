#include "base/positions/Geodetic.h"

#include "base/positions/TotalStation.h"
#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

namespace scanloom::geodetic_unittest
{
namespace
{
const Geodetic kOrigin{62.2417, 25.7473, 141.5};

PositionFile read(const std::string& text, const std::optional<Geodetic>& origin = std::nullopt)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "gnss.csv") << text;
  return readPositionFile(folder / "gnss.csv", origin);
}
}  // namespace

TEST(Geodetic, aMinuteOfLatitudeIsANauticalMile)
{
  // Radius of curvature of the meridian at 62.24 deg: a (1 - e2) / (1 - e2 sin2)^1.5 = 6384.96 km (WGS84).
  const Eigen::Vector3d north = eastNorthUp({kOrigin.latitude + 1.0 / 60, kOrigin.longitude, kOrigin.height}, kOrigin);
  EXPECT_NEAR(north.y(), 6384960.0 * M_PI / 180 / 60, 1);
  EXPECT_NEAR(north.x(), 0, 1e-6);
  EXPECT_NEAR(north.z(), -std::pow(north.y(), 2) / (2 * 6.385e6), 0.01) << "the earth is round";
}

TEST(Geodetic, isFoundAgainFromThePlane)
{
  const Geodetic at{62.2519, 25.7312, 230};
  const Geodetic again = geodeticOf(eastNorthUp(at, kOrigin), kOrigin);
  EXPECT_NEAR(again.latitude, at.latitude, 1e-12);
  EXPECT_NEAR(again.longitude, at.longitude, 1e-12);
  EXPECT_NEAR(again.height, at.height, 1e-6);
}

/** EPSG:3067 is transverse Mercator about 27 deg with scale 0.9996 and a false easting of 500 km, on the ellipsoid
 * GRS80, whose meridian is 6,886,650.8 m long from the equator to 62 deg 5 min (series of Helmert). */
TEST(CountryGrid, hasEastAndNorthOfTheCountry)
{
  const CountryGrid finland("EPSG:3067");
  const auto meridian = [](double latitude)
  {
    constexpr double a = 6378137, f = 1 / 298.257222101, n = f / (2 - f);
    const double phi = latitude * M_PI / 180;
    return a / (1 + n) *
           ((1 + n * n / 4 + std::pow(n, 4) / 64) * phi - 1.5 * (n - n * n * n / 8) * std::sin(2 * phi) +
            15.0 / 16 * (n * n - std::pow(n, 4) / 4) * std::sin(4 * phi) - 35.0 / 48 * n * n * n * std::sin(6 * phi));
  };
  const Eigen::Vector3d on_meridian = finland.of({62.0833, 27, 100});
  EXPECT_NEAR(on_meridian.x(), 500000, 1e-3);
  EXPECT_NEAR(on_meridian.y(), 0.9996 * meridian(62.0833), 1e-2);
  EXPECT_NEAR(on_meridian.z(), 100, 1e-6);
  EXPECT_GT(finland.of({62.0833, 27.001, 100}).x(), 500050) << "x is east";
  EXPECT_THAT(finland.wkt(), testing::AllOf(testing::StartsWith("PROJCS["), testing::HasSubstr("3067")));
}

TEST(CountryGrid, knowsWhereItReaches)
{
  const CountryGrid finland("EPSG:3067");
  EXPECT_TRUE(finland.reaches({433000, 6902000, 120}));
  EXPECT_FALSE(finland.reaches({512.3, -87.1, 44.2})) << "of a station in a frame of its own";
  EXPECT_FALSE(finland.reaches({6902000, 433000, 120})) << "x is east";
}

TEST(CountryGrid, refusesWhatIsNoGridOrNotExact)
{
  EXPECT_THAT(messageOf([] { CountryGrid("EPSG:1"); }), testing::HasSubstr("knows no such"));
  EXPECT_THAT(messageOf([] { CountryGrid("+proj=merc"); }), testing::HasSubstr("knows no such"));
  EXPECT_THAT(messageOf([] { CountryGrid("EPSG:4326"); }), testing::HasSubstr("no metres"));
  EXPECT_THAT(messageOf([] { CountryGrid("EPSG:3067+3900"); }), testing::HasSubstr("not installed"))
      << "heights of N2000";
}

TEST(PositionFile, saysHowWellEachPositionIsKnownAndOfWhichPoint)
{
  const PositionFile file = read("name;t;x;y;z;sigma [mm]\nP1;1;2;3;4;25\n;2;2;3;4;5\n");
  EXPECT_EQ(file.track[0].name, "P1");
  EXPECT_DOUBLE_EQ(file.track[0].sigma, 0.025);
  EXPECT_EQ(file.track[1].name, "");
  EXPECT_EQ(read("1,2,3,4\n").track[0].sigma, 0);
  EXPECT_THAT(messageOf([] { read("t,x,y,z,sigma\n1,2,3,4,0\n"); }), testing::HasSubstr("must be above 0"));
}

TEST(PositionFile, ofGnssIsEastNorthUpOfItsFirstFix)
{
  const PositionFile file = read("t,lat [deg],lon [deg],height [m]\n1,62.2417,25.7473,141.5\n2,62.2418,25.7473,142\n");
  ASSERT_TRUE(file.origin);
  EXPECT_NEAR(file.origin->latitude, 62.2417, 1e-12);
  EXPECT_LT(file.track[0].position.norm(), 1e-6);
  EXPECT_NEAR(file.track[1].position.y(), 11.14, 0.01);
  EXPECT_NEAR(file.track[1].position.z(), 0.5, 1e-3);
}

TEST(PositionFile, mayHaveItsHeaderInAComment)
{
  const PositionFile file = read("# of the receiver\n#t [s],lat [deg],lon [deg],height [m]\n1,62.2417,25.7473,141.5\n");
  EXPECT_TRUE(file.origin);
  EXPECT_FALSE(read("# t x and y of the prism\n1,2,3,4\n").origin);
}

TEST(PositionFile, ofGnssMayHaveTheOriginOfAnotherOne)
{
  const PositionFile file = read("t,latitude,longitude,alt\n1,62.2418,25.7473,141.5\n", kOrigin);
  EXPECT_NEAR(file.track[0].position.y(), 11.14, 0.01);
}

TEST(PositionFile, saysWhatIsNoPlaceOnEarth)
{
  EXPECT_THAT(messageOf([] { read("t,lat,lon,height\n1,25,162.2,1\n2,162.2,25,1\n"); }),
              testing::HasSubstr("gnss.csv:3: latitude 162.2"));
  EXPECT_THAT(messageOf([] { read("t,lat,lon\n1,2,3\n"); }), testing::HasSubstr("no column height"));
  EXPECT_THAT(messageOf([] { read("t,lat,y,z\n1,2,3,4\n"); }), testing::HasSubstr("which is it?"));
}
}  // namespace scanloom::geodetic_unittest
