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
#include <sstream>
#include <string_view>

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

RangeLimits parseRanges(const std::string& text)
{
  std::istringstream stream(text);
  RangeLimits limits;
  std::string rest;
  if ((stream >> limits.least >> limits.most) && !(stream >> rest) && 0 <= limits.least && limits.least < limits.most)
    return limits;
  throw UsageError(fmt::format("--ranges \"{}\": must be two ranges in m, the least and the largest that stay", text));
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

/** By a trajectory, or by an IMU of the rawlog if the option's value is `imu` or `imu=LABEL`. */
std::function<RawlogOperation(const Header&)> deskewing(const std::string& by, const Path& input, Notify notice)
{
  constexpr std::string_view kImu = "imu=";
  const bool names_imu = by.rfind(kImu, 0) == 0;
  if (by == "imu" || names_imu)
    return [input, label = names_imu ? by.substr(kImu.size()) : kImuLabel,
            notice = std::move(notice)](const Header& header) { return deskewingByGyro(input, label, header, notice); };
  return [trajectory = readTrajectory(by, notice)](const Header& header) { return deskewClouds(trajectory, header); };
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
  if (!o.crop_box.empty())
    add(chosen, "--crop-box", [box = cropBox(o.crop_box)](const Header&) { return cropOut(box); });
  if (!o.ranges.empty())
    add(chosen, "--ranges",
        [limits = parseRanges(o.ranges)](const Header& header) { return limitRanges(limits, header); });
  if (o.voxel) add(chosen, "--voxel", [edge = *o.voxel](const Header&) { return thinClouds(edge); });
  if (!o.apply_extrinsics.empty())
    add(chosen, "--apply-extrinsics",
        [poses = readSensorPoses(o.apply_extrinsics)](const Header& header)
        { return applyExtrinsics(poses, required(header)); },
        {o.apply_extrinsics});
  if (!o.convert_clouds.empty())
    add(chosen, "--convert-clouds",
        [target = cloudClassOf(o.convert_clouds)](const Header&) { return convertClouds(target); });
  if (!o.deskew.empty()) add(chosen, "--deskew", deskewing(o.deskew, input, notice), {o.deskew});
}

/** `--export FORMAT=PATH`: a folder of clouds or tables, or a file of poses. */
EditOperation exporting(const std::string& text)
{
  const auto equals = text.find('=');
  const std::string format = text.substr(0, equals);
  const Path path = equals == std::string::npos ? "" : text.substr(equals + 1);
  const auto clouds = [&](CloudFormat of)
  {
    return EditOperation{"--export", {{}, path}, {}, [of](const Header& header, const EditOutputs& outputs) {
                           return exportClouds(of, outputs.folder, header);
                         }};
  };
  if (!path.empty())
  {
    if (format == "ply") return clouds(CloudFormat::Ply);
    if (format == "pcd") return clouds(CloudFormat::Pcd);
    if (format == "kitti") return clouds(CloudFormat::Kitti);
    if (format == "csv")
      return {"--export", {{}, path}, {}, [](const Header&, const EditOutputs& outputs) {
                return exportCsv(outputs.folder);
              }};
    if (format == "tum")
      return {"--export", {{path}, {}}, {}, [](const Header&, const EditOutputs& outputs) {
                return exportTum(outputs.files.front());
              }};
  }
  throw UsageError(fmt::format("--export {}: must be ply=DIR, pcd=DIR, kitti=DIR, csv=DIR or tum=FILE", text));
}

void chooseExports(const EditOptions& o, const Notify& notice, Chosen& chosen)
{
  if (!o.export_as.empty()) chosen.push_back(exporting(o.export_as));
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
