#include "calibration/ImuExtrinsicsReport.h"

#include "base/core/Angle.h"
#include "calibration/internal/ExtrinsicsNumbers.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace scanloom
{
namespace
{
const char* toString(ImuExtrinsicsOutcome outcome)
{
  switch (outcome)
  {
    case ImuExtrinsicsOutcome::Estimated:
      return "ESTIMATED";
    case ImuExtrinsicsOutcome::Open:
      return "OPEN";
    case ImuExtrinsicsOutcome::TurnedTooLittle:
      return "TURNED TOO LITTLE";
    case ImuExtrinsicsOutcome::Contradicted:
      return "CONTRADICTED";
  }
  return "";
}

/** Only where it is beyond doubt, and matters. */
std::string clockInWords(const ImuExtrinsicsEstimate& e)
{
  constexpr double kSigmas = 3, kLeast = 0.001;  // s
  const double late = e.extrinsics.clock_offset, sigma = std::sqrt(e.covariance(6, 6));
  const bool matters = std::abs(late) > kLeast && std::abs(late) > kSigmas * sigma;
  return fmt::format("imu: its stamps are {:.2f} ms late (+- {:.2f}){}\n", 1e3 * late, 1e3 * sigma,
                     matters ? fmt::format(": set [slam] imu_delay_ms = {:.2f}", 1e3 * late) : "");
}
}  // namespace

bool trusted(const ImuExtrinsicsEstimate& estimate) { return estimate.outcome == ImuExtrinsicsOutcome::Estimated; }

std::string inWords(const ImuExtrinsicsEstimate& e)
{
  if (e.outcome == ImuExtrinsicsOutcome::TurnedTooLittle)
    return "imu: not calibrated: the machine stood still, or turned about one axis only: drive winding, over uneven "
           "ground, 30 s or more\n";
  if (e.outcome == ImuExtrinsicsOutcome::Contradicted)
    return "imu: not calibrated: nowhere on the body would it measure the turns that the lidar saw: it is of another "
           "drive, its clock is off by more than 0.5 s, its unit is not rad/s, its axes are left-handed ('scanloom "
           "doctor'), or the lidar alone saw the turns badly: drive where it sees stems or walls all around, or give "
           "the IMU's pose to a few degrees\n";
  return fmt::format("imu: {}\n", poseInWords(e.extrinsics, e.covariance)) + clockInWords(e) +
         fmt::format("imu: the lidar's {} poses are {:.4f} m and {:.3f} deg off its motion (root mean square)\n",
                     e.poses, e.residual.position, e.residual.rotation / kDegree) +
         openInWords("imu", e.open);
}

nlohmann::json toJson(const ImuExtrinsicsEstimate& e)
{
  nlohmann::json json = numbersOf(e.extrinsics, e.covariance, e.open);
  json["outcome"] = toString(e.outcome);
  json["poses"] = e.poses;
  json["residual"] = {{"position", e.residual.position}, {"rotation_deg", e.residual.rotation / kDegree}};
  return json;
}
}  // namespace scanloom
