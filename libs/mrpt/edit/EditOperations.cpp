#include "mrpt/edit/EditOperations.h"

#include "base/config/Values.h"
#include "base/core/ConfigError.h"
#include "base/formats/SecondsText.h"
#include "base/formats/TrajectoryReader.h"
#include "estimation/preprocessing/LidarBox.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/edit/internal/ApplyExtrinsics.h"
#include "mrpt/edit/internal/ConvertClouds.h"
#include "mrpt/edit/internal/CropClouds.h"
#include "mrpt/edit/internal/DeskewByGyro.h"
#include "mrpt/edit/internal/DeskewClouds.h"
#include "mrpt/edit/internal/ExportClouds.h"
#include "mrpt/edit/internal/ExportTables.h"
#include "mrpt/edit/internal/GyroBias.h"
#include "mrpt/edit/internal/KeepEvery.h"
#include "mrpt/edit/internal/KeepLidars.h"
#include "mrpt/edit/internal/MergeLidars.h"
#include "mrpt/edit/internal/RawlogCut.h"
#include "mrpt/edit/internal/RawlogLabels.h"
#include "mrpt/edit/internal/RebatchClouds.h"
#include "mrpt/edit/internal/SplitLidars.h"
#include "mrpt/edit/internal/ThinClouds.h"
#include "mrpt/edit/internal/TimeOffset.h"
#include "mrpt/edit/internal/ToMcap.h"
#include "mrpt/observations/Observations.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace scanloom
{
namespace
{
using Header = std::optional<RecordingHeader>;
using Path = std::filesystem::path;
using Notify = std::function<void(const std::string&)>;

std::optional<Timestamp> parseTime(const std::string& option, const std::string& text)
{
  if (text.empty()) return std::nullopt;
  const auto time = parseSeconds(text);
  if (!time) throw UsageError(fmt::format("{} {}: must be seconds since 1970, e.g. 1750000000.25", option, text));
  return time;
}

RawlogSpan spanOf(const EditOptions& options)
{
  const RawlogSpan span{parseTime("--from-time", options.from_time), parseTime("--to-time", options.to_time),
                        options.from_index, options.to_index};
  const bool empty = (span.from_time && span.to_time && *span.from_time > *span.to_time) ||
                     (span.from_index && span.to_index && *span.from_index > *span.to_index);
  if (empty) throw UsageError("the cut is empty: its --from is after its --to");
  return span;
}

Eigen::AlignedBox3f cropBox(const std::string& text)
{
  if (const auto box = parseBox(text)) return box->cast<float>();
  throw UsageError(
      fmt::format("--crop-box \"{}\": must be \"x0 y0 z0 x1 y1 z1\" in m, with x0 < x1, y0 < y1 and z0 < z1", text));
}

struct LabelOffset
{
  std::string label;
  Duration offset;
};
LabelOffset parseTimeOffset(const std::string& text)
{
  constexpr double kLargest = 9e9;  // s: what 64 bits of nanoseconds hold
  const auto equals = text.rfind('=');
  const auto offset = equals == std::string::npos ? std::nullopt : parseNumber(text.substr(equals + 1));
  if (!offset || equals == 0 || std::abs(*offset) > kLargest)
    throw UsageError(fmt::format("--time-offset {}: must be LABEL=SECONDS, e.g. imu=-0.02", text));
  return {text.substr(0, equals), fromSeconds(*offset)};
}

RangeLimits rangesOf(const EditOptions& options)
{
  RangeLimits limits;
  limits.least = options.min_range.value_or(limits.least);
  limits.most = options.max_range.value_or(limits.most);
  if (limits.least > limits.most) throw UsageError("--min-range is above --max-range: no point would be left");
  return limits;
}

CloudClass cloudClassOf(const std::string& name)
{
  try
  {
    return cloudClassFromName(name);
  }
  catch (const std::invalid_argument& e)
  {
    throw UsageError(fmt::format("--convert-clouds {}: {}", name, e.what()));
  }
}

RawlogOperation deskewingByGyro(const Path& input, const std::string& label, const Header& header, const Notify& notice)
{
  const auto rest = gyroBiasIn(input, label);
  if (!rest)
  {
    notice(fmt::format(
        "warning: '{}' is never at rest for long enough: the bias of its gyroscope is unknown and not subtracted",
        label));
    return deskewByGyro({label}, header);
  }
  const Eigen::Vector3d deg_per_s = rest->bias * 180 / M_PI;
  notice(fmt::format("gyroscope of '{}' at rest up to {} s: bias {:.4f} {:.4f} {:.4f} deg/s is subtracted", label,
                     secondsText(rest->until), deg_per_s.x(), deg_per_s.y(), deg_per_s.z()));
  return deskewByGyro({label, rest->bias}, header);
}

/** By a trajectory, or by the rawlog's own IMU if the option's value is `imu`. */
std::function<RawlogOperation(const Header&)> deskewing(const EditOptions& options, const Path& input, Notify notice)
{
  if (options.deskew == "imu")
    return [input, label = options.imu.empty() ? kImuLabel : options.imu,
            notice = std::move(notice)](const Header& header) { return deskewingByGyro(input, label, header, notice); };
  return [trajectory = readTrajectory(options.deskew, notice)](const Header& header)
  { return deskewClouds(trajectory, header); };
}

std::set<std::string> asSet(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

using Chosen = std::vector<EditOperation>;

void add(Chosen& chosen, const std::string& option, std::function<RawlogOperation(const Header&)> make,
         std::vector<Path> inputs = {})
{
  chosen.push_back({option, {}, std::move(inputs), [make = std::move(make)](const Header& header, const EditOutputs&) {
                      return make(header);
                    }});
}

void chooseObservations(const EditOptions& o, Chosen& chosen)
{
  const RawlogSpan span = spanOf(o);
  if (!span.isWhole()) add(chosen, "cut", [span](const Header&) { return cutTo(span); });
  if (!o.keep_label.empty())
    add(chosen, "--keep-label", [labels = asSet(o.keep_label)](const Header&) { return keepLabels(labels); });
  if (!o.remove_label.empty())
    add(chosen, "--remove-label", [labels = asSet(o.remove_label)](const Header&) { return removeLabels(labels); });
  if (o.split_lidars) add(chosen, "--split-lidars", [](const Header& header) { return splitLidars(required(header)); });
  if (o.merge_lidars) add(chosen, "--merge-lidars", [](const Header& header) { return mergeLidars(required(header)); });
  if (!o.keep_lidars.empty())
    add(chosen, "--keep-lidars",
        [names = o.keep_lidars](const Header& header) { return keepLidars(names, required(header)); });
  if (o.keep_every) add(chosen, "--keep-every", [n = *o.keep_every](const Header&) { return keepEvery(n); });
  if (!o.time_offset.empty())
    add(chosen, "--time-offset",
        [shift = parseTimeOffset(o.time_offset)](const Header& header)
        { return addTimeOffset(shift.label, shift.offset, header ? header->period() : Duration{0}); });
  if (o.rebatch)
    add(chosen, "--rebatch", [rate = *o.rebatch](const Header& header) { return rebatch(rate, required(header)); });
}

void choosePoints(const EditOptions& o, const Path& input, const Notify& notice, Chosen& chosen)
{
  if (!o.imu.empty() && o.deskew != "imu") throw UsageError("--imu names the IMU for '--deskew imu'");
  if (!o.crop_box.empty())
    add(chosen, "--crop-box", [box = cropBox(o.crop_box)](const Header&) { return cropOut(box); });
  if (o.min_range || o.max_range)
    add(chosen, "--min-range/--max-range",
        [limits = rangesOf(o)](const Header& header) { return limitRanges(limits, header); });
  if (o.voxel) add(chosen, "--voxel", [edge = *o.voxel](const Header&) { return thinClouds(edge); });
  if (!o.apply_extrinsics.empty())
    add(chosen, "--apply-extrinsics",
        [poses = readSensorPoses(o.apply_extrinsics)](const Header& header)
        { return applyExtrinsics(poses, required(header)); },
        {o.apply_extrinsics});
  if (!o.convert_clouds.empty())
    add(chosen, "--convert-clouds",
        [target = cloudClassOf(o.convert_clouds)](const Header&) { return convertClouds(target); });
  if (!o.deskew.empty()) add(chosen, "--deskew", deskewing(o, input, notice), {o.deskew});
}

void chooseExports(const EditOptions& o, const Notify& notice, Chosen& chosen)
{
  using Make = std::function<RawlogOperation(const Header&, const EditOutputs&)>;
  const auto addFolder = [&](const std::string& option, const Path& folder, Make make)
  {
    if (!folder.empty()) chosen.push_back({option, {{}, folder}, {}, std::move(make)});
  };
  const auto addClouds = [&](const std::string& option, const Path& folder, CloudFormat format)
  {
    addFolder(option, folder,
              [format](const Header& header, const EditOutputs& outputs)
              { return exportClouds(format, outputs.folder, header); });
  };
  addClouds("--export-ply", o.export_ply, CloudFormat::Ply);
  addClouds("--export-pcd", o.export_pcd, CloudFormat::Pcd);
  addClouds("--export-kitti", o.export_kitti, CloudFormat::Kitti);
  addFolder("--export-csv", o.export_csv,
            [](const Header&, const EditOutputs& outputs) { return exportCsv(outputs.folder); });
  if (!o.export_tum.empty())
    chosen.push_back({"--export-tum", {{o.export_tum}, {}}, {}, [](const Header&, const EditOutputs& outputs) {
                        return exportTum(outputs.files.front());
                      }});
  if (!o.to_mcap.empty())
    chosen.push_back({"--to-mcap",
                      {{o.to_mcap}, {}},
                      o.trajectory.empty() ? std::vector<Path>() : std::vector<Path>{o.trajectory},
                      [poses = o.trajectory.empty() ? Trajectory() : readTrajectory(o.trajectory, notice)](
                          const Header& header, const EditOutputs& outputs)
                      { return toMcap(outputs.files.front(), poses, header); }});
}
}  // namespace

std::vector<EditOperation> editOperations(const EditOptions& options, const Path& input, const Notify& notice)
{
  Chosen chosen;
  chooseObservations(options, chosen);
  choosePoints(options, input, notice, chosen);
  chooseExports(options, notice, chosen);
  return chosen;
}

RawlogOperation chained(const std::vector<EditOperation>& operations, const Path& input, const EditOutputs& outputs)
{
  const Header header = headerOf(input);
  RawlogOperation all = operations.front().make(header, outputs);
  for (std::size_t i = 1; i < operations.size(); ++i)
    all = chained(std::move(all), operations[i].make(header, outputs));
  return all;
}
}  // namespace scanloom
