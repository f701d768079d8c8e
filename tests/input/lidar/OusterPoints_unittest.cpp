/** Every kernel that this machine can run gives the same bits for every profile. */
#include <gtest/gtest.h>

#include "input/lidar/OusterDecoder.h"
#include "simpleMetadata.h"

namespace scanloom::ouster_points_unittest
{
namespace
{
struct Case
{
  Kernel kernel;
  std::string profile;
  int channels;

  std::string name() const { return std::string(nameOf(kernel)) + "_" + profile + "_" + std::to_string(channels); }
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name(); }

const Rigid kTilted = Rigid::fromXyzYawPitchRoll(1, -2, 3, 0.4, -0.2, 0.1);

/** Nothing but noise where channels are, so that every bit of every field occurs; `sky` of 8 channels have no return.
 */
std::vector<std::uint8_t> noisyPacket(const OusterMetadata& m, std::uint32_t seed, std::uint32_t sky)
{
  std::vector<std::uint8_t> packet = OusterEncoder(m).lidarPacket(randomColumns(m, seed));
  const OusterLayout layout = layoutOf(m);
  std::mt19937 random(seed);
  for (std::size_t column = 0; column < layout.columns; ++column)
  {
    const std::size_t channels = layout.columnOffset(column) + layout.columnHeaderBytes();
    for (std::size_t i = 0; i < layout.channelsBytes(); ++i) packet[channels + i] = static_cast<std::uint8_t>(random());
    for (std::size_t c = 0; c < layout.channels; ++c)
    {
      const std::size_t channel = channels + c * layout.profile->channel_bytes;
      if (random() % 8 < sky) std::fill_n(packet.begin() + static_cast<std::ptrdiff_t>(channel), 4, std::uint8_t{0});
      const bool twice = layout.profile->returns() == 2 && random() % 4 == 0;
      if (twice)
        writeField(
            packet, channel, (*layout.profile)[OusterField::Range2],
            readField({packet.data() + channel, layout.profile->channel_bytes}, (*layout.profile)[OusterField::Range]));
    }
  }
  return packet;
}

PointCloud pointsOf(const OusterDecoder& decoder, const std::vector<std::uint8_t>& packet)
{
  PointCloud points;
  for (std::size_t block = 0; block < decoder.layout().columns; ++block)
    decoder.appendPoints(packet, block, static_cast<std::int32_t>(1000 * block), 3, points);
  return points;
}

std::vector<Case> allCases()
{
  std::vector<Case> cases;
  for (const Kernel kernel : runnableKernels())
    for (const OusterProfile& profile : kOusterProfiles)
      for (const int channels : {1, 7, 8, 15, 16, 17, 32, 64, 120, 128, 256})
        cases.push_back({kernel, std::string(profile.name), channels});
  return cases;
}

class Kernels : public testing::TestWithParam<Case>
{
};
}  // namespace

TEST_P(Kernels, giveWhatFieldByFieldReadingAndTheBeamTableGive)
{
  const OusterMetadata m = simpleMetadata(GetParam().profile, GetParam().channels, 4);
  const OusterDecoder decoder(m, kTilted, GetParam().kernel);
  const BeamTable beams(beamsOf(m), kTilted * rigidFromMillimetres(m.lidar_to_sensor_mm));
  const ColumnAngles angles = clockwiseColumns(m.columns_per_frame);
  const OusterLayout& layout = decoder.layout();
  const OusterProfile& profile = *layout.profile;

  for (std::uint32_t seed = 0; seed < 9; ++seed)
  {
    const std::vector<std::uint8_t> packet = noisyPacket(m, seed, seed);
    const PointCloud points = pointsOf(decoder, packet);
    std::size_t i = 0;
    const auto expect =
        [&](std::size_t block, std::size_t channel, OusterField range, OusterField reflectivity, OusterField signal)
    {
      const std::size_t offset =
          layout.columnOffset(block) + layout.columnHeaderBytes() + channel * profile.channel_bytes;
      const auto read = [&](OusterField field) {
        return profile[field].present() ? readField({packet.data() + offset, profile.channel_bytes}, profile[field])
                                        : 0;
      };
      const std::uint32_t mm = read(range);
      if (mm == 0 || (range == OusterField::Range2 && mm == read(OusterField::Range))) return;

      ASSERT_LT(i, points.size());
      const std::size_t column = 32 + block;
      const Eigen::Vector3f p = beams.project(static_cast<Eigen::Index>(channel), angles.cosine[column],
                                              angles.sine[column], static_cast<float>(mm));
      ASSERT_EQ(points.position(i), p) << "point " << i;
      ASSERT_EQ(points.range[i], mm);
      ASSERT_EQ(points.intensity[i], read(reflectivity));
      ASSERT_EQ(points.signal[i], read(signal));
      ASSERT_EQ(points.near_ir[i], read(OusterField::NearIr));
      ASSERT_EQ(points.ring[i], channel);
      ASSERT_EQ(points.column[i], column);
      ASSERT_EQ(points.t[i], 1000 * block);
      ASSERT_EQ(points.sensor_id[i], 3);
      ++i;
    };
    for (std::size_t block = 0; block < layout.columns; ++block)
    {
      for (std::size_t c = 0; c < layout.channels; ++c)
        expect(block, c, OusterField::Range, OusterField::Reflectivity, OusterField::Signal);
      for (std::size_t c = 0; c < layout.channels && profile.returns() == 2; ++c)
        expect(block, c, OusterField::Range2, OusterField::Reflectivity2, OusterField::Signal2);
    }
    EXPECT_EQ(points.size(), i);
  }
}

INSTANTIATE_TEST_SUITE_P(OusterPoints, Kernels, testing::ValuesIn(allCases()),
                         [](const testing::TestParamInfo<Case>& test) { return test.param.name(); });

TEST(OusterPoints, aPacketAtTheVeryEndOfItsMemoryIsNotReadPast)
{
  for (const Kernel kernel : runnableKernels())
    for (const OusterProfile& profile : kOusterProfiles)
    {
      const OusterMetadata m = simpleMetadata(std::string(profile.name), 24);
      const std::vector<std::uint8_t> packet = noisyPacket(m, 1, 1);
      // AddressSanitizer watches the end of an allocation of just this size.
      const std::vector<std::uint8_t> exact(packet.begin(), packet.end());
      EXPECT_GT(pointsOf(OusterDecoder(m, kTilted, kernel), exact).size(), 0u);
    }
}

TEST(OusterPoints, beamsOfDifferentOriginsAreRefused)
{
  const BeamTable beams({Beam{}, Beam{0, 0, {0.1, 0, 0}, 0}}, Rigid::identity());
  EXPECT_THROW(OusterPoints(kOusterProfiles[0], beams, Kernel::Portable), std::invalid_argument);
}
}  // namespace scanloom::ouster_points_unittest
