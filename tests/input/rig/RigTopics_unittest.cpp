#include "input/rig/internal/RigTopics.h"

#include <gmock/gmock.h>

#include "base/core/ConfigError.h"
#include "input/bags/MessageWriter.h"
#include "input/rig/RecognisedRig.h"
#include "input/rig/Rig.h"
#include "input/rig/internal/RigReplay.h"
#include "input/rig/silentLidars.h"
#include "liveRig.h"
#include "support/TemporaryFolder.h"

#include <condition_variable>

namespace scanloom::rig_topics_unittest
{
namespace
{
using testing::HasSubstr;

constexpr Timestamp kStart{Duration{1'700'000'000'000'000'000}};
constexpr Duration kTurn = 100ms;
constexpr std::uint32_t kColumns = 100;
const std::string kCloud = "sensor_msgs/msg/PointCloud2", kImu = "sensor_msgs/msg/Imu";

/** Gives the messages that a test gives it, of topics that were subscribed to. */
class FakeNode : public Ros2Node
{
 public:
  void send(Ros2Message message)
  {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
  }

  std::vector<Ros2Publication> publications() const override { return {}; }
  void subscribe(const std::string& topic) override { subscribed_.push_back(topic); }
  void unsubscribe() override { subscribed_.clear(); }
  Ros2Losses losses() const override { return {}; }
  std::size_t advertise(const Ros2Topic&, const Ros2Keep&) override { return 0; }
  bool publish(std::size_t, std::vector<std::uint8_t>) override { return true; }
  bool hasReaders(std::size_t) const override { return false; }

  std::optional<Ros2Message> next(Duration patience) override
  {
    {
      const std::lock_guard lock(mutex_);
      if (!messages_.empty())
      {
        std::optional<Ros2Message> message(std::move(messages_.front()));
        messages_.pop_front();
        return message;
      }
    }
    std::this_thread::sleep_for(std::min<Duration>(patience, 5ms));
    return std::nullopt;
  }

  bool isEmpty() const
  {
    const std::lock_guard lock(mutex_);
    return messages_.empty();
  }

  const std::vector<std::string>& subscribed() const { return subscribed_; }

