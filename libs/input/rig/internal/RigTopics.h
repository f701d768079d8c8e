#pragma once
#include "base/core/BoundedQueue.h"
#include "input/bags/MessagePackets.h"
#include "input/rig/internal/RigStream.h"
#include "input/ros2/TopicRecording.h"

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace scanloom
{
/**
 * A rig whose drivers publish on ROS 2: the messages of its topics through the batcher, in a thread of its own, which
 * nobody makes wait. The recording (`pcap_output`, an MCAP) has the messages in the order and with the stamps that the
 * batcher gets: its replay gives the same scans to the bit. More than a dozen members: the thread's own, and what it
 * shares under the mutex.
 */
class RigTopics : public SensorInput
{
 public:
  /** Subscribes. Throws what TopicRecording throws, and ConfigError if the file to be written is no MCAP. */
  explicit RigTopics(const Rig&);
  ~RigTopics() override;

  using SensorInput::next;

  /** Also throws what ended the batching: see RigStream::take. */
  std::optional<SensorEvent> next(Duration patience) override { return queue_.pop(patience); }
  bool ended() const override { return queue_.ended(); }
  void stop() override { stop_ = true; }
  SensorSetup setup() const override { return setup_; }

  /** A tenth of a second old at most. */
  RigAccount account() const override;

  std::vector<std::string> takeWarnings() override;

 private:
  void receive();
  void closeRecording();
  void receiveOne();
  void take(const Ros2Message&);
  void takePackets();
  void publish();

  SensorSetup setup_;
  std::shared_ptr<Ros2Node> node_;
  std::string imu_topic_;  // of the body
  RigStream stream_;
  MessagePackets packets_;
  BoundedQueue<SensorEvent> queue_;
  std::unique_ptr<TopicRecording> recording_;                       // none if it is not wanted
  std::map<std::pair<std::string, std::string>, BagTopic> topics_;  // as bags declare them, by name and type
  Timestamp newest_imu_ = Timestamp::min();
  std::uint64_t unreadable_imu_ = 0;
  std::chrono::steady_clock::time_point heard_;  // the last message
  std::atomic<bool> stop_{false};

  mutable std::mutex mutex_;
  RigAccount account_;                 // as of the latest publication
  std::vector<std::string> warnings_;  // until they are taken, or too many
  std::thread thread_;                 // last: it uses all of the above
};
}  // namespace scanloom
