#include "diagnosis/DoctorFindings.h"
#include "diagnosis/internal/FindingLimits.h"

#include <fmt/format.h>

#include <cmath>

namespace scanloom
{
namespace
{
std::string signedSeconds(Duration d)
{
  const double s = seconds(d);
  return std::abs(s) < 1 ? fmt::format("{:+.3f} ms", 1e3 * s) : fmt::format("{:+.6f} s", s);
}

bool promisesUtc(const std::string& mode) { return mode == "TIME_FROM_PTP_1588" || mode == "TIME_FROM_SYNC_PULSE_IN"; }

Finding kindFinding(const LidarExamination& seen)
{
  const Epoch epoch = *seen.clock.epoch;
  const std::string mode = seen.lidar.clock.empty() ? "no timestamp_mode in the metadata" : seen.lidar.clock;
  Finding finding{
      seen.name, "clock", Verdict::Ok,
      fmt::format("{}, {}; {} ahead of the computer", mode, toString(epoch), signedSeconds(*seen.clock.ahead_of_host))};
  if (epoch == Epoch::SinceBoot && promisesUtc(seen.lidar.clock))
  {
    finding.verdict = Verdict::Warning;
    finding.mend = "the sensor is not synchronised: check the PTP master (ptp4l, same domain) or the sync pulse";
  }
  if (epoch == Epoch::Tai || epoch == Epoch::GpsAsUnix)
  {
    finding.verdict = Verdict::Warning;
    finding.mend = "let the PTP master announce currentUtcOffset (37 s) with its flag set, or set the key time_offset";
  }
  return finding;
}

Finding offsetFinding(const LidarExamination& seen, const std::string& first, std::size_t lidar)
{
  const Duration ahead = *seen.clock.ahead_of_first;
  Finding finding{seen.name, "clock offset",
                  grade(1e3 * std::abs(seconds(ahead)), limits::kOffsetWarningMs, limits::kOffsetNotFitMs),
                  fmt::format("{} ahead of '{}'", signedSeconds(ahead), first)};
  if (finding.verdict != Verdict::Ok)
    finding.mend = fmt::format("lock both to one PTP master; for this recording set lidar{}_time_offset = {:.4f}",
                               lidar + 1, -seconds(ahead));
  return finding;
}

Finding driftFinding(const LidarExamination& seen, const std::string& first, bool is_first)
{
  const std::optional<ClockDrift>& drift = is_first ? seen.clock.drift : seen.clock.drift_to_first;
  Finding finding{seen.name, "clock drift", Verdict::NotMeasured,
                  fmt::format("not enough time: needs {:.0f} s", limits::kDriftTime)};
  if (!drift) return finding;
  finding.verdict = Verdict::Ok;
  finding.says = fmt::format("{:+.2f} ppm against {} (standard deviation {:.2f})", drift->ppm,
                             is_first ? "the computer" : "'" + first + "'", drift->sigma_ppm);
  const bool drifts = std::abs(drift->ppm) > limits::kDriftWarningPpm && std::abs(drift->ppm) > 3 * drift->sigma_ppm;
  if (is_first || !drifts) return finding;
  finding.verdict = Verdict::Warning;
  finding.mend = fmt::format("lock both to one PTP master: they diverge by {:.0f} ms within {:.0f} s",
                             limits::kOffsetWarningMs, 1e3 * limits::kOffsetWarningMs / std::abs(drift->ppm));
  return finding;
}

Finding stepsFinding(const LidarExamination& seen)
{
  const std::vector<ClockStep>& steps = seen.clock.steps;
  if (steps.empty()) return {seen.name, "clock steps", Verdict::Ok, "none"};
  std::string list;
  for (std::size_t i = 0; i < std::min<std::size_t>(steps.size(), 3); ++i)
    list += (i ? ", " : "") + signedSeconds(steps[i].size);
  return {seen.name, "clock steps", Verdict::NotFit,
          fmt::format("{}: {}{}", steps.size(), list, steps.size() > 3 ? ", ..." : ""),
          "start recording after PTP has locked, and let the master slew instead of step (ptp4l: step_threshold 0)"};
}

Finding phaseFinding(const RigExamination& rig, std::size_t lidar)
{
  const LidarExamination& seen = rig.lidars[lidar];
  const RotorPhase& p = *seen.clock.phase;
  Finding finding{seen.name, "rotor phase", Verdict::Ok, ""};
  const double rate = (1 + 1e-6 * p.rate_error_ppm) / p.turn;
  if (std::abs(p.rate_error_ppm) > 1e6 * limits::kRotorTolerance)
  {
    finding.verdict = Verdict::Warning;
    finding.says = fmt::format("{:.2f} Hz ({:.1f} rpm), nominal are {:.2f} Hz", rate, 60 * rate, 1 / p.turn);
    finding.mend = "the metadata names another lidar_mode or rpm than the sensor uses: correct it";
    return finding;
  }
  finding.says = fmt::format("column 0 at {:.2f} ms of {:.0f}", 1e3 * p.at_end, 1e3 * p.turn);
  finding.says +=
      p.steady() ? ", steady" : fmt::format(", not locked: {:+.0f} ppm off the nominal rate", p.rate_error_ppm);
  const auto& first = rig.lidars.front().clock.phase;
  if (lidar > 0 && first && first->turn == p.turn)
  {
    const double behind = std::remainder(p.at_end - first->at_end, p.turn) / p.turn;
    finding.says += fmt::format("; {:+.0f} deg against '{}'", 360 * -behind, rig.lidars.front().name);
  }
  return finding;
}
}  // namespace

Findings clockFindings(const RigExamination& rig, std::size_t lidar)
{
  const LidarExamination& seen = rig.lidars[lidar];
  if (!seen.clock.epoch) return {};
  const std::string& first = rig.lidars.front().name;
  Findings findings{kindFinding(seen)};
  if (seen.clock.ahead_of_first) findings.push_back(offsetFinding(seen, first, lidar));
  findings.push_back(driftFinding(seen, first, lidar == 0));
  findings.push_back(stepsFinding(seen));
  if (seen.clock.phase) findings.push_back(phaseFinding(rig, lidar));
  return findings;
}
}  // namespace scanloom
