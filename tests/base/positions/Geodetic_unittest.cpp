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
