#include "diagnosis/DoctorFindings.h"
#include "diagnosis/internal/FindingLimits.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
Finding timingFinding(const ImuExamination& imu)
{
  const ImuTiming& t = imu.timing;
  Finding finding{imu.name, "rate", Verdict::Ok, fmt::format("{} samples", t.samples)};
  if (t.rate) finding.says += fmt::format(", {:.1f} Hz", *t.rate);
  finding.says += t.gaps == 0 ? ", no gaps"
                              : fmt::format(", {} gaps with {} samples lost, the longest {:.1f} ms", t.gaps, t.lost,
                                            1e3 * seconds(t.longest_gap));
  if (t.gaps > 0)
  {
    finding.verdict = seconds(t.longest_gap) > limits::kImuGapNotFit ? Verdict::NotFit : Verdict::Warning;
    finding.mend = "read the IMU with priority over a link of its own; for a lidar's IMU see the lidar's loss";
  }
  if (t.backwards > 0)
  {
    finding.verdict = Verdict::NotFit;
    finding.says += fmt::format(", {} stamps that do not rise", t.backwards);
    finding.mend = "sort the samples by stamp, and look for a clock that was set while recording";
  }
  return finding;
}

Finding coverageFinding(const ImuExamination& imu)
{
  Finding finding{imu.name, "time", Verdict::Ok,
                  fmt::format("covers {:.1f} % of the lidars' time", 100 * *imu.lidar_share)};
  if (*imu.lidar_share > 0.9) return finding;
  finding.verdict = *imu.lidar_share > 0 ? Verdict::Warning : Verdict::NotFit;
  finding.mend = *imu.lidar_share > 0 ? "start the IMU before the lidars, and stop it after them"
                                      : "its stamps are of another clock: stamp both by PTP or by the same computer";
  return finding;
}

Finding upInSensorFrame(const ImuExamination& imu)
{
  const Eigen::Vector3d up = imu.sound.force_in_body.normalized();
  return {imu.name, "up", Verdict::NotMeasured,
          fmt::format("{:.1f} deg off +z of the sensor frame, nearest axis {} (its pose on the body is not known)",
                      degreesBetween(up, Eigen::Vector3d::UnitZ()), nearestAxis(up))};
}
}  // namespace

Findings imuFindings(const RigExamination& rig, std::size_t index)
{
  const ImuExamination& imu = rig.imus[index];
  Findings findings{timingFinding(imu)};
  if (imu.lidar_share) findings.push_back(coverageFinding(imu));
  findings.push_back(gravityFinding(imu.name, imu.sound));
  findings.push_back(rig.poses_known ? upFinding(imu.name, imu.sound, imu.configured_pose) : upInSensorFrame(imu));
  findings.push_back(gyroFinding(imu.name, imu.sound));
  if (imu.compared) findings.push_back(turnsFinding(*imu.compared, imu.name, rig.imus[imu.compared->reference].name));
  return findings;
}
}  // namespace scanloom
