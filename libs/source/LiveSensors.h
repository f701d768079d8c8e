#pragma once
#include "source/Rig.h"
#include "source/SensorInquiries.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * Which decoder each lidar of a live rig needs, as its sensor says: those that were not known at the start are asked
 * until they answer, those that seem to have changed are asked again. A lidar whose metadata are in a file keeps it.
 */
class LiveSensors
{
 public:
  static constexpr Duration kBetweenDoubts = 2s;

  /**
   * Begins to ask those that are not known, and to configure those that may be. What sensors say is written beside the rig's capture, if it has one:
   * without it nobody could read the packets (x.pcap: x.left.json, and x.left.2.json after a change).
   */
  explicit LiveSensors(const Rig&);

  /**
   * It started anew, or sends packets that its decoder does not understand. Its sensor is asked, if it can be, at once
   * or kBetweenDoubts after the last time.
   */
  void doubt(LidarIndex);

  struct Change
  {
    LidarIndex lidar = 0;
    std::shared_ptr<const PacketDecoder> decoder;
    LidarAddress address;
    LidarMetadata metadata;
  };

  /** Lidars that are known, or other ones, since the last call; what a person should hear of is added to `notices`. */
  std::vector<Change> takeChanges(std::vector<std::string>& notices);

 private:
  using Clock = std::chrono::steady_clock;

  struct Lidar
  {
    RigSensor sensor;
    std::string name;
    int saved = 0;  // files beside the capture
    bool doubted = false;
    std::optional<Clock::time_point> asked;
  };

  void askDoubted();
  void saveMetadata(Lidar&);
  std::optional<Change> changeBy(const SensorInquiries::Answer&, std::vector<std::string>& notices);

  std::filesystem::path capture_;
  std::vector<Lidar> lidars_;
  std::vector<std::string> problems_;  // of the disk, until takeChanges()
  SensorInquiries inquiries_;
};
}  // namespace scanloom
