#include "mrpt/observations/RawlogInput.h"

#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "base/formats/SecondsText.h"
#include "mrpt/observations/RawlogReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
// An IMU that has no sample in so much of a rawlog is not used: it could not tell the start either.
constexpr Duration kProbed = 10s;
// So much later than a scan's end the file may hold its IMU samples: a live recorder writes a scan by its deadline.
constexpr Duration kLatest = 2s;
constexpr std::size_t kMostHeld = 100;  // scans, whatever their stamps say

/** The scan with the columns of those lidars only that have a new id. */
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

}  // namespace

RawlogInput::RawlogInput(const std::filesystem::path& path, const std::vector<std::string>& only)
  : reader_(std::make_unique<RawlogReader>(path))
{
  if (!reader_->header())
    throw std::runtime_error(
        fmt::format("{}: its first object is not scanloom's header, so nothing is known of its lidars: record it with "
                    "scanloom",
                    path.string()));
  bytes_ = std::filesystem::file_size(path);
  chooseLidars(only);
  probe(path);
}

RawlogInput::~RawlogInput() = default;

void RawlogInput::chooseLidars(const std::vector<std::string>& only)
{
  const RecordingHeader& recorded = *reader_->header();
  const std::vector<std::string> names = lidarNames(recorded);
  for (const std::string& name : only)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw ConfigError(fmt::format("no lidar of the rawlog is called '{}': {}", name, suggestion(name, names)));

  setup_.header = recorded;
  setup_.header.lidars.clear();
  new_id_.resize(kMostLidars);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (!only.empty() && std::find(only.begin(), only.end(), names[i]) == only.end()) continue;
    new_id_[i] = static_cast<std::uint8_t>(setup_.header.lidars.size());
    setup_.header.lidars.push_back(recorded.lidars[i]);
  }
  all_wanted_ = setup_.header.lidars.size() == names.size();
}

/** Which IMUs there are. Reads the beginning for itself, so that no scan needs to be kept. */
void RawlogInput::probe(const std::filesystem::path& path)
{
  RawlogReader beginning(path);
  std::optional<Timestamp> first;
  const std::size_t most = setup_.header.lidars.size() + 1;  // one in each lidar, and the body's
  while (setup_.body_T_imu.size() < most)
  {
    const auto event = beginning.next();
    if (!event) return;
    if (const auto* scan = std::get_if<RecordedScan>(&*event))
    {
      if (!first) first = scan->scan.start;
      if (scan->scan.start - *first > kProbed) return;
    }
    if (const auto* imu = std::get_if<RecordedImu>(&*event))
      if (const auto sensor = sensorOf(imu->label)) setup_.body_T_imu.emplace(*sensor, imu->body_T_imu);
  }
}

std::optional<SensorEvent> RawlogInput::next(Duration)
{
  while (!stop_ && (held_.empty() || !isFirstDue()))
  {
    std::optional<SensorEvent> event = read();
    if (!event) break;
    auto* scan = std::get_if<Scan>(&*event);
    if (!scan) return event;
    newest_end_ = std::max(newest_end_, scan->end());
    held_.push_back(std::move(*scan));
  }
  ended_ = stop_ || held_.empty();
  if (ended_) return std::nullopt;
  std::optional<SensorEvent> event(std::move(held_.front()));
  held_.pop_front();
  return event;
}

/** Whether the samples of the scan that is held longest were given, or are not to be expected. */
bool RawlogInput::isFirstDue() const
{
  const Scan& scan = held_.front();
  const bool time_goes_back = held_.size() > 1 && held_[1].start < scan.start;  // its stamp is wrong
  return setup_.body_T_imu.empty() || newest_sample_ >= scan.end() || newest_end_ > scan.end() + kLatest ||
         time_goes_back || held_.size() > kMostHeld;
}

std::optional<SensorEvent> RawlogInput::read()
{
  while (auto event = reader_->next())
  {
    if (auto* recorded = std::get_if<RecordedScan>(&*event))
    {
      if (!accepts(recorded->scan)) continue;
      ++scans_;
      return all_wanted_ ? std::move(recorded->scan) : keepLidars(std::move(recorded->scan), new_id_);
    }
    if (const auto* recorded = std::get_if<RecordedImu>(&*event))
      if (const auto sensor = sensorOf(recorded->label))
      {
        if (setup_.body_T_imu.count(*sensor) == 0)
        {
          ++late_imus_[recorded->label];
          continue;
        }
        newest_sample_ = std::max(newest_sample_, recorded->sample.stamp);
        return SensorImu{*sensor, recorded->sample};
      }
    if (const auto* other = std::get_if<OtherObservation>(&*event))
      if (auto mark = markIn(**other)) return *std::move(mark);
    ++other_objects_;
  }
  return std::nullopt;
}

bool RawlogInput::accepts(const Scan& scan)
{
  const std::size_t lidars = reader_->header()->lidars.size();
  if (scan.columns_of.size() <= lidars) return true;
  if (refused_scans_++ == 0)
    refusal_ = fmt::format(
        "the scan at {} s has points of sensor_id {}, but the header names {} lidars: such scans are "
        "left out",
        secondsText(scan.start), scan.columns_of.size() - 1, lidars);
  return false;
}

/** `imu` is the body's, `imu_<name>` a lidar's. */
std::optional<int> RawlogInput::sensorOf(const std::string& label) const
{
  if (label == kImuLabel) return SensorImu::kBody;
  const std::vector<RecordedLidar>& lidars = setup_.header.lidars;
  for (std::size_t i = 0; i < lidars.size(); ++i)
    if (label == std::string(kImuLabel) + "_" + lidars[i].name) return static_cast<int>(i);
  return std::nullopt;
}

double RawlogInput::progress() const
{
  return bytes_ > 0 ? std::min(1.0, static_cast<double>(reader_->bytesRead()) / static_cast<double>(bytes_)) : 0;
}

RigAccount RawlogInput::account() const
{
  RigAccount account;
  account.input = {{"rawlog_scans", scans_},
                   {"rawlog_other_objects", other_objects_},
                   {"rawlog_scans_refused", refused_scans_},
                   {kDamagedInputs, (reader_->damage().empty() ? 0U : 1U) + late_imus_.size()}};
  for (const auto& [label, samples] : late_imus_) account.input["rawlog_" + label + "_too_late"] = samples;
  return account;
}

std::vector<std::string> RawlogInput::takeWarnings()
{
  std::vector<std::string> warnings;
  if (const std::string refusal = std::exchange(refusal_, ""); !refusal.empty()) warnings.push_back(refusal);
  for (const auto& [label, samples] : late_imus_)
    if (reported_late_.insert(label).second)
      warnings.push_back(
          fmt::format("the IMU '{}' is not used: its first sample comes more than {:g} s after the first scan", label,
                      seconds(kProbed)));
  const std::string before = std::exchange(damage_, reader_->damage());
  if (damage_ != before) warnings.push_back(damage_);
  return warnings;
}
}  // namespace scanloom
