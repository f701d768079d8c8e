#pragma once
#include "input/rig/SensorInput.h"

#include <atomic>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace scanloom
{
class RawlogReader;

/**
 * The scans and IMU samples of a rawlog that scanloom recorded. It knows from the start what lidars and IMUs there are,
 * and holds each scan until its samples were given, as from the batcher: in the file they stand behind it, because
 * rawlog-grabber sorts by stamp and a scan's stamp is its start. Beside that it counts, and keeps for a warning, what
 * it left out.
 */
class RawlogInput : public SensorInput
{
 public:
  /**
   * `only` names the lidars whose columns are wanted; empty means all. Throws std::runtime_error if the file cannot be
   * opened or has no header, ConfigError for a name that no lidar has.
   */
  explicit RawlogInput(const std::filesystem::path&, const std::vector<std::string>& only = {});
  ~RawlogInput() override;

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return ended_; }
  void stop() override { stop_ = true; }
  SensorSetup setup() const override { return setup_; }
  double progress() const override;
  RigAccount account() const override;
  std::vector<std::string> takeWarnings() override;

 private:
  void chooseLidars(const std::vector<std::string>& only);
  void probe(const std::filesystem::path&);
  std::optional<SensorEvent> read();
  bool isFirstDue() const;
  bool accepts(const Scan&);
  std::optional<int> sensorOf(const std::string& label) const;

  std::unique_ptr<RawlogReader> reader_;
  std::uintmax_t bytes_ = 0;  // of the file
  SensorSetup setup_;
  std::vector<std::optional<std::uint8_t>> new_id_;  // by the rawlog's sensor id; none: the lidar is not wanted
  bool all_wanted_ = true;
  std::deque<Scan> held_;  // until their IMU samples were given
  Timestamp newest_sample_ = Timestamp::min(), newest_end_ = Timestamp::min();
  std::map<std::string, std::uint64_t> late_imus_;  // by label: samples of IMUs that are not in the setup
  std::set<std::string> reported_late_;
  std::uint64_t scans_ = 0, other_objects_ = 0;
  std::uint64_t refused_scans_ = 0;  // with points of a lidar that the header does not name
  std::string refusal_;              // of the first of them, until takeWarnings() gives it
  std::string damage_;               // that takeWarnings() has given
  bool ended_ = false;
  std::atomic<bool> stop_{false};
};
}  // namespace scanloom