 private:
  mutable std::mutex mutex_;
  std::deque<Ros2Message> messages_;
  std::vector<std::string> subscribed_;
};

/** A turn of two points a column, published as it ends. */
Ros2Message turn(const std::string& side, Timestamp start)
{
  PointCloud points;
  points.resize(2 * kColumns);
  for (std::uint32_t i = 0; i < points.size(); ++i)
  {
    points.x[i] = 10;
    points.z[i] = static_cast<float>(i % 2);
    points.ring[i] = static_cast<std::uint8_t>(i % 2);
    points.t[i] = static_cast<std::int32_t>(i / 2) * 1'000'000;
  }
  return {{"/" + side + "/points", kCloud}, start + kTurn, cloudMessage(points, start, side)};
}

Ros2Message imuSample(Timestamp stamp)
{
  return {{"/imu", kImu}, stamp + 1ms, imuMessage({stamp, {0, 0, 0.1}, {0, 0, 9.81}}, "imu_link")};
}

/** Two lidars, half a turn apart, and an IMU; where they are first. */
std::vector<Ros2Message> drive(int turns)
{
  const auto at = [](const std::string& frame, double x) {
    return StampedTransform{kStart, "base_link", frame, Rigid::fromXyzYawPitchRoll(x, 0, 0, 0, 0, 0)};
  };
  std::vector<Ros2Message> messages{{{"/tf_static", "tf2_msgs/msg/TFMessage"},
                                     kStart,
                                     transformsMessage({at("left", 1), at("right", -1), at("imu_link", 0.5)})}};
  for (int i = 0; i < turns; ++i)
  {
    for (int sample = 0; sample < 10; ++sample) messages.push_back(imuSample(kStart + i * kTurn + sample * 10ms));
    messages.push_back(turn("left", kStart + i * kTurn));
    messages.push_back(turn("right", kStart + i * kTurn + kTurn / 2));
  }
  const auto earlier = [](const Ros2Message& a, const Ros2Message& b) { return a.received < b.received; };
  std::stable_sort(messages.begin(), messages.end(), earlier);
  return messages;
}

void record(const std::vector<Ros2Message>& messages, const std::filesystem::path& file)
{
  TopicRecording recording(file);
  for (const Ros2Message& message : messages) recording.add(message);
  recording.close();
}

/** As the first seconds describe it. */
Rig describedBy(const std::vector<Ros2Message>& messages, const TemporaryFolder& folder)
{
  record(messages, folder / "heard.mcap");
  const RecognisedRig recognised = recogniseRig(filesOf({folder / "heard.mcap"}));
  return makeRig(readRigSettings(Configuration::fromText(recognised.ini, "recognised"), kRecognisedSection));
}

/** The events until all that was sent is taken. */
std::vector<SensorEvent> eventsOf(RigTopics& rig, const FakeNode& node)
{
  while (!node.isEmpty()) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(10ms);
  rig.stop();
  std::vector<SensorEvent> events;
  while (std::optional<SensorEvent> event = rig.next(1s)) events.push_back(*std::move(event));
  return events;
}

std::vector<Scan> scansOf(const Rig& rig, const std::vector<Ros2Message>& messages)
{
  const auto node = std::make_shared<FakeNode>();
  for (const Ros2Message& message : messages) node->send(message);
  Rig live = heardOn(node, rig);
  live.live.scans_waiting = 1000;
  RigTopics topics(live);
  return scansIn(eventsOf(topics, *node));
}

void expectSame(const std::vector<Scan>& a, const std::vector<Scan>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a[i].start, b[i].start);
    EXPECT_EQ(a[i].points.t, b[i].points.t);
    EXPECT_EQ(a[i].points.x, b[i].points.x);
    EXPECT_EQ(a[i].points.sensor_id, b[i].points.sensor_id);
    EXPECT_EQ(a[i].missing, b[i].missing);
  }
}
}  // namespace

TEST(RigTopics, givesTheScansAndSamplesThatAReplayOfItsRecordingGivesToTheBit)
{
  const TemporaryFolder folder;
  const std::vector<Ros2Message> messages = drive(30);
  const Rig rig = describedBy(messages, folder);
  const auto node = std::make_shared<FakeNode>();
  for (const Ros2Message& message : messages) node->send(message);
  Rig live = heardOn(node, rig);
  live.live.capture = folder / "live.mcap";
  live.live.scans_waiting = 1000;
  std::vector<SensorEvent> heard;
  {
    RigTopics topics(live);
    heard = eventsOf(topics, *node);
  }
  Rig recorded = rig;
  recorded.captures = {folder / "live.mcap"};
  RigReplay replay(recorded);
  const std::vector<SensorEvent> replayed = eventsOf(replay);
  EXPECT_GT(scansIn(heard).size(), 25u);
  expectSame(scansIn(heard), scansIn(replayed));
  const auto samples = [](const std::vector<SensorEvent>& events)
  {
    std::vector<Timestamp> stamps;
    for (const SensorEvent& event : events)
      if (const auto* imu = std::get_if<SensorImu>(&event)) stamps.push_back(imu->sample.stamp);
    return stamps;
  };
  EXPECT_EQ(samples(heard).size(), 300u);
  EXPECT_EQ(samples(heard), samples(replayed));
}

TEST(RigTopics, aLidarWhoseDriverStartsLateJoins)
{
  const TemporaryFolder folder;
  const Rig rig = describedBy(drive(10), folder);
  std::vector<Ros2Message> messages;
  for (Ros2Message& message : drive(40))
    if (message.topic.name != "/right/points" || message.received > kStart + 2s) messages.push_back(std::move(message));
  const std::vector<Scan> scans = scansOf(rig, messages);
  ASSERT_GT(scans.size(), 35u);
  for (const Scan& scan : scans)
  {
    const Duration since = scan.start - kStart;
    if (since < 300ms || since > 3700ms) continue;  // the first and the last turn are cut
    EXPECT_EQ(scan.columns_of.at(0), kColumns);
    if (since >= 1600ms && since < 2300ms) continue;  // it joins
    EXPECT_EQ(scan.columns_of.at(1), since < 1600ms ? 0 : kColumns);
  }
}

