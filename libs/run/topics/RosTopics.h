/** What a run sees and estimates, as topics of ROS 2 (doc/ros2.md). */
#pragma once
#include "base/core/BoundedQueue.h"
#include "estimation/slam/StateEstimate.h"
#include "input/bags/MessageWriter.h"
#include "input/rig/ForwardedInput.h"
#include "input/ros2/Ros2Node.h"
#include "run/topics/internal/PredictedMotion.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace scanloom
{
/**
 * Topics below a namespace: points, slices and imu; of a run that localises also odometry and map; and the common ones
 * tf, tf_static and diagnostics. Frames by REP-105: map, odom, base_link (the body), and one of each sensor's name.
 *
 * Used from one thread, which waits for nobody: messages are made there if somebody reads their topic, and are written
 * by a thread of their own. More than a dozen members: the topics, and what was last sent on each.
 */
class RosTopics
{
 public:
  using Clock = std::chrono::steady_clock;

  /** `name_space` as isRosName() wants it. Throws what Ros2Node::advertise throws. */
  RosTopics(std::shared_ptr<Ros2Node>, const std::string& name_space, bool localised);
  RosTopics(const RosTopics&) = delete;
  RosTopics& operator=(const RosTopics&) = delete;
  ~RosTopics();

  /** Where the sensors are: tf_static, if it is news. */
  void describe(const SensorSetup&);

  void add(const Scan&);
  void add(const ScanPart&);

  /** Of the body's IMU, or if it has none of the first lidar's. With the pose that it predicts. */
  void add(const SensorImu&);

  void add(const StateEstimate&);

  /** A part of the map, besides the keyframes of estimates. */
  void addMap(const Keyframe&);

  /** A pose that was estimated before: its covariance and twist are not known. */
  void add(const StampedPose&);

  /** The state of the lidars, once a second. */
  void update(const RigAccount&, Clock::time_point now = Clock::now());

  /** Messages that were not sent: of scans and maps because the network was too slow, or that DDS did not take. */
  std::uint64_t dropped() const { return queue_.dropped(kLarge) + refused_; }

 private:
  static constexpr std::size_t kLarge = 0, kSmall = 1;  // kinds of messages, with room of their own

  struct Outgoing
  {
    std::size_t topic = 0, kind = kSmall;
    std::vector<std::uint8_t> message;
  };

  std::size_t advertise(const std::string& topic, const std::string& type, const Ros2Keep&);
  void send(std::size_t topic, std::size_t kind, std::vector<std::uint8_t> message);
  void sendOdometry(const BodyMotion&);
  void sendPoints(std::size_t topic, const Scan&);
  int imuInUse() const;

  std::shared_ptr<Ros2Node> node_;
  std::string name_space_;
  bool localised_;
  std::size_t points_, imu_, odometry_ = 0, map_ = 0, tf_ = 0, tf_static_, diagnostics_;
  std::optional<std::size_t> slices_;  // from the first one on
  SensorSetup setup_;
  PredictedMotion motion_;
  Health health_ = Health::Initialising;
  Rigid map_T_odom_, odom_T_body_;
  RigAccount account_;  // as of the last diagnostics
  Clock::time_point diagnosed_{};
  Timestamp newest_;
  BoundedQueue<Outgoing> queue_{{3, 10'000}, [](const Outgoing& outgoing) { return outgoing.kind; }};
  std::atomic<std::uint64_t> refused_{0};
  std::thread thread_;  // last: it uses all of the above
};

/** Another input, whose events are published on their way to the one who asks for them. */
class PublishedInput : public ForwardedInput
{
 public:
  enum class Pace
  {
    OfInput,    // of live sensors, and of a player
    OfSensors,  // of a recording: its events come when the sensors' time has passed, as readers of topics expect
  };

  /** Both must outlive it. */
  PublishedInput(SensorInput& input, RosTopics& topics, Pace pace) : ForwardedInput(input), topics_(topics), pace_(pace)
  {
  }

  /** The same of an input of its own, with the poses at the ends of its scans, as far as `poses` has them. */
  PublishedInput(std::unique_ptr<SensorInput> input, RosTopics& topics, Pace pace, Trajectory poses)
    : ForwardedInput(*input), owned_(std::move(input)), topics_(topics), pace_(pace), poses_(std::move(poses))
  {
  }

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration patience) override;
  RigAccount account() const override;

 private:
  void keepPace(const SensorEvent&);

  std::unique_ptr<SensorInput> owned_;  // null: somebody else's
  RosTopics& topics_;
  Pace pace_;
  Trajectory poses_;
  std::optional<Timestamp> first_;  // event, which came at started_
  RosTopics::Clock::time_point described_{}, started_{};
};
}  // namespace scanloom
