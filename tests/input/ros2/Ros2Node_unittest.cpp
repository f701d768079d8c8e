#include "input/ros2/Ros2Node.h"

#include "base/core/ConfigError.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace scanloom
{
namespace
{
namespace ros2_node_test
{
/** A variable of the environment, as long as it lives. */
class Variable
{
 public:
  Variable(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
  ~Variable() { ::unsetenv(name_); }

 private:
  const char* name_;
};

TEST(Ros2Names, aTopicAndItsTypeAreThoseThatProgramsOfRos2WriteIntoDds)
{
  EXPECT_EQ(ddsTopicOf("/left/points"), "rt/left/points");
  EXPECT_EQ(ddsTypeOf("sensor_msgs/msg/PointCloud2"), "sensor_msgs::msg::dds_::PointCloud2_");
  const auto topic = rosTopicOf("rt/left/points", "sensor_msgs::msg::dds_::PointCloud2_");
  ASSERT_TRUE(topic);
  EXPECT_EQ(*topic, (Ros2Topic{"/left/points", "sensor_msgs/msg/PointCloud2"}));
}

TEST(Ros2Names, servicesAndTopicsOfOtherProgramsAreNoTopicsOfRos2)
{
  EXPECT_FALSE(rosTopicOf("rq/node/get_parametersRequest", "rcl_interfaces::srv::dds_::GetParameters_Request_"));
  EXPECT_FALSE(rosTopicOf("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"));
  EXPECT_FALSE(rosTopicOf("rt/a", "HelloWorld"));
  EXPECT_FALSE(rosTopicOf("", ""));
  EXPECT_THROW(ddsTypeOf("Imu"), std::invalid_argument);
}

TEST(Ros2Names, aNamespaceBeginsWithASlashAndNoPartOfItWithADigit)
{
  for (const char* name : {"/scanloom", "/a/b_2", "/_x"}) EXPECT_TRUE(isRosName(name)) << name;
  for (const char* name : {"", "/", "scanloom", "/a/", "//a", "/2a", "/a b", "/a-b", "/drive.pcap"})
    EXPECT_FALSE(isRosName(name)) << name;
}

TEST(Ros2Network, withoutVariablesItIsDomain0InTheSubnet)
{
  const Ros2Network network = ros2NetworkOfEnvironment();
  EXPECT_EQ(network.domain, 0);
  EXPECT_EQ(network.range, Ros2Network::Range::Subnet);
  EXPECT_TRUE(network.peers.empty());
}

TEST(Ros2Network, theVariablesOfRos2AreObeyed)
{
  const Variable domain("ROS_DOMAIN_ID", "42"), localhost("ROS_LOCALHOST_ONLY", "1"),
      peers("ROS_STATIC_PEERS", "10.0.0.7; robot.local;"), distribution("ROS_DISTRO", "humble");
  const Ros2Network network = ros2NetworkOfEnvironment();
  EXPECT_EQ(network.domain, 42);
  EXPECT_EQ(network.range, Ros2Network::Range::Localhost);
  EXPECT_EQ(network.peers, (std::vector<std::string>{"10.0.0.7", "robot.local"}));
  EXPECT_TRUE(network.long_ids);
}

TEST(Ros2Network, theNewerVariableOfTheRangeComesFirst)
{
  const Variable localhost("ROS_LOCALHOST_ONLY", "1"), range("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF");
  EXPECT_EQ(ros2NetworkOfEnvironment().range, Ros2Network::Range::Off);
}

TEST(Ros2Network, whatRos2WouldNotTakeIsRefusedAndNamed)
{
  const auto refused = [](const char* name, const char* value)
  {
    const Variable variable(name, value);
    try
    {
      ros2NetworkOfEnvironment();
    }
    catch (const ConfigError& error)
    {
      return std::string(error.what()).find(name) != std::string::npos;
    }
    return false;
  };
  for (const char* domain : {"233", "-1", "one", "99999999999"})
    EXPECT_TRUE(refused("ROS_DOMAIN_ID", domain)) << domain;
  EXPECT_TRUE(refused("ROS_AUTOMATIC_DISCOVERY_RANGE", "EVERYWHERE"));
  EXPECT_TRUE(refused("ROS_STATIC_PEERS", "\"/><Tracing/>"));
}
}  // namespace ros2_node_test
}  // namespace
}  // namespace scanloom
