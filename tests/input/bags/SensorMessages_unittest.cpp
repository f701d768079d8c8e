#include "input/bags/internal/SensorMessages.h"

#include <gmock/gmock.h>

#include "support/HandmadeBag.h"

namespace scanloom::sensor_messages_unittest
{
namespace
{
std::string numbers(std::initializer_list<double> values)
{
  std::string bytes;
  for (const double value : values) bytes += littleEndian(value);
  return bytes;
}

Bytes viewOf(const std::string& text) { return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}; }

const std::string kStamp = littleEndian(std::int32_t{100}) + littleEndian(std::uint32_t{5});
const std::string kCdr("\0\1\0\0", 4);
const std::string kNineZeros(9 * sizeof(double), '\0');

/** What follows the header. */
std::string imuBody()
{
  return numbers({0, 0, 0, 1}) + kNineZeros + numbers({0.1, 0.2, 0.3}) + kNineZeros + numbers({1, 2, 9.81}) +
         kNineZeros;
}

void expectTheReadings(const ImuMessage& imu)
{
  EXPECT_EQ(imu.frame, "imu");
  EXPECT_EQ(imu.sample.stamp, Timestamp{100s + 5ns});
  EXPECT_EQ(imu.sample.gyro, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(imu.sample.accel, Eigen::Vector3d(1, 2, 9.81));
}

TEST(SensorMessages, ofAnImuAreTheSameInRos2AndRos1)
{
  // In CDR a text counts its zero, and doubles are aligned to 8 bytes behind the first four.
  const std::string frame = withLength(std::string("imu\0", 4));
  expectTheReadings(imuOf({"/imu", "sensor_msgs/Imu", Serialisation::Cdr}, viewOf(kCdr + kStamp + frame + imuBody())));
  const std::string sequence = littleEndian(std::uint32_t{7});
  expectTheReadings(imuOf({"/imu", "sensor_msgs/Imu", Serialisation::Ros1},
                          viewOf(sequence + kStamp + withLength("/imu") + imuBody())));
}

TEST(SensorMessages, thatEndTooEarlyAreOutOfRange)
{
  const std::string whole = kCdr + kStamp + withLength(std::string("imu\0", 4)) + imuBody();
  for (std::size_t size = 0; size + kNineZeros.size() < whole.size(); ++size)
    EXPECT_THROW(imuOf({"/imu", "sensor_msgs/Imu", Serialisation::Cdr}, viewOf(whole.substr(0, size))),
                 std::out_of_range);
}

TEST(SensorMessages, withoutKnownSerialisationAreRefused)
{
  EXPECT_THROW(imuOf({"/imu", "sensor_msgs/Imu", Serialisation::Unknown}, viewOf(kCdr)), std::invalid_argument);
}

TEST(SensorMessages, ofTransformsLeaveOutWhatIsNoRotation)
{
  const std::string header = littleEndian(std::uint32_t{0}) + kStamp + withLength("base_link");
  const std::string message = littleEndian(std::uint32_t{2}) + header + withLength("a") +
                              numbers({1, 2, 3, 0, 0, 1, 0}) + header + withLength("b") +
                              numbers({1, 2, 3, 0, 0, 0, 0});
  const auto transforms = transformsOf({"/tf_static", "tf2_msgs/TFMessage", Serialisation::Ros1}, viewOf(message));
  ASSERT_EQ(transforms.size(), 1u);
  EXPECT_EQ(transforms[0].parent, "base_link");
  EXPECT_EQ(transforms[0].child, "a");
  EXPECT_EQ(transforms[0].parent_T_child * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 2, 3));  // half a turn
}

TEST(SensorMessages, ofTransformsCannotClaimMoreThanTheyHold)
{
  const std::string message = littleEndian(std::uint32_t{0xFFFFFFFF});
  EXPECT_THROW(transformsOf({"/tf_static", "tf2_msgs/TFMessage", Serialisation::Ros1}, viewOf(message)),
               std::out_of_range);
}

TEST(SensorMessages, ofAPointHaveNoRotation)
{
  const std::string header = littleEndian(std::uint32_t{0}) + kStamp + withLength("map");
  const auto pose =
      poseOf({"/p", "geometry_msgs/PointStamped", Serialisation::Ros1}, viewOf(header + numbers({4, 5, 6})));
  EXPECT_EQ(pose.map_T_body.translation, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(pose.map_T_body.rotation.w(), 1);
}

TEST(MessageReader, readsBigEndianCdrWithItsAlignment)
{
  const std::string message("\0\0\0\0\x01\0\0\0\0\0\0\x02", 12);
  MessageReader reader(viewOf(message), Serialisation::Cdr);
  EXPECT_EQ(reader.number<std::uint8_t>(), 1);
  EXPECT_EQ(reader.number<std::uint32_t>(), 2u);
  EXPECT_TRUE(reader.atEnd());
}
}  // namespace
}  // namespace scanloom::sensor_messages_unittest
