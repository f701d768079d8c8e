#include "input/bags/BagReader.h"

#include <gmock/gmock.h>

#include "input/bags/internal/unpacked.h"
#include "support/HandmadeBag.h"
#include "support/TemporaryFolder.h"

namespace scanloom::bag_reader_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<HandmadeMessage> kThree{{"/a", "std_msgs/msg/String", 3'000'000'001, "late"},
                                          {"/b", "sensor_msgs/msg/Imu", 1'000'000'002, "early"},
                                          {"/a", "std_msgs/msg/String", 2'000'000'003, "middle"}};

/** "topic:data@time" of all messages, and the warnings. */
std::vector<std::string> contentOfBag(const std::filesystem::path& path)
{
  const auto bag = BagReader::open(path);
  std::vector<std::string> content;
  for (BagMessage message; bag->next(message);)
    content.push_back(bag->topics()[message.topic].name + ":" + std::string(message.data.begin(), message.data.end()) +
                      "@" + std::to_string(nanoseconds(message.received)));
  for (const std::string& warning : bag->takeWarnings()) content.push_back("warning: " + warning);
  return content;
}

const auto kInOrder = ElementsAre("/b:early@1000000002", "/a:middle@2000000003", "/a:late@3000000001");

struct Container
{
  const char* name;
  void (*write)(const std::filesystem::path&);
};

class Bags : public testing::TestWithParam<Container>
{
};

TEST_P(Bags, giveMessagesInTheOrderOfReceiveTimes)
{
  const TemporaryFolder folder;
  GetParam().write(folder / "bag");
  EXPECT_TRUE(isBag(folder / "bag"));
  EXPECT_THAT(contentOfBag(folder / "bag"), kInOrder);
}

TEST_P(Bags, knowTheirTopicsBeforeTheFirstMessage)
{
  const TemporaryFolder folder;
  GetParam().write(folder / "bag");
  const auto bag = BagReader::open(folder / "bag");
  std::vector<std::string> topics;
  for (const BagTopic& topic : bag->topics()) topics.push_back(topic.name + " " + topic.type);
  EXPECT_THAT(topics, testing::IsSupersetOf({"/a std_msgs/String", "/b sensor_msgs/Imu"}));
}

TEST(BagNames, areNoControlCharactersAndNoLines)
{
  const TemporaryFolder folder;
  const std::vector<HandmadeMessage> messages{{"/\x1b[31ma\nb\xff", "std_msgs/\x1b[2JString", 1, "data"}};
  writeFile(folder / "ros1", ros1Of(messages));
  writeFile(folder / "mcap", mcapOf(messages));
  writeDb3(folder / "db3", messages);
  for (const char* bag : {"ros1", "mcap", "db3"})
  {
    const std::vector<BagTopic> topics = topicsOf({folder / bag});
    ASSERT_EQ(topics.size(), 1u) << bag;
    EXPECT_EQ(topics.front().name, "/?[31ma?b?") << bag;
    EXPECT_EQ(topics.front().type, "std_msgs/?[2JString") << bag;
  }
}

TEST_P(Bags, ofAFolderAreOne)
{
  const TemporaryFolder folder;
  GetParam().write(folder / "bag_0");
  GetParam().write(folder / "bag_1");
  std::ofstream(folder / "metadata.yaml") << "rosbag2_bagfile_information:\n";
  EXPECT_TRUE(isBag(folder.path()));
  EXPECT_EQ(contentOfBag(folder.path()).size(), 6u);
}

TEST_P(Bags, thatAreCutEndThereAndSaySo)
{
  const TemporaryFolder folder;
  GetParam().write(folder / "bag");
  const std::string whole = contentOf(folder / "bag");
  for (const std::size_t size : {whole.size() / 4, whole.size() / 2, whole.size() - 30})
  {
    writeFile(folder / "cut", whole.substr(0, size));
    try
    {
      const std::vector<std::string> content = contentOfBag(folder / "cut");
      EXPECT_THAT(content, testing::Not(testing::IsEmpty())) << GetParam().name << " cut to " << size;
    }
    catch (const std::runtime_error& refusal)  // nothing of it can be read
    {
      EXPECT_THAT(refusal.what(), HasSubstr((folder / "cut").string()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Containers, Bags,
    testing::Values(Container{"db3", [](const auto& path) { writeDb3(path, kThree); }},
                    Container{"mcap", [](const auto& path) { writeFile(path, mcapOf(kThree)); }},
                    Container{"mcap_lz4", [](const auto& path) { writeFile(path, mcapOf(kThree, "lz4")); }},
                    Container{"mcap_zstd", [](const auto& path) { writeFile(path, mcapOf(kThree, "zstd")); }},
                    Container{"ros1", [](const auto& path) { writeFile(path, ros1Of(kThree)); }},
                    Container{"ros1_lz4", [](const auto& path) { writeFile(path, ros1Of(kThree, "lz4")); }},
                    Container{"ros1_bz2", [](const auto& path) { writeFile(path, ros1Of(kThree, "bz2")); }}),
    [](const auto& test) { return test.param.name; });

TEST(BagReader, readsABagOfRos1ThatWasNotClosedAndSaysSo)
{
  const TemporaryFolder folder;
  writeFile(folder / "bag", ros1Of(kThree, "none", false));
  const auto bag = BagReader::open(folder / "bag");
  EXPECT_EQ(bag->topics().size(), 2u);
  const std::vector<std::string> content = contentOfBag(folder / "bag");
  ASSERT_EQ(content.size(), 4u);
  EXPECT_THAT(content.back(), HasSubstr("was not closed"));
}

TEST(BagReader, readsFilesInZstdAsAWhole)
{
  const TemporaryFolder folder;
  writeDb3(folder / "plain", kThree);
  writeFile(folder / "bag.db3.zstd", packed(contentOf(folder / "plain"), "zstd"));
  EXPECT_TRUE(isBag(folder / "bag.db3.zstd"));
  EXPECT_THAT(contentOfBag(folder / "bag.db3.zstd"), kInOrder);
  writeFile(folder / "bag.mcap.zstd", packed(mcapOf(kThree), "zstd"));
  EXPECT_THAT(contentOfBag(folder / "bag.mcap.zstd"), kInOrder);
}

TEST(BagReader, leavesOutADamagedChunkAndSaysSo)
{
  const TemporaryFolder folder;
  std::string bytes = mcapOf(kThree, "zstd");
  const std::size_t frame = bytes.find("\x28\xb5\x2f\xfd");
  bytes[frame] = 0;
  writeFile(folder / "bag", bytes);
  EXPECT_THAT(contentOfBag(folder / "bag"), ElementsAre(HasSubstr("1 chunks are damaged and left out")));
}

TEST(BagReader, takesNoMoreMemoryThanTheFileHasForAClaimedLength)
{
  const TemporaryFolder folder;
  writeFile(folder / "bag", "\x89MCAP0\r\n" + littleEndian(std::uint8_t{6}) + littleEndian(std::uint64_t{1} << 60));
  EXPECT_THAT(contentOfBag(folder / "bag"), ElementsAre(HasSubstr("a record that claims 1152921504606846976 bytes")));
}

TEST(BagReader, leavesOutAChunkThatUnpacksToFarMoreThanAnyRecording)
{
  const TemporaryFolder folder;
  const std::string zeros(100'000'000, '\0');
  for (const char* compression : {"lz4", "zstd"})
  {
    writeFile(folder / "bag", mcapOf({{"/a", "std_msgs/msg/String", 1, zeros}}, compression));
    EXPECT_THAT(contentOfBag(folder / "bag"), ElementsAre(HasSubstr("1 chunks are damaged and left out")));
  }
}

TEST(BagReader, endsAFileWhoseChunksTogetherUnpackToFarMoreThanAnyRecording)
{
  const std::string zeros = packed(std::string(40'000'000, '\0'), "bz2");
  const Bytes chunk(reinterpret_cast<const std::uint8_t*>(zeros.data()), zeros.size());
  Unpacker unpacker(2 * zeros.size());
  EXPECT_EQ(unpacker.unpacked(chunk, "bz2", 40'000'000).size(), 40'000'000U);
  EXPECT_THROW(unpacker.unpacked(chunk, "bz2", 40'000'000), UnpacksToTooMuch);
}

TEST(BagReader, refusesWhatIsNoBag)
{
  const TemporaryFolder folder;
  writeFile(folder / "text", "no bag");
  EXPECT_FALSE(isBag(folder / "text"));
  EXPECT_FALSE(isBag(folder / "missing"));
  EXPECT_THROW(BagReader::open(folder / "text"), std::runtime_error);
  EXPECT_THROW(BagReader::open(folder.path()), std::runtime_error);
}

TEST(BagReader, writesTypesAsRos1Does) { EXPECT_EQ(typeNameOf("sensor_msgs/msg/Imu"), "sensor_msgs/Imu"); }
}  // namespace
}  // namespace scanloom::bag_reader_unittest
