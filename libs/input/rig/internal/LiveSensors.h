#pragma once
#include "input/rig/Rig.h"
#include "input/rig/internal/SensorInquiries.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * Keeps the decoders of a live rig up to date with the sensors' metadata: a sensor that did not answer at the start is
 * asked until it answers, one that may have changed is asked again. Metadata from a file are never asked for.
 */
class LiveSensors
{
 public:
  static constexpr Duration kBetweenQuestions = 2s;

  /**
   * Starts to ask sensors without metadata, and to configure those that may be configured. Metadata are written beside
   * the rig's capture, if it has one, since the packets can't be read without them (x.pcap: x.left.json, and
   * x.left.2.json after a change).
   */
  explicit LiveSensors(const Rig&);

  /**
   * The lidar has restarted, or sends packets that its decoder does not understand: its metadata may have changed. Its
   * sensor, if known, is asked now, or kBetweenQuestions after the last time.
   */
  void recheck(LidarIndex);

  struct Change
  {
    LidarIndex lidar = 0;
    std::shared_ptr<const PacketDecoder> decoder;
    LidarAddress address;
    LidarMetadata metadata;
  };

  /** Lidars whose metadata were received or have changed since the last call. Lines for a person go to `notices`. */
  std::vector<Change> takeChanges(std::vector<std::string>& notices);

 private:
  using Clock = std::chrono::steady_clock;

  struct Lidar
  {
    RigSensor sensor;
    std::string name;
    int saved = 0;  // number of files beside the capture
    bool suspect = false;
    std::optional<Clock::time_point> asked;
  };

  void askSuspects();
  void saveMetadata(Lidar&);
  std::optional<Change> changeBy(const SensorInquiries::Answer&, std::vector<std::string>& notices);

  std::filesystem::path capture_;
  std::vector<Lidar> lidars_;
  std::vector<std::string> problems_;  // of the disk, until takeChanges()
  SensorInquiries inquiries_;
};
}  // namespace scanloom