TEST(RigTopics, aLidarThatNobodyPublishesIsNamedAndTheOtherGoesOn)
{
  const TemporaryFolder folder;
  const Rig rig = describedBy(drive(10), folder);
  const auto node = std::make_shared<FakeNode>();
  for (Ros2Message& message : drive(30))
    if (message.topic.name != "/right/points") node->send(std::move(message));
  Rig live = heardOn(node, rig);
  live.live.scans_waiting = 1000;
  RigTopics topics(live);
  const std::vector<SensorEvent> events = eventsOf(topics, *node);
  EXPECT_GT(scansIn(events).size(), 25u);
  const std::vector<std::string> silent = silentLidars(topics.account());
  ASSERT_EQ(silent.size(), 1u);
  EXPECT_THAT(silent.front(), HasSubstr("right"));
}

TEST(RigTopics, aDriverThatStartsAgainGoesOnAndNothingOfTheOtherIsLost)
{
  const TemporaryFolder folder;
  const Rig rig = describedBy(drive(10), folder);
  std::vector<Ros2Message> messages;
  for (Ros2Message& message : drive(50))
  {
    const Duration since = message.received - kStart;
    if (message.topic.name != "/right/points" || since < 1500ms || since > 3s) messages.push_back(std::move(message));
  }
  std::size_t left = 0, right_after = 0;
  for (const Scan& scan : scansOf(rig, messages))
  {
    left += scan.columns_of.at(0);
    if (scan.start - kStart > 3100ms) right_after += scan.columns_of.at(1);
  }
  EXPECT_GE(left, 49 * kColumns);
  EXPECT_GE(right_after, 17 * kColumns);
}

TEST(RigTopics, messagesThatEndTooEarlyAreCountedAndNothingElseIsLost)
{
  const TemporaryFolder folder;
  const std::vector<Ros2Message> sound = drive(30);
  const Rig rig = describedBy(sound, folder);
  const auto node = std::make_shared<FakeNode>();
  for (const Ros2Message& message : sound)
  {
    Ros2Message damaged = message;
    damaged.data.resize(damaged.data.size() / 3);
    node->send(damaged);
    node->send(message);
  }
  Rig live = heardOn(node, rig);
  live.live.scans_waiting = 1000;
  RigTopics topics(live);
  const std::vector<Scan> scans = scansIn(eventsOf(topics, *node));
  EXPECT_EQ(topics.account().input.at("messages_malformed"), sound.size() - 1) << "nobody asks for tf_static";
  expectSame(scans, scansOf(rig, sound));
}

TEST(RigTopics, aRecordingOfTopicsIsAnMcap)
{
  const TemporaryFolder folder;
  Rig live = heardOn(std::make_shared<FakeNode>(), describedBy(drive(10), folder));
  live.live.capture = folder / "live.pcap";
  EXPECT_THROW(RigTopics{live}, ConfigError);
}

TEST(RigTopics, aRecordingThatIsThereIsNotOverwritten)
{
  const TemporaryFolder folder;
  Rig live = heardOn(std::make_shared<FakeNode>(), describedBy(drive(10), folder));
  live.live.capture = folder / "heard.mcap";
  EXPECT_THROW(RigTopics{live}, std::runtime_error);
}

TEST(RigTopics, aRigOfPortsIsNotHeardOnTopics)
{
  const TemporaryFolder folder;
  Rig rig = describedBy(drive(10), folder);
  rig.addresses[1].topic.clear();
  EXPECT_THROW(heardOn(std::make_shared<FakeNode>(), rig), ConfigError);
}
}  // namespace scanloom::rig_topics_unittest
