#include "input/lidar/BuiltInModels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hesaiPackets.h"
#include "input/lidar/LidarModels.h"
#include "velodynePackets.h"

namespace scanloom::built_in_models_unittest
{
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(BuiltInModels, haveTheFilesOfTheProject)
{
  EXPECT_EQ(metadataText("VLP-16"), readMetadataText(velodyneFile("vlp16")));
  EXPECT_EQ(metadataText("xt32"), readMetadataText(SCANLOOM_SOURCE_DIR "/params/lidars/hesai_xt32.json"));
  for (const BuiltInModel& model : builtInModels())
    EXPECT_EQ(makeDecoder(std::string(model.name), Rigid::identity())->description().model, model.name);
}

TEST(BuiltInModels, areSetToTwoReturnsByTheirName)
{
  EXPECT_EQ(makeDecoder("vlp-16 Dual", Rigid::identity())->description().returns, 2);
}

TEST(BuiltInModels, turnAtAnotherRateByTheirName)
{
  EXPECT_EQ(makeDecoder("VLP-16 1200 rpm", Rigid::identity())->description().frame_rate, 20);
  const auto two_returns = makeDecoder("xt32 dual 300 RPM", Rigid::identity());
  EXPECT_EQ(two_returns->description().frame_rate, 5);
  EXPECT_EQ(two_returns->description().returns, 2);
  EXPECT_THROW(makeDecoder("VLP-16 100 rpm", Rigid::identity()), std::invalid_argument);
}

TEST(BuiltInModels, areNamedWhereOneIsUnknown)
{
  try
  {
    metadataText("VLP-17");
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& e)
  {
    EXPECT_THAT(e.what(), testing::AllOf(HasSubstr("VLP-17"), HasSubstr("HDL-32E"), HasSubstr("XT32")));
  }
  EXPECT_THROW(metadataText("folder/VLP-16"), std::invalid_argument) << "a path is no name";
}

TEST(BuiltInModels, areFoundByAPacket)
{
  for (const char* name : {"XT16", "XT32", "XT32M"})
  {
    const HesaiModel& model = modelNamed(kHesaiModels, name);
    HesaiContent content;
    EXPECT_THAT(modelsThatSend({hesaiPacket(model, content)}), ElementsAre(std::string(model.name)));
    content.return_mode = 0x39;
    EXPECT_THAT(modelsThatSend({hesaiPacket(model, content)}), ElementsAre(std::string(model.name) + " dual"));
  }
  EXPECT_THAT(modelsThatSend({velodynePacket({})}), ElementsAre("VLP-16"));
  VelodyneContent early;
  early.product_id = 0x21;
  EXPECT_THAT(modelsThatSend({velodynePacket(early)}), ElementsAre("HDL-32E", "VLP-16")) << "packets do not tell";
  EXPECT_THAT(modelsThatSend({std::vector<std::uint8_t>(1206)}), IsEmpty());
  EXPECT_THAT(modelsThatSend({}), IsEmpty());
}
}  // namespace scanloom::built_in_models_unittest
