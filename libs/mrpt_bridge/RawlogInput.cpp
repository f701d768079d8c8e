#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <stdexcept>

#include "mrpt_bridge/RawlogReader.h"
#include "mrpt_bridge/SensorInput.h"

namespace scanloom
{
namespace
{
/** The scan with the columns of some lidars only, which are numbered anew. */
Scan keepLidars(Scan scan, const std::vector<std::optional<std::uint8_t>>& new_id)
{
  std::vector<std::uint8_t> keep(scan.points.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = new_id[scan.points.sensor_id[i]].has_value();

  std::vector<Column> columns;
  std::uint32_t points = 0;
  for (Column column : scan.columns)
    if (const auto id = new_id[column.sensor_id])
    {
      column.sensor_id = *id;
      column.first_point = points;
      points += column.count;
      columns.push_back(column);
    }
  scan.points.keep(keep);
  for (std::uint8_t& id : scan.points.sensor_id) id = *new_id[id];
  scan.columns = std::move(columns);

  std::vector<std::uint32_t> columns_of;
  for (std::size_t id = 0; id < scan.columns_of.size(); ++id)
    if (new_id[id]) columns_of.push_back(scan.columns_of[id]);
  scan.columns_of = std::move(columns_of);
  return scan;
}

class RawlogInput : public SensorInput
{
 public:
  RawlogInput(const std::filesystem::path& path, const std::vector<std::string>& only) : reader_(path), new_id_(256)
  {
    if (!reader_.header())
      throw std::runtime_error(
          fmt::format("{}: its first object is not scanloom's header, so nothing is known of its "
                      "lidars: record it with scanloom",
                      path.string()));
    header_ = *reader_.header();
    std::vector<RecordedLidar> kept;
    for (const std::string& name : only) requireLidar(name);
    for (std::size_t i = 0; i < header_.lidars.size(); ++i)
    {
      if (!only.empty() && std::find(only.begin(), only.end(), header_.lidars[i].name) == only.end()) continue;
      new_id_[i] = static_cast<std::uint8_t>(kept.size());
      kept.push_back(header_.lidars[i]);
    }
    all_kept_ = kept.size() == header_.lidars.size();
    header_.lidars = std::move(kept);
    while (scans_ < kScansAhead)
    {
      std::optional<SensorEvent> event = read();
      if (!event) break;
      ahead_.push_back(std::move(*event));
    }
  }

  std::optional<SensorEvent> next(Duration) override
  {
    if (ahead_.empty())
    {
      std::optional<SensorEvent> event = read();
      ended_ = !event;
      return event;
    }
    std::optional<SensorEvent> event(std::move(ahead_.front()));
    ahead_.pop_front();
    return event;
  }

  bool ended() const override { return ended_; }
  const RecordingHeader& header() const override { return header_; }
  double progress() const override { return 0; }

  std::vector<std::string> takeWarnings() override
  {
    const std::string damage = std::exchange(warned_of_, reader_.damage());
    return warned_of_ == damage ? std::vector<std::string>() : std::vector<std::string>{warned_of_};
  }

  std::optional<Rigid> body_T_imu(int sensor) const override
  {
    const auto found = body_T_imu_.find(sensor);
    return found == body_T_imu_.end() ? std::optional<Rigid>() : found->second;
  }

  std::map<std::string, std::uint64_t> counts() const override
  {
    return {{"rawlog_scans", scans_}, {"rawlog_other_objects", other_objects_}};
  }

 private:
  std::optional<SensorEvent> read()
  {
    while (auto event = reader_.next())
    {
      if (auto* recorded = std::get_if<RecordedScan>(&*event))
      {
        ++scans_;
        return all_kept_ ? std::move(recorded->scan) : keepLidars(std::move(recorded->scan), new_id_);
      }
      if (const auto* recorded = std::get_if<RecordedImu>(&*event))
        if (const auto sensor = sensorOf(recorded->label))
        {
          body_T_imu_[*sensor] = recorded->body_T_imu;
          return SensorImu{*sensor, recorded->sample};
        }
      ++other_objects_;
    }
    return std::nullopt;
  }

  void requireLidar(const std::string& name) const
  {
    std::vector<std::string> names;
    for (const RecordedLidar& lidar : header_.lidars) names.push_back(lidar.name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw ConfigError(fmt::format("no lidar of the rawlog is called '{}': {}", name, suggestion(name, names)));
  }

  /** `imu` is the body's, `imu_<name>` a lidar's. */
  std::optional<int> sensorOf(const std::string& label) const
  {
    if (label == kImuLabel) return SensorImu::kBody;
    for (std::size_t i = 0; i < header_.lidars.size(); ++i)
      if (label == std::string(kImuLabel) + "_" + header_.lidars[i].name) return static_cast<int>(i);
    return std::nullopt;
  }

  // Every IMU shows up between two scans: after that many it is known which there are.
  static constexpr std::uint64_t kScansAhead = 2;

  RawlogReader reader_;
  std::deque<SensorEvent> ahead_;
  bool ended_ = false;
  RecordingHeader header_;
  std::vector<std::optional<std::uint8_t>> new_id_;  // by the rawlog's sensor id
  bool all_kept_ = true;
  std::map<int, Rigid> body_T_imu_;
  std::uint64_t scans_ = 0, other_objects_ = 0;
  std::string warned_of_;
};
}  // namespace

std::unique_ptr<SensorInput> makeRawlogInput(const std::filesystem::path& path, const std::vector<std::string>& only)
{
  return std::make_unique<RawlogInput>(path, only);
}
}  // namespace scanloom
