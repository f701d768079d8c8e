#include "EditOperations.h"

#include "config/ConfigError.h"
#include "config/Values.h"
#include "dataset/CloudObservation.h"
#include "dataset/CropClouds.h"
#include "dataset/KeepEvery.h"
#include "dataset/KeepLidars.h"
#include "dataset/MergeLidars.h"
#include "dataset/RawlogCut.h"
#include "dataset/RawlogLabels.h"
#include "dataset/SplitLidars.h"
#include "dataset/ThinClouds.h"
#include "dataset/TimeOffset.h"
#include "output/SecondsText.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>
#include <sstream>

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

Eigen::AlignedBox3f parseBox(const std::string& text)
{
  const UsageError mistake(fmt::format(
      "--crop-box \"{}\": must be \"x0 y0 z0 x1 y1 z1\" in m, the first corner below the second on each axis", text));
  std::array<double, 6> edges{};
  std::istringstream words(text);
  std::string word;
  for (double& edge : edges)
  {
    const auto number = words >> word ? parseNumber(word) : std::nullopt;
    if (!number) throw mistake;
    edge = *number;
  }
  const Eigen::Vector3d low(edges[0], edges[1], edges[2]), high(edges[3], edges[4], edges[5]);
  if (words >> word || !(low.array() < high.array()).all()) throw mistake;
  return {low.cast<float>(), high.cast<float>()};
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

std::set<std::string> asSet(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }
}  // namespace

void addEditOptions(CLI::App& app, EditOptions& options)
{
  const auto in = [](CLI::Option* option, const std::string& group) { return option->group(group); };
  const std::string cut = "Part of the input, alone or before an operation";
  in(app.add_option("--from-time", options.from_time, "from this stamp on, in s since 1970 (a scan's is its start)"),
     cut)
      ->type_name("S");
  in(app.add_option("--to-time", options.to_time, "up to this stamp and with it"), cut)->type_name("S");
  in(app.add_option("--from-index", options.from_index, "from this object on; the first is 0"), cut)->type_name("N");
  in(app.add_option("--to-index", options.to_index, "up to this object and with it"), cut)->type_name("N");

  const std::string one = "Operations";
  in(app.add_option("--keep-label", options.keep_label, "only observations with these labels, and the header"), one)
      ->delimiter(',')
      ->type_name("L,...");
  in(app.add_option("--remove-label", options.remove_label, "no observations with these labels"), one)
      ->delimiter(',')
      ->type_name("L,...");
  in(app.add_flag("--split-lidars", options.split_lidars, "of each cloud one per lidar, 'lidar_<name>'"), one);
  in(app.add_flag("--merge-lidars", options.merge_lidars, "undoes it: clouds of all lidars, in time order"), one);
  in(app.add_option("--keep-lidars", options.keep_lidars, "points and IMUs of these lidars only"), one)
      ->delimiter(',')
      ->type_name("NAME,...");
  in(app.add_option("--keep-every", options.keep_every, "one scan of so many; all else stays"), one)
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  in(app.add_option("--time-offset", options.time_offset, "s, added to the stamps of a label"), one)
      ->type_name("LABEL=S");
  in(app.add_option("--crop-box", options.crop_box, "removes the points inside this box of the body frame, in m"), one)
      ->type_name("\"X0 Y0 Z0 X1 Y1 Z1\"");
  in(app.add_option("--min-range", options.min_range, "removes points nearer to their lidar, in m"), one)
      ->check(CLI::NonNegativeNumber)
      ->type_name("M");
  in(app.add_option("--max-range", options.max_range, "removes points farther from their lidar, in m"), one)
      ->check(CLI::PositiveNumber)
      ->type_name("M");
  in(app.add_option("--voxel", options.voxel, "the first point of each cube with this edge, in m"), one)
      ->check(CLI::PositiveNumber)
      ->type_name("M");
}

std::vector<EditOperation> chosenOperations(const EditOptions& o)
{
  std::vector<EditOperation> chosen;
  const auto add = [&](const std::string& option, auto make) { chosen.push_back({option, std::move(make)}); };

  const RawlogSpan span = spanOf(o);
  if (!span.isWhole()) add("cut", [span](const Header&) { return cutTo(span); });
  if (!o.keep_label.empty())
    add("--keep-label", [labels = asSet(o.keep_label)](const Header&) { return keepLabels(labels); });
  if (!o.remove_label.empty())
    add("--remove-label", [labels = asSet(o.remove_label)](const Header&) { return removeLabels(labels); });
  if (o.split_lidars) add("--split-lidars", [](const Header& header) { return splitLidars(required(header)); });
  if (o.merge_lidars) add("--merge-lidars", [](const Header& header) { return mergeLidars(required(header)); });
  if (!o.keep_lidars.empty())
    add("--keep-lidars", [names = o.keep_lidars](const Header& header) { return keepLidars(names, required(header)); });
  if (o.keep_every) add("--keep-every", [n = *o.keep_every](const Header&) { return keepEvery(n); });
  if (!o.time_offset.empty())
    add("--time-offset", [shift = parseTimeOffset(o.time_offset)](const Header& header)
        { return addTimeOffset(shift.label, shift.offset, header ? header->period() : Duration{0}); });
  if (!o.crop_box.empty()) add("--crop-box", [box = parseBox(o.crop_box)](const Header&) { return cropOut(box); });
  if (o.min_range || o.max_range)
    add("--min-range/--max-range",
        [limits = rangesOf(o)](const Header& header) { return limitRanges(limits, header); });
  if (o.voxel) add("--voxel", [edge = *o.voxel](const Header&) { return thinClouds(edge); });
  return chosen;
}
}  // namespace scanloom
