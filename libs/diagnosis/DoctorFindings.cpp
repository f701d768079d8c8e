#include "diagnosis/DoctorFindings.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
Finding otherSendersFinding(const Origin& origin, std::uint64_t datagrams)
{
  return {"rig", "strangers", Verdict::Warning,
          fmt::format("{} datagrams {} are from no known lidar", datagrams, origin.text()),
          "set the key 'address' of each lidar, or let the other sender use another port"};
}

Finding socketFinding(const SocketAccount& sockets)
{
  const UdpCounters& c = sockets.counters;
  Finding finding{"rig", "sockets", Verdict::Ok,
                  fmt::format("{} datagrams; lost: {} in the kernel, {} by this program, {} too long, {} errors",
                              c.datagrams, c.kernel_drops, c.dropped, c.truncated, c.errors)};
  if (c.filtered > 0) finding.says += fmt::format("; {} from other addresses were refused", c.filtered);
  if (sockets.clock_steps > 0)
    finding.says += fmt::format("; the computer's clock was set {} times", sockets.clock_steps);
  for (const std::string& warning : sockets.warnings) finding.mend += (finding.mend.empty() ? "" : "; ") + warning;
  if (finding.mend.empty() && c.kernel_drops + c.dropped > 0)
    finding.mend = "the computer is too slow or too busy: give the program a core of its own, raise receive_buffer";
  if (!finding.mend.empty() || sockets.clock_steps > 0) finding.verdict = Verdict::Warning;
  return finding;
}

void append(Findings& to, Findings more) { to.insert(to.end(), more.begin(), more.end()); }
}  // namespace

Findings findingsOf(const RigExamination& rig)
{
  Findings findings;
  for (std::size_t i = 0; i < rig.lidars.size(); ++i)
  {
    if (rig.packets_known) append(findings, deliveryFindings(rig.lidars[i]));
    if (rig.lidars[i].jitter) findings.push_back(jitterFinding(rig.lidars[i], rig.deadline));
    append(findings, clockFindings(rig, i));
    append(findings, groundFindings(rig, i));
    for (const PairExamination& pair : rig.pairs)
      if (pair.lidar == i)
        findings.push_back(poseFinding(rig.lidars[i].name, rig.lidars[pair.reference].name, pair.agreement));
  }
  for (std::size_t i = 0; i < rig.imus.size(); ++i) append(findings, imuFindings(rig, i));
  if (rig.poses_known || rig.lidars.size() == 1) findings.push_back(cropFinding(rig.machine));
  for (const std::string& wrong : rig.wrong_keys)
    findings.push_back({"rig", "configuration", Verdict::Warning, wrong, ""});
  if (rig.sockets) findings.push_back(socketFinding(*rig.sockets));
  for (const auto& [origin, datagrams] : rig.other_senders) findings.push_back(otherSendersFinding(origin, datagrams));
  return findings;
}
}  // namespace scanloom
