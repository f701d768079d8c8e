#include "Reference.h"

#include "base/core/ConfigError.h"
#include "base/formats/TrajectoryReader.h"
#include "base/positions/TotalStation.h"
#include "input/bags/BagContents.h"
#include "input/rig/Extrinsics.h"

#include <fmt/format.h>

namespace scanloom
{
std::variant<PositionTrack, Trajectory> readReference(const std::filesystem::path& file, const std::string& topic,
                                                      const std::function<void(const std::string&)>& warn)
{
  if (isBag(file))
  {
    BagPoses found = readBagPoses({file}, topic);
    if (found.unreadable > 0)
      warn(fmt::format("{}: {} messages with poses cannot be read: left out", file.string(), found.unreadable));
    if (!found.have_rotations) return positionsOf(found.poses);
    return std::move(found.poses);
  }
  if (!topic.empty()) throw UsageError("--reference-topic is for a reference in a bag");
  if (isTotalStation(file)) return readTotalStation(file);
  return readTrajectory(file, warn);
}

Eigen::Vector3d leverArmOf(const std::string& text)
try
{
  return parsePose(text + " 0 0 0").translation;
}
catch (const std::invalid_argument&)
{
  throw UsageError(fmt::format("--lever-arm '{}': must be \"x y z\" in m", text));
}

std::string missingLeverArm(const EvaluationInput& input, const EvaluationOptions& options)
{
  const bool poses = std::holds_alternative<Trajectory>(input.reference);
  if (poses || !options.body_p_point.isZero()) return "";
  return "the reference has positions of a point of the machine, and they are compared with the body's origin: give "
         "--lever-arm \"x y z\" of the prism or antenna";
}

std::string tiltedReference(const Evaluation& about_z, const EvaluationInput& input, EvaluationOptions options)
{
  options.alignment = AlignmentKind::Se3;
  const Evaluation free = evaluate(input, options);
  const double up = (free.drift.alignment.reference_T_map.rotation * Eigen::Vector3d::UnitZ()).z();
  constexpr double kMostTilt = 0.8;        // cosine of 37 deg: of no level reference
  constexpr double kOfStraightLine = 100;  // the roll about it is arbitrary
  const bool tilted = up < kMostTilt && free.drift.alignment.condition < kOfStraightLine &&
                      2 * free.drift.largest < about_z.drift.largest;
  if (!tilted) return "";
  return fmt::format(
      "the reference's z is not up, as in poses of a camera: turned freely, the drift is {:.3f} m (--align se3)",
      free.drift.largest);
}
}  // namespace scanloom
