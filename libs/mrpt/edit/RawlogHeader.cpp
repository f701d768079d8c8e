#include "mrpt/edit/RawlogHeader.h"

#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/RawlogReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace scanloom
{
namespace
{
std::string suffixOf(const std::string& lidar) { return "_" + lidar; }

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

struct SliceLabel
{
  std::string stem, suffix;
};
SliceLabel withoutSliceSuffix(const std::string& label)
{
  if (!endsWith(label, kSliceSuffix)) return {label, ""};
  return {label.substr(0, label.size() - std::strlen(kSliceSuffix)), kSliceSuffix};
}
}  // namespace

const RecordingHeader& required(const std::optional<RecordingHeader>& header)
{
  if (!header)
    throw std::invalid_argument(
        "the rawlog's first object is not scanloom's header, so its lidars are unknown: record it with scanloom");
  return *header;
}

std::optional<RecordingHeader> headerOf(const std::filesystem::path& path)
{
  const ObservationPtr first = ObservationReader(path).next();
  return first ? headerIn(*first) : std::nullopt;
}

ObservationPtr withHeader(const mrpt::obs::CObservation& comment, const RecordingHeader& header)
{
  const auto changed = toObservation(header, fromMrpt(comment.timestamp));
  changed->sensorLabel = comment.sensorLabel;
  return changed;
}

std::size_t lidarNamed(const std::string& name, const RecordingHeader& header)
{
  const std::vector<std::string> names = lidarNames(header);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw UsageError(fmt::format("the rawlog has no lidar '{}': {}", name, suggestion(name, names)));
  return static_cast<std::size_t>(found - names.begin());
}

std::string labelOfPart(const std::string& whole, const std::string& lidar)
{
  const SliceLabel label = withoutSliceSuffix(whole);
  return label.stem + suffixOf(lidar) + label.suffix;
}

std::optional<LidarPart> partOf(const std::string& label, const RecordingHeader& header)
{
  const SliceLabel parts = withoutSliceSuffix(label);
  std::optional<LidarPart> part;
  std::size_t longest = 0;  // lidar_front_left ends in the names of both lidars 'left' and 'front_left'
  for (std::size_t i = 0; i < header.lidars.size(); ++i)
  {
    const std::string suffix = suffixOf(header.lidars[i].name);
    if (!endsWith(parts.stem, suffix) || suffix.size() <= longest) continue;
    longest = suffix.size();
    part = LidarPart{parts.stem.substr(0, parts.stem.size() - suffix.size()) + parts.suffix, i};
  }
  return part;
}
}  // namespace scanloom
