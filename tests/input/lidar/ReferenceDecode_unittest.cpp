/** The low-rate profile has no digests: its recording of three turns is checked against the maker's own decode of it.
 */
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>

#include "captures.h"
#include "support/FrameFields.h"

namespace scanloom::reference_decode_unittest
{
namespace
{
const std::string kName = "OS-1-128_v2.3.0_1024x10";
constexpr std::uint32_t kFirstTurn = 1795;

/** x, y, z of a binary ply that has nothing else. */
std::vector<Eigen::Vector3f> readPly(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::size_t count = 0;
  for (std::string line; std::getline(file, line) && line != "end_header";)
    if (line.rfind("element vertex ", 0) == 0) count = std::stoul(line.substr(15));
  std::vector<Eigen::Vector3f> points(count);
  file.read(reinterpret_cast<char*>(points.data()), static_cast<std::streamsize>(count * sizeof(Eigen::Vector3f)));
  return points;
}

std::vector<Eigen::Vector3f> pointsOfTurn(const OusterDecoder& decoder, const std::filesystem::path& capture,
                                          std::uint32_t frame_id)
{
  PointCloud cloud;
  std::vector<MeasurementBlock> blocks;
  for (const auto& packet : payloadsOf(capture))
  {
    if (decoder.kind(packet) != PacketKind::Lidar || decoder.header(packet).frame_id != frame_id) continue;
    decoder.readBlocks(packet, blocks);
    for (const MeasurementBlock& block : blocks) decoder.appendPoints(packet, block.index, 0, 0, cloud);
  }
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) points.push_back(cloud.position(i));
  return points;
}

/** How many of `points` have one of `others` within `radius` in every coordinate. */
std::size_t countFound(const std::vector<Eigen::Vector3f>& points, std::vector<Eigen::Vector3f> others, float radius)
{
  std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  const auto isFound = [&](const Eigen::Vector3f& p)
  {
    auto other = std::lower_bound(others.begin(), others.end(), p.x() - radius,
                                  [](const Eigen::Vector3f& o, float x) { return o.x() < x; });
    for (; other != others.end() && other->x() <= p.x() + radius; ++other)
      if ((*other - p).cwiseAbs().maxCoeff() <= radius) return true;
    return false;
  };
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), isFound));
}
}  // namespace

TEST(ReferenceDecode, lowRateFieldsEqualThoseOfTheMakersDecode)
{
  // From the PNG images that the maker's .osf file of this recording holds: unfiltered, staggered again by
  // pixel_shift_by_row, written in the fields' native types.
  struct Turn
  {
    std::string range, reflectivity, near_ir;
  };
  const std::map<std::string, Turn> expected{
      {"1795",
       {"17b04f169a54850cff3c97fce782d360", "3e1f0d8cf87a42013864a854492d9412", "ff191ba5c93bf57eca825fbe6ec4378c"}},
      {"1796",
       {"97af312c2c7f77cb219cbf399bde3455", "6bdd4629244960e211ad0638c293017f", "f914232367d7ce636cd7710a25afeeeb"}},
      {"1797",
       {"058bdcf1ac1094866d13bee966f09a66", "4e5cfcd416dcb88c5a5b6b53c30e0e87", "ef80bf5eee7ee148fe0bcec2ddccfff6"}}};

  SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + kName + "_lb_n3.pcap");
  SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + kName + ".json");
  const OusterDecoder decoder = decoderOf(metadata);
  FrameFields fields(decoder);
  std::vector<FieldFrame> frames;
  for (const auto& packet : payloadsOf(capture))
    if (decoder.kind(packet) == PacketKind::Lidar)
      for (FieldFrame& frame : fields.push(packet)) frames.push_back(std::move(frame));
  for (FieldFrame& frame : fields.finish()) frames.push_back(std::move(frame));

  ASSERT_EQ(frames.size(), expected.size());
  for (const FieldFrame& frame : frames)
  {
    auto digests = digestsOf(frame);
    const Turn& turn = expected.at(digests["FRAME_ID"]);
    EXPECT_EQ(digests["RANGE"], turn.range);
    EXPECT_EQ(digests["REFLECTIVITY"], turn.reflectivity);
    EXPECT_EQ(digests["NEAR_IR"], turn.near_ir);
  }
}

TEST(ReferenceDecode, theFirstTurnLiesInTheMakersMapToTenMicrometres)
{
  SCANLOOM_NEEDS_DATA(capture, kOusterCaptures + kName + "_lb_n3.pcap");
  SCANLOOM_NEEDS_DATA(metadata, kOusterCaptures + kName + ".json");
  SCANLOOM_NEEDS_DATA(map_file, kOusterTests + "osfs/" + kName + "_lb_n3_map-000.ply");
  const auto map = readPly(map_file);
  ASSERT_EQ(map.size(), 155000u);

  // The map keeps a part of the points of three turns; those of the first one stand there unmoved (its pose is the
  // identity), those of the others as the maker's odometry moved them.
  const auto turn = pointsOfTurn(decoderOf(metadata), capture, kFirstTurn);
  const std::size_t found = countFound(map, turn, 1e-5f);
  RecordProperty("map_points_found", static_cast<int>(found));
  EXPECT_GT(found, map.size() / 4);

  // Not by chance: after a rotation of a tenth of a degree none is found.
  const OusterDecoder turned = decoderOf(metadata, Rigid::fromXyzYawPitchRoll(0, 0, 0, 0.1 * M_PI / 180, 0, 0));
  EXPECT_LT(countFound(map, pointsOfTurn(turned, capture, kFirstTurn), 1e-5f), map.size() / 100);
}
}  // namespace scanloom::reference_decode_unittest
