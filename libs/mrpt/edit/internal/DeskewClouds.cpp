#include "mrpt/edit/internal/DeskewClouds.h"

#include "base/formats/SecondsText.h"
#include "estimation/preprocessing/Deskew.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/observations/Observations.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
namespace
{
std::string spanText(Timestamp first, Timestamp last)
{
  return fmt::format("{} s to {} s", secondsText(first), secondsText(last));
}

class TrajectoryDeskew
{
 public:
  TrajectoryDeskew(Trajectory trajectory, std::optional<RecordingHeader> header)
    : trajectory_(std::move(trajectory)), header_(std::move(header))
  {
    if (trajectory_.empty()) throw std::invalid_argument("--deskew: the trajectory holds no pose");
  }

  Observations operator()(const ObservationPtr& observation)
  {
    if (!observation) return finish();
    const auto cloud = cloudIn(observation);
    if (!cloud) return {observation};
    const auto points = deskewed(*cloud, trajectory_, header_);
    if (points)
      ++deskewed_;
    else
      passOver(fromMrpt(cloud->timestamp));
    return points ? Observations{withPositions(*cloud, *points)} : Observations{};
  }

 private:
  void passOver(Timestamp stamp)
  {
    if (not_covered_++ == 0) first_ = stamp;
    last_ = stamp;
  }

  Observations finish() const
  {
    if (deskewed_ == 0 && not_covered_ > 0)
      throw std::runtime_error(fmt::format(
          "none of {} clouds ({}) lies within the trajectory ({}): are both from the same recording and clock?",
          not_covered_, spanText(first_, last_), spanText(trajectory_.front().stamp, trajectory_.back().stamp)));
    return {};
  }

  Trajectory trajectory_;
  std::optional<RecordingHeader> header_;
  std::uint64_t deskewed_ = 0, not_covered_ = 0;
  Timestamp first_{}, last_{};
};
}  // namespace

Scan timedScanOf(const mrpt::obs::CObservationPointCloud& cloud, const std::optional<RecordingHeader>& header)
{
  requireTimes(cloud);
  return fromObservation(cloud, header);
}

std::optional<PointCloud> deskewed(const mrpt::obs::CObservationPointCloud& cloud, const Trajectory& trajectory,
                                   const std::optional<RecordingHeader>& header)
{
  Scan scan = timedScanOf(cloud, header);
  const auto map_T_start = poseAt(trajectory, scan.start);
  if (!map_T_start) return std::nullopt;
  const Rigid start_T_map = map_T_start->inverse();
  std::vector<Rigid> start_T_column;
  for (const Column& column : scan.columns)
  {
    const auto map_T_column = poseAt(trajectory, column.stamp);
    if (!map_T_column) return std::nullopt;
    start_T_column.push_back(start_T_map * *map_T_column);
  }
  return deskew(std::move(scan), start_T_column);
}

RawlogOperation deskewClouds(const Trajectory& trajectory, const std::optional<RecordingHeader>& header)
{
  return TrajectoryDeskew(trajectory, header);
}
}  // namespace scanloom
