#include "EditOperations.h"

#include "config/ConfigError.h"
#include "config/Values.h"
#include "dataset/ApplyExtrinsics.h"
#include "dataset/CloudObservation.h"
#include "dataset/ConvertClouds.h"
#include "dataset/CropClouds.h"
#include "dataset/DeskewByGyro.h"
#include "dataset/DeskewClouds.h"
#include "dataset/ExportClouds.h"
#include "dataset/ExportTables.h"
#include "dataset/GyroBias.h"
#include "dataset/KeepEvery.h"
#include "dataset/KeepLidars.h"
#include "dataset/MapFromRawlog.h"
#include "dataset/MergeLidars.h"
#include "dataset/RawlogCut.h"
#include "dataset/RawlogLabels.h"
#include "dataset/RebatchClouds.h"
#include "dataset/SplitLidars.h"
#include "dataset/ThinClouds.h"
#include "dataset/TimeOffset.h"
#include "mrpt_bridge/Observations.h"
#include "output/SecondsText.h"
#include "output/TrajectoryReader.h"
#include "preprocessing/LidarBox.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace scanloom
{
namespace
{
using Header = std::optional<RecordingHeader>;

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
  if (empty) throw UsageError("the cut is empty: its --from lies behind its --to");
  return span;
}

Eigen::AlignedBox3f cropBox(const std::string& text)
{
  if (const auto box = parseBox(text)) return box->cast<float>();
  throw UsageError(fmt::format(
      "--crop-box \"{}\": must be \"x0 y0 z0 x1 y1 z1\" in m, the first corner below the second on each axis", text));
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

KeyframeOptions keyframesOf(const EditOptions& options)
{
  if (options.trajectory.empty()) throw UsageError("--to-simplemap and --to-octomap need --trajectory FILE");
  return {readTrajectory(options.trajectory), options.keyframe_distance};
}

RawlogOperation deskewingByGyro(const std::filesystem::path& input, const std::string& label, const Header& header)
{
  const auto rest = gyroBiasIn(input, label);
  if (!rest)
  {
    fmt::print(stderr,
               "warning: '{}' is never at rest for long enough: the bias of its gyroscope is not known, and stays in\n",
               label);
    return deskewByGyro({label}, header);
  }
  const Eigen::Vector3d deg_per_s = rest->bias * 180 / M_PI;
  fmt::print(stderr, "gyroscope of '{}' at rest up to {} s: {:.4f} {:.4f} {:.4f} deg/s, taken away\n", label,
             secondsText(rest->until), deg_per_s.x(), deg_per_s.y(), deg_per_s.z());
  return deskewByGyro({label, rest->bias}, header);
}

/** By a trajectory, or by the word `imu`. */
std::function<RawlogOperation(const Header&)> deskewing(const EditOptions& options, const std::filesystem::path& input)
{
  if (options.deskew == "imu")
    return [input, label = options.imu.empty() ? kImuLabel : options.imu](const Header& header)
    { return deskewingByGyro(input, label, header); };
  return [trajectory = readTrajectory(options.deskew)](const Header& header)
  { return deskewClouds(trajectory, header); };
}

std::set<std::string> asSet(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

const std::string kCut = "Part of the input, alone or before an operation";
const std::string kOne = "Operations";
const std::string kMaps = "For --to-simplemap and --to-octomap";

CLI::Option* in(CLI::Option* option, const std::string& group) { return option->group(group); }

void addCut(CLI::App& app, EditOptions& options)
{
  in(app.add_option("--from-time", options.from_time, "from this stamp on, in s since 1970 (a scan's is its start)"),
     kCut)
      ->type_name("S");
  in(app.add_option("--to-time", options.to_time, "up to this stamp and with it"), kCut)->type_name("S");
  in(app.add_option("--from-index", options.from_index, "from this object on; the first is 0"), kCut)->type_name("N");
  in(app.add_option("--to-index", options.to_index, "up to this object and with it"), kCut)->type_name("N");
}

void addChoicesOfObservations(CLI::App& app, EditOptions& options)
{
  in(app.add_option("--keep-label", options.keep_label, "only observations with these labels, and the header"), kOne)
      ->delimiter(',')
      ->type_name("L,...");
  in(app.add_option("--remove-label", options.remove_label, "no observations with these labels"), kOne)
      ->delimiter(',')
      ->type_name("L,...");
  in(app.add_flag("--split-lidars", options.split_lidars, "of each cloud one per lidar, 'lidar_<name>'"), kOne);
  in(app.add_flag("--merge-lidars", options.merge_lidars, "undoes it: clouds of all lidars, in time order"), kOne);
  in(app.add_option("--keep-lidars", options.keep_lidars, "points and IMUs of these lidars only"), kOne)
      ->delimiter(',')
      ->type_name("NAME,...");
  in(app.add_option("--keep-every", options.keep_every, "one scan of so many; all else stays"), kOne)
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  in(app.add_option("--time-offset", options.time_offset, "s, added to the stamps of a label"), kOne)
      ->type_name("LABEL=S");
  in(app.add_option("--rebatch", options.rebatch, "scans at this rate, in Hz"), kOne)
      ->check(CLI::Range(0.1, 1000.0))
      ->type_name("HZ");
}

void addChangesOfPoints(CLI::App& app, EditOptions& options)
{
  in(app.add_option("--crop-box", options.crop_box, "removes the points inside this box of the body frame, in m"), kOne)
      ->type_name("\"X0 Y0 Z0 X1 Y1 Z1\"");
  in(app.add_option("--min-range", options.min_range, "removes points nearer to their lidar, in m"), kOne)
      ->check(CLI::NonNegativeNumber)
      ->type_name("M");
  in(app.add_option("--max-range", options.max_range, "removes points farther from their lidar, in m"), kOne)
      ->check(CLI::PositiveNumber)
      ->type_name("M");
  in(app.add_option("--voxel", options.voxel, "the first point of each cube with this edge, in m"), kOne)
      ->check(CLI::PositiveNumber)
      ->type_name("M");
  in(app.add_option("--apply-extrinsics", options.apply_extrinsics,
                    "other poses of the sensors: lines 'T_body_<name> ...', or a configuration (.ini)"),
     kOne)
      ->type_name("FILE");
  in(app.add_option("--convert-clouds", options.convert_clouds, "CGenericPointsMap or CPointsMapXYZI"), kOne)
      ->type_name("CLASS");
  in(app.add_option("--deskew", options.deskew,
                    "clouds as seen at their stamps, by the motion of a trajectory (TUM, EuRoC or KITTI), or by the "
                    "rawlog's own IMU: its rotation only"),
     kOne)
      ->type_name("FILE|imu");
  in(app.add_option("--imu", options.imu, "for '--deskew imu': label of the IMU, if not imu; e.g. imu_left"), kOne)
      ->type_name("LABEL");
}

void addFiles(CLI::App& app, EditOptions& options)
{
  in(app.add_option("--export-ply", options.export_ply, "a PLY per cloud, in a folder per label"), kOne)
      ->type_name("DIR");
  in(app.add_option("--export-pcd", options.export_pcd, "a PCD per cloud"), kOne)->type_name("DIR");
  in(app.add_option("--export-kitti", options.export_kitti, "a KITTI scan (.bin) per cloud"), kOne)->type_name("DIR");
  in(app.add_option("--export-csv", options.export_csv, "IMUs as EuRoC csv, stamps and sizes of clouds"), kOne)
      ->type_name("DIR");
  in(app.add_option("--export-tum", options.export_tum, "poses that the rawlog holds, as TUM"), kOne)
      ->type_name("FILE");
  in(app.add_option("--to-simplemap", options.to_simplemap, "keyframes along --trajectory"), kOne)->type_name("FILE");
  in(app.add_option("--to-octomap", options.to_octomap, "occupancy along --trajectory: this .bt, and .ot beside it"),
     kOne)
      ->type_name("FILE");
  in(app.add_option("--trajectory", options.trajectory,
                    "the body's poses as TUM, EuRoC (.csv) or KITTI (times.txt beside it)"),
     kMaps)
      ->type_name("FILE");
  in(app.add_option("--keyframe-distance", options.keyframe_distance, "travel between keyframes, in m"), kMaps)
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->type_name("M");
  in(app.add_option("--octomap-preset", options.octomap_preset, "preview, inventory or fine"), kMaps)
      ->check(CLI::IsMember({"preview", "inventory", "fine"}))
      ->capture_default_str()
      ->type_name("NAME");
}

using Chosen = std::vector<EditOperation>;

void add(Chosen& chosen, const std::string& option, std::function<RawlogOperation(const Header&)> make)
{
  chosen.push_back({option, {}, {}, std::move(make)});
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

void choosePoints(const EditOptions& o, const std::filesystem::path& input, Chosen& chosen)
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
        { return applyExtrinsics(poses, required(header)); });
  if (!o.convert_clouds.empty())
    add(chosen, "--convert-clouds",
        [target = cloudClassOf(o.convert_clouds)](const Header&) { return convertClouds(target); });
  if (!o.deskew.empty()) add(chosen, "--deskew", deskewing(o, input));
}

void chooseFiles(const EditOptions& o, Chosen& chosen)
{
  using Path = std::filesystem::path;
  const auto addExport = [&](const std::string& option, const Path& folder, CloudFormat format)
  {
    if (folder.empty()) return;
    chosen.push_back({option, {}, folder, [=](const Header& header) { return exportClouds(format, folder, header); }});
  };
  addExport("--export-ply", o.export_ply, CloudFormat::Ply);
  addExport("--export-pcd", o.export_pcd, CloudFormat::Pcd);
  addExport("--export-kitti", o.export_kitti, CloudFormat::Kitti);
  if (!o.export_csv.empty())
    chosen.push_back({"--export-csv", {}, o.export_csv, [=](const Header&) { return exportCsv(o.export_csv); }});
  if (!o.export_tum.empty())
    chosen.push_back({"--export-tum", {o.export_tum}, {}, [=](const Header&) { return exportTum(o.export_tum); }});
  if (!o.to_simplemap.empty())
    chosen.push_back({"--to-simplemap",
                      {o.to_simplemap},
                      {},
                      [path = o.to_simplemap, keyframes = keyframesOf(o)](const Header& header)
                      { return toSimpleMap(path, keyframes, required(header)); }});
  if (!o.to_octomap.empty())
    chosen.push_back({"--to-octomap",
                      {o.to_octomap, Path(o.to_octomap).replace_extension(".ot")},
                      {},
                      [path = o.to_octomap, preset = octoMapPreset(o.octomap_preset), keyframes = keyframesOf(o)](
                          const Header& header) { return toOctoMap(path, preset, keyframes, required(header)); }});
}
}  // namespace

void addEditOptions(CLI::App& app, EditOptions& options)
{
  addCut(app, options);
  addChoicesOfObservations(app, options);
  addChangesOfPoints(app, options);
  addFiles(app, options);
}

std::vector<EditOperation> chosenOperations(const EditOptions& options, const std::filesystem::path& input)
{
  Chosen chosen;
  chooseObservations(options, chosen);
  choosePoints(options, input, chosen);
  chooseFiles(options, chosen);
  return chosen;
}
}  // namespace scanloom
