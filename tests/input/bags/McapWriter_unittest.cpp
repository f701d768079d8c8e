#include "input/bags/internal/McapWriter.h"

#include <gmock/gmock.h>

#include <fstream>

#include "input/bags/BagReader.h"
#include "input/bags/MessageWriter.h"
#include "input/bags/internal/SensorMessages.h"
#include "support/TemporaryFolder.h"

namespace scanloom::mcap_writer_unittest
{
namespace
{
std::vector<std::uint8_t> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

TEST(McapWriter, writesWhatTheReaderReads)
{
  const TemporaryFolder folder;
  {
    std::ofstream file(folder / "out.mcap", std::ios::binary);
    McapWriter writer(file);
    const std::uint16_t a = writer.addTopic("/a", {"std_msgs/msg/String", "string data\n"});
    writer.add(a, Timestamp{2s}, bytesOf("second"));
    const std::uint16_t b = writer.addTopic("/b", {"sensor_msgs/msg/Imu", ""});
    writer.add(b, Timestamp{1s}, bytesOf("first"));
    writer.add(b, Timestamp{3s}, std::vector<std::uint8_t>(5 << 20, 'x'));  // ends its chunk
    writer.add(a, Timestamp{4s}, bytesOf("last"));
    writer.close();
  }
  const auto bag = BagReader::open(folder / "out.mcap");
  ASSERT_EQ(bag->topics().size(), 2u);
  EXPECT_EQ(bag->topics()[1].type, "sensor_msgs/Imu");
  std::vector<std::string> seen;
  for (BagMessage message; bag->next(message);)
    seen.push_back(bag->topics()[message.topic].name + " " + std::to_string(message.data.size()) + " " +
                   std::to_string(nanoseconds(message.received)));
  EXPECT_THAT(seen,
              testing::ElementsAre("/b 5 1000000000", "/a 6 2000000000", "/b 5242880 3000000000", "/a 4 4000000000"));
  EXPECT_THAT(bag->takeWarnings(), testing::IsEmpty());
}

TEST(MessageWriter, writesWhatTheMessagesAreReadFrom)
{
  MessageWriter message;
  message.header(Timestamp{7s + 8ns}, "map");
  message.vector({1, 2, 3});
  message.quaternion(Eigen::Quaterniond(0, 0, 0, 1));
  const StampedPose pose = poseOf({"/p", "geometry_msgs/PoseStamped", Serialisation::Cdr}, message.bytes());
  EXPECT_EQ(pose.stamp, Timestamp{7s + 8ns});
  EXPECT_EQ(pose.map_T_body.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(pose.map_T_body.rotation.z(), 1);
}
}  // namespace
}  // namespace scanloom::mcap_writer_unittest
