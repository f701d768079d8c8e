#include "mrpt/edit/internal/ExportTables.h"

#include "base/core/OutputFile.h"
#include "base/core/csvField.h"
#include "base/core/fileNameOf.h"
#include "base/formats/ImuCsv.h"
#include "base/formats/Trajectory.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/observations/Observations.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <memory>
#include <optional>
#include <set>
#include <stdexcept>

namespace scanloom
{
namespace
{
class ImuTable
{
 public:
  explicit ImuTable(const std::filesystem::path& path) : file_(path), writer_(file_.temporary()) {}

  void add(const ImuSample& sample) { writer_.add(sample); }

  void close()
  {
    writer_.close();
    file_.commit();
  }

 private:
  OutputFile file_;
  ImuCsvWriter writer_;
};

class CsvExport
{
 public:
  explicit CsvExport(const std::filesystem::path& folder) : folder_(folder), clouds_(folder / "clouds.csv")
  {
    clouds_.stream() << "#timestamp [ns],label,points\n";
  }

  void add(const ObservationPtr& observation)
  {
    const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get());
    const auto recorded = imu ? fromObservation(*imu) : std::nullopt;
    if (recorded)
      imus_.try_emplace(recorded->label, folder_ / (fileNameOf(recorded->label) + ".csv"))
          .first->second.add(recorded->sample);
    if (const auto cloud = cloudIn(observation))
      fmt::print(clouds_.stream(), "{},{},{}\n", nanoseconds(fromMrpt(cloud->timestamp)), csvField(cloud->sensorLabel),
                 cloud->pointcloud->size());
  }

  void close()
  {
    for (auto& [label, table] : imus_) table.close();
    clouds_.commit();
  }

 private:
  std::filesystem::path folder_;
  OutputFile clouds_;
  std::map<std::string, ImuTable> imus_;
};

class TumExport
{
 public:
  explicit TumExport(const std::filesystem::path& path) : writer_(path) {}

  void add(const mrpt::obs::CObservation& observation)
  {
    const auto pose = robotPoseIn(observation);
    if (!pose) return;
    const Timestamp stamp = fromMrpt(observation.timestamp);
    if (!labels_.empty() && stamp <= latest_)
      throw std::runtime_error(
          fmt::format("stamps of the poses '{}' do not rise: they are no trajectory", observation.sensorLabel));
    latest_ = stamp;
    labels_.insert(observation.sensorLabel);
    writer_.add({stamp, *pose});
  }

  void close()
  {
    if (labels_.empty())
      throw std::runtime_error("the rawlog holds no poses (CObservationRobotPose, CObservationOdometry)");
    if (labels_.size() > 1)
      throw std::runtime_error(
          fmt::format("poses of {} labels ('{}', '{}', ...) are no trajectory: keep one label with --keep-label first",
                      labels_.size(), *labels_.begin(), *std::next(labels_.begin())));
    writer_.close();
  }

 private:
  TumWriter writer_;
  std::set<std::string> labels_;
  Timestamp latest_;
};
}  // namespace

std::optional<Rigid> robotPoseIn(const mrpt::obs::CObservation& observation)
{
  if (const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation))
    return fromMrpt(pose->pose.mean);
  if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation))
    return fromMrpt(mrpt::poses::CPose3D(odometry->odometry));
  return std::nullopt;
}

RawlogOperation exportCsv(const std::filesystem::path& folder)
{
  std::filesystem::create_directories(folder);
  auto csv = std::make_shared<CsvExport>(folder);
  return readOnly([csv](const ObservationPtr& observation) { csv->add(observation); }, [csv] { csv->close(); });
}

RawlogOperation exportTum(const std::filesystem::path& file)
{
  auto tum = std::make_shared<TumExport>(file);
  return readOnly([tum](const ObservationPtr& observation) { tum->add(*observation); }, [tum] { tum->close(); });
}
}  // namespace scanloom
