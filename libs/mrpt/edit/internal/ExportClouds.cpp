#include "mrpt/edit/internal/ExportClouds.h"

#include "base/core/OutputFile.h"
#include "base/core/fileNameOf.h"
#include "base/formats/CloudWriter.h"
#include "base/formats/KittiWriter.h"
#include "base/formats/SecondsText.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/observations/Observations.h"

#include <fmt/format.h>

#include <memory>

namespace scanloom
{
namespace
{
/** The clouds of one label. */
class CloudFolder
{
 public:
  CloudFolder(CloudFormat format, const std::filesystem::path& folder)
    : format_(format),
      clouds_(format == CloudFormat::Kitti ? folder / "velodyne" : folder),
      times_((std::filesystem::create_directories(clouds_), folder / "times.txt"))
  {
  }

  void add(const Scan& scan)
  {
    const std::string name = fmt::format("{:06}", count_++);
    if (format_ == CloudFormat::Kitti)
      writeKittiScan(clouds_ / (name + ".bin"), scan.points);
    else
      writeCloud(clouds_ / (name + (format_ == CloudFormat::Ply ? ".ply" : ".pcd")), scan);
    times_.stream() << secondsText(scan.start) << '\n';
  }

  void close() { times_.commit(); }

 private:
  static void writeCloud(const std::filesystem::path& path, const Scan& scan)
  {
    CloudWriter writer(path);
    writer.add(scan.points, scan.start, Rigid::identity());
    writer.close();
  }

  CloudFormat format_;
  std::filesystem::path clouds_;
  OutputFile times_;
  std::uint64_t count_ = 0;
};
}  // namespace

RawlogOperation exportClouds(CloudFormat format, const std::filesystem::path& folder,
                             const std::optional<RecordingHeader>& header)
{
  auto folders = std::make_shared<std::map<std::string, CloudFolder>>();
  const auto add = [format, folder, header, folders](const ObservationPtr& observation)
  {
    const auto cloud = cloudIn(observation);
    if (!cloud || isSlice(*cloud)) return;
    const std::string& label = cloud->sensorLabel;
    auto found = folders->find(label);
    if (found == folders->end()) found = folders->try_emplace(label, format, folder / fileNameOf(label)).first;
    found->second.add(fromObservation(*cloud, header));
  };
  const auto close = [folders]
  {
    for (auto& [label, clouds] : *folders) clouds.close();
  };
  return readOnly(add, close);
}
}  // namespace scanloom
