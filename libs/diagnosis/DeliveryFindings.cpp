#include "diagnosis/DoctorFindings.h"
#include "diagnosis/internal/FindingLimits.h"

#include <fmt/format.h>

#include <cmath>

namespace scanloom
{
namespace
{
constexpr const char* kMendLoss =
    "raise net.core.rmem_max to 64 MB, use a gigabit link without Wi-Fi, and check the cable (ethtool -S: rx errors)";

Finding rateFinding(const LidarExamination& seen)
{
  const Delivery& d = seen.delivery;
  Finding finding{seen.name, "rate", Verdict::NotMeasured, fmt::format("{} packets: less than a turn", d.packets)};
  if (!d.rates.packets) return finding;
  finding.says = fmt::format("{:.1f} packets/s of {:.1f} nominal, {:.1f} blocks/s of {:.1f}", *d.rates.packets,
                             d.rates.nominal_packets, *d.rates.blocks, d.rates.nominal_blocks);
  const double sent_rate = *d.rates.packets * static_cast<double>(d.sent()) / static_cast<double>(d.packets);
  if (std::abs(sent_rate / d.rates.nominal_packets - 1) <= limits::kRateTolerance)
  {
    finding.verdict = Verdict::Ok;
    return finding;
  }
  finding.verdict = Verdict::Warning;
  finding.mend = "the packet ids show no loss, so the sensor's lidar_mode was changed: fetch its metadata again";
  return finding;
}

Finding lossFinding(const LidarExamination& seen)
{
  const Delivery& d = seen.delivery;
  Finding finding{seen.name, "loss", Verdict::Ok, fmt::format("none of {} packets", d.sent())};
  if (d.loss.packets == 0) return finding;
  finding.says =
      fmt::format("{:.3f} % ({} of {} packets) in {} gaps, the longest of {} packets or {:.1f} ms", 100 * d.lossShare(),
                  d.loss.packets, d.sent(), d.loss.gaps, d.loss.longest, 1e3 * seconds(d.loss.longest_time));
  finding.verdict = grade(d.lossShare(), limits::kLossWarning, limits::kLossNotFit);
  if (seconds(d.loss.longest_time) > limits::kGapNotFit) finding.verdict = Verdict::NotFit;
  if (finding.verdict != Verdict::Ok) finding.mend = kMendLoss;
  return finding;
}

Finding orderFinding(const LidarExamination& seen)
{
  const PacketOrder& order = seen.delivery.order;
  if (order.reordered == 0 && order.duplicates == 0)
    return {seen.name, "order", Verdict::Ok, "in order, no duplicates"};
  return {seen.name, "order", Verdict::Ok,
          fmt::format("{} packets reordered (by up to {} packets, {:.2f} ms), {} duplicates", order.reordered,
                      order.displacement, 1e3 * seconds(order.displacement_time), order.duplicates)};
}

Finding blocksFinding(const LidarExamination& seen)
{
  const Delivery& d = seen.delivery;
  Finding finding{seen.name, "valid blocks", grade(1 - d.validShare(), limits::kInvalidWarning, limits::kInvalidNotFit),
                  fmt::format("{:.2f} % of {} in the azimuth window", 100 * d.validShare(), d.blocks)};
  if (finding.verdict != Verdict::Ok)
    finding.mend = "wait until the motor runs; if blocks are invalid after that, read the sensor's alerts";
  return finding;
}

void addDamage(Findings& findings, const LidarExamination& seen)
{
  const auto all = static_cast<double>(seen.delivery.packets + seen.malformed + seen.bad_crc);
  if (seen.malformed > 0)
    findings.push_back({seen.name, "malformed",
                        grade(static_cast<double>(seen.malformed) / all, limits::kDamagedWarning, 0.5),
                        fmt::format("{} packets of a size or type that does not match the metadata", seen.malformed),
                        "the sensor's UDP profile was changed: fetch its metadata again"});
  if (seen.bad_crc > 0)
    findings.push_back({seen.name, "bad CRC",
                        grade(static_cast<double>(seen.bad_crc) / all, limits::kDamagedWarning, 0.5),
                        fmt::format("{} packets", seen.bad_crc), "check cables, plugs and the switch"});
}

void addRestarts(Findings& findings, const LidarExamination& seen)
{
  if (seen.delivery.restarts > 0)
    findings.push_back({seen.name, "restarts", Verdict::Warning, fmt::format("{} times", seen.delivery.restarts),
                        "check the supply voltage under load, and that no program reconfigures the sensor"});
}

void addFlags(Findings& findings, const LidarExamination& seen)
{
  const SensorFlags& f = seen.flags;
  if (f.alert_packets > 0)
    findings.push_back({seen.name, "alerts", Verdict::Warning,
                        fmt::format("flags 0x{:02x} in {} packets", f.alerts, f.alert_packets),
                        "read the sensor's /api/v1/sensor/alerts"});
  if (f.thermal_packets > 0)
    findings.push_back({seen.name, "temperature", Verdict::Warning,
                        fmt::format("status {} in {} packets", f.worst_thermal_status, f.thermal_packets),
                        "the sensor is about to shut down: mount it on metal, shade it, give it air"});
  if (f.shot_limiting_packets > 0)
    findings.push_back(
        {seen.name, "shot limiting", Verdict::Warning,
         fmt::format("status {} in {} packets: reduced range", f.worst_shot_limiting_status, f.shot_limiting_packets),
         "the sensor reduces its laser power because it is hot: cool it"});
}
}  // namespace

Findings deliveryFindings(const LidarExamination& seen)
{
  Findings findings;
  if (seen.delivery.packets == 0)
    findings.push_back(
        {seen.name, "packets", Verdict::NotFit,
         seen.lidar.lidar_port == 0 ? "none on its topic" : fmt::format("none at port {}", seen.lidar.lidar_port),
         "set the sensor's destination (Ouster: udp_dest) to this computer and the key 'port' to its port; if "
         "'strangers' lists datagrams to that port, the metadata is that of another sensor"});
  else
    findings = {rateFinding(seen), lossFinding(seen), orderFinding(seen), blocksFinding(seen)};
  addDamage(findings, seen);
  addRestarts(findings, seen);
  addFlags(findings, seen);
  return findings;
}

Finding jitterFinding(const LidarExamination& seen, Duration deadline)
{
  Finding finding{seen.name, "jitter", Verdict::NotMeasured, "no packet with a stamp"};
  if (!seen.jitter) return finding;
  const double needed = std::ceil(1e4 * seconds(seen.jitter->largest)) / 10;  // ms
  finding.says = fmt::format("p50 {:.2f}, p99 {:.2f}, largest {:.2f} ms after the fastest: needs deadline_ms >= {:.1f}",
                             1e3 * seconds(seen.jitter->p50), 1e3 * seconds(seen.jitter->p99),
                             1e3 * seconds(seen.jitter->largest), needed);
  finding.verdict = grade(seen.jitter->late_share, 0, limits::kLateNotFit);
  if (finding.verdict != Verdict::Ok)
    finding.mend =
        fmt::format("set deadline_ms = {:.0f}: {:.3f} % of the packets come later than the configured {:.1f} ms",
                    std::ceil(needed), 100 * seen.jitter->late_share, 1e3 * seconds(deadline));
  return finding;
}
}  // namespace scanloom
