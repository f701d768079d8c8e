#include "dataset/DoctorFindings.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
Finding strangersFinding(const Origin& origin, std::uint64_t datagrams)
{
  return {"rig", "strangers", Verdict::Warning,
          fmt::format("{} datagrams from {} to port {} are no lidar's", datagrams, origin.source.text(),
                      origin.destination_port),
          "give each lidar its key 'address', or move the other sender to another port"};
}

void append(Findings& to, Findings more) { to.insert(to.end(), more.begin(), more.end()); }
}  // namespace

Findings findingsOf(const RigExamination& rig, const DoctorLimits& limits)
{
  Findings findings;
  for (std::size_t i = 0; i < rig.lidars.size(); ++i)
  {
    append(findings, deliveryFindings(rig.lidars[i], limits.delivery));
    if (rig.lidars[i].jitter) findings.push_back(jitterFinding(rig.lidars[i], rig.deadline, limits.delivery));
    append(findings, clockFindings(rig, i, limits.clocks));
    append(findings, groundFindings(rig, i, limits.geometry));
    for (const PairExamination& pair : rig.pairs)
      if (pair.lidar == i) findings.push_back(poseFinding(rig, pair, limits.geometry));
  }
  for (std::size_t i = 0; i < rig.imus.size(); ++i) append(findings, imuFindings(rig, i, limits.imu));
  for (const auto& [origin, datagrams] : rig.strangers) findings.push_back(strangersFinding(origin, datagrams));
  return findings;
}
}  // namespace scanloom
