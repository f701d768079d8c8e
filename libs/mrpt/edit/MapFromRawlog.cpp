#include "mrpt/edit/MapFromRawlog.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/internal/DeskewClouds.h"
#include "mrpt/observations/Observations.h"

#include <memory>
#include <optional>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** Chooses one scan each time the body has travelled far enough. */
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
    removeImpossible(*points);
    latest_ = pose->translation;
    return Keyframe{stamp, *pose, std::move(*points)};
  }

  void requireSome() const
  {
    if (!latest_) throw std::runtime_error("no scan lies within the trajectory: are both from the same recording?");
  }

 private:
  KeyframeOptions options_;
  RecordingHeader header_;
  std::optional<Eigen::Vector3d> latest_;
};
}  // namespace

RawlogOperation toMaps(const std::shared_ptr<MapFiles>& files, const KeyframeOptions& options,
                       const RecordingHeader& header, std::function<void()> onKeyframe)
{
  auto choice = std::make_shared<KeyframeChoice>(options, header);
  const auto add = [choice, files, onKeyframe = std::move(onKeyframe)](const ObservationPtr& observation)
  {
    const std::optional<Keyframe> keyframe = choice->keyframeOf(observation);
    if (!keyframe) return;
    files->add(*keyframe);
    onKeyframe();
  };
  const auto close = [choice, files]
  {
    choice->requireSome();
    files->close();
  };
  return readOnly(add, close);
}
}  // namespace scanloom
