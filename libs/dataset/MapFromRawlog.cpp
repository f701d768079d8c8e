#include "dataset/MapFromRawlog.h"

#include "dataset/CloudObservation.h"
#include "dataset/DeskewClouds.h"
#include "mrpt_bridge/Conversions.h"
#include "mrpt_bridge/Observations.h"
#include "preprocessing/Thin.h"

#include <memory>
#include <optional>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** Whole scans, deskewed, one each time the body has moved on. */
class KeyframeChoice
{
 public:
  KeyframeChoice(KeyframeOptions options, RecordingHeader header)
    : options_(std::move(options)), header_(std::move(header))
  {
  }

  std::optional<Keyframe> keyframeOf(const ObservationPtr& observation)
  {
    const auto cloud = cloudIn(observation);
    if (!cloud || isSlice(*cloud)) return std::nullopt;
    const Timestamp stamp = fromMrpt(cloud->timestamp);
    const auto pose = poseAt(options_.trajectory, stamp);
    if (!pose || (latest_ && (pose->translation - *latest_).norm() < options_.distance)) return std::nullopt;
    auto points = deskewed(*cloud, options_.trajectory, header_);
    if (!points) return std::nullopt;
    latest_ = pose->translation;
    return Keyframe{stamp, *pose, std::move(*points)};
  }

  void requireSome() const
  {
    if (!latest_) throw std::runtime_error("no scan lies within the trajectory: are both of one recording?");
  }

 private:
  KeyframeOptions options_;
  RecordingHeader header_;
  std::optional<Eigen::Vector3d> latest_;
};
}  // namespace

RawlogOperation overKeyframes(const KeyframeOptions& options, const RecordingHeader& header,
                              std::function<void(Keyframe)> add, std::function<void()> close)
{
  return [choice = KeyframeChoice(options, header), add = std::move(add),
          close = std::move(close)](const ObservationPtr& observation) mutable
  {
    if (!observation)
    {
      choice.requireSome();
      close();
    }
    else if (auto keyframe = choice.keyframeOf(observation))
      add(std::move(*keyframe));
    return Observations{};
  };
}

RawlogOperation toSimpleMap(const std::filesystem::path& path, const KeyframeOptions& options,
                            const RecordingHeader& header)
{
  auto map = std::make_shared<SimpleMapBuilder>(mountedLidars(header.lidars));
  return overKeyframes(
      options, header, [map](const Keyframe& keyframe) { map->add(keyframe); }, [map, path] { map->write(path); });
}

RawlogOperation toOctoMap(const std::filesystem::path& binary, const OctoMapOptions& map_options,
                          const KeyframeOptions& options, const RecordingHeader& header)
{
  auto map = std::make_shared<OctoMapBuilder>(map_options, posesOf(mountedLidars(header.lidars)));
  std::filesystem::path full = binary;
  full.replace_extension(".ot");
  return overKeyframes(
      options, header,
      [map, edge = map_options.resolution](Keyframe keyframe)
      {
        keyframe.points = thin(std::move(keyframe.points), edge);
        map->add(keyframe);
      },
      [map, binary, full] { std::move(*map).write(binary, full); });
}
}  // namespace scanloom
