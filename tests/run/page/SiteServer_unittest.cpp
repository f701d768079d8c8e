/** A site as browsers, and others, ask for it. */
#include "run/page/SiteServer.h"

#include "mrpt/maps/OctoMapFile.h"
#include "run/page/Asked.h"
#include "support/TemporaryFolder.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>

namespace scanloom::site_server_unittest
{
namespace
{
using testing::HasSubstr;
using testing::StartsWith;

struct SiteOnDisk : testing::Test
{
  TemporaryFolder folder;

  void SetUp() override
  {
    if (!pageIsThere()) GTEST_SKIP() << "three.js is not installed (libjs-three)";
    std::filesystem::create_directories(folder / "drives");
    std::filesystem::create_directories(folder / "tiles");
    std::ofstream(folder / "site.json")
        << R"({"drives": [{"name": "monday"}], "tiles": ["-1_0"], "tile_edge": 51.2, "pieces": [{}]})";
    std::ofstream(folder / "loops.csv") << "from_drive\n";
    std::ofstream(folder / "drives" / "monday.tum") << "1 2 3 4 0 0 0 1\n";
    octomap::OcTree tree(0.2);
    tree.updateNode(octomap::point3d(-50.1F, 1.1F, 400.1F), true);
    writeBinaryOctoMap(folder / "tiles" / "-1_0.bt", tree);
  }

  std::string answer(const std::string& path) const
  {
    const SiteServer server(kAnyPort, folder.path());
    const std::string host = server.url().substr(7);
    return wholeAnswer(host, fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\n\r\n", path, host));
  }
};

std::string bodyOf(const std::string& answer) { return answer.substr(answer.find("\r\n\r\n") + 4); }
}  // namespace

TEST_F(SiteOnDisk, isAnsweredAsAPageWithItsTables)
{
  EXPECT_THAT(answer("/"), HasSubstr("site.js"));
  EXPECT_THAT(answer("/site.js"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(answer("/site.json"), HasSubstr("monday"));
  EXPECT_THAT(bodyOf(answer("/loops.csv")), "from_drive\n");
  EXPECT_THAT(bodyOf(answer("/drive?number=0")), "1 2 3 4 0 0 0 1\n");
}

TEST_F(SiteOnDisk, givesTheOccupiedVoxelsOfATile)
{
  const std::string bytes = bodyOf(answer("/tile?number=0"));
  ASSERT_EQ(bytes.size(), 3 * sizeof(double) + 3 * sizeof(std::int16_t));
  double origin[3];
  std::int16_t cm[3];
  std::memcpy(origin, bytes.data(), sizeof origin);
  std::memcpy(cm, bytes.data() + sizeof origin, sizeof cm);
  EXPECT_NEAR(origin[0] + 0.01 * cm[0], -50.1, 0.011);
  EXPECT_NEAR(origin[1] + 0.01 * cm[1], 1.1, 0.011);
  EXPECT_NEAR(origin[2] + 0.01 * cm[2], 400.1, 0.011);
}

TEST_F(SiteOnDisk, whatIsNotOfTheSiteIsNotThere)
{
  for (const char* path :
       {"/drive?number=1", "/tile?number=7", "/references.csv", "/../site.json", "/drives/monday.tum"})
    EXPECT_THAT(answer(path), StartsWith("HTTP/1.1 404")) << path;
  EXPECT_THAT(answer("/tile?number=a"), StartsWith("HTTP/1.1 400"));
}

TEST_F(SiteOnDisk, aDamagedSummaryIsNamed)
{
  std::ofstream(folder / "site.json") << "{";
  EXPECT_THAT(messageOf([&] { SiteServer(kAnyPort, folder.path()); }), HasSubstr("site.json: "));
}
}  // namespace scanloom::site_server_unittest
