#include "diagnosis/RawlogCheck.h"

#include "base/core/Statistics.h"
#include "base/core/jsonText.h"
#include "diagnosis/DoctorFindings.h"
#include "diagnosis/DoctorJson.h"
#include "diagnosis/ScanEvidence.h"
#include "diagnosis/internal/FindingLimits.h"
#include "diagnosis/internal/Gaps.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/RawlogInput.h"
#include "mrpt/observations/RawlogReader.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace scanloom
{
namespace
{
using mrpt::maps::CGenericPointsMap;

constexpr double kGap = 1.5;                                          // times the usual interval
constexpr double kSmallShare = 0.02;                                  // of the points: a lidar is covered or fails
constexpr double kFewColumnsWarning = 0.02, kFewColumnsNotFit = 0.2;  // share of missing columns

/** The account of a label, and what is needed for its medians. */
struct LabelHistory
{
  LabelAccount account;
  std::vector<double> intervals;                       // s
  std::vector<std::vector<std::uint32_t>> columns_of;  // by lidar, per scan
  Timestamp latest;
};

void addPoints(const mrpt::obs::CObservationPointCloud& cloud, const std::optional<RecordingHeader>& header,
               LabelHistory& label)
{
  CloudAccount& account = label.account.of_clouds;
  const Scan scan = measuredScan(cloud, header);
  ++account.clouds;
  account.impossible += cloud.pointcloud->size() - scan.points.size();
  account.points += scan.points.size();
  account.empty += scan.points.empty();
  const auto* generic = dynamic_cast<const CGenericPointsMap*>(cloud.pointcloud.get());
  if (!generic || !generic->getPointsBufferRef_float_field("t")) return;

  const std::int64_t period = scan.period.count();
  std::int32_t before = 0;
  constexpr std::int32_t kFloatStep = 20;  // ns: rounding of float times
  for (const std::int32_t t : scan.points.t)
  {
    account.outside += t < 0 || (header && t >= period + 100 + kFloatStep);
    account.disordered += t < before;
    before = t;
  }
  if (!generic->getPointsBufferRef_uint8_field("sensor_id") || !header) return;
  account.lidars.resize(header->lidars.size());
  label.columns_of.resize(header->lidars.size());
  for (const std::uint8_t id : scan.points.sensor_id)
    if (id < account.lidars.size()) ++account.lidars[id].points;
  for (std::size_t id = 0; id < account.lidars.size(); ++id)
  {
    const std::uint32_t columns = scan.columns_of[id];
    account.lidars[id].columns += columns;
    account.lidars[id].silent_scans += columns == 0;
    label.columns_of[id].push_back(columns);
  }
}

void addStamp(Timestamp stamp, LabelHistory& label)
{
  LabelAccount& account = label.account;
  if (account.count++ == 0)
  {
    account.first = account.last = label.latest = stamp;
    return;
  }
  const Duration interval = stamp - label.latest;
  account.backwards += interval <= 0s;
  account.longest_interval = std::max(account.longest_interval, interval);
  label.intervals.push_back(seconds(interval));
  account.first = std::min(account.first, stamp);
  account.last = std::max(account.last, stamp);
  label.latest = stamp;
}

std::uint64_t missingColumns(const std::vector<std::uint32_t>& columns)
{
  if (columns.size() < 3) return 0;
  const double usual = median({columns.begin(), columns.end()});
  double missing = 0;
  for (std::size_t i = 1; i + 1 < columns.size(); ++i) missing += std::max(0.0, usual - columns[i]);
  return static_cast<std::uint64_t>(missing);
}

LabelAccount finished(LabelHistory label)
{
  LabelAccount& account = label.account;
  const Gaps gaps = gapsIn(label.intervals, kGap);
  account.usual_interval = fromSeconds(gaps.usual_interval);
  account.gaps = gaps.count;
  account.lost = gaps.missing;
  std::vector<LidarShare>& lidars = account.of_clouds.lidars;
  for (std::size_t id = 0; id < lidars.size(); ++id) lidars[id].missing_columns = missingColumns(label.columns_of[id]);
  return account;
}

class AccountBuilder
{
 public:
  void add(const ObservationPtr& observation)
  {
    const bool first = labels_.empty();
    if (first && !account_.header && (account_.header = headerIn(*observation))) return;
    const Timestamp stamp = fromMrpt(observation->timestamp);
    account_.first = first ? stamp : std::min(account_.first, stamp);
    account_.last = first ? stamp : std::max(account_.last, stamp);
    LabelHistory& label = labels_[observation->sensorLabel];
    addStamp(stamp, label);
    if (const auto cloud = cloudIn(observation))
    {
      addPoints(*cloud, account_.header, label);
      if (account_.header) end_of_scan_ = stamp + account_.header->period();
    }
    else if (dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()))
      account_.late_imu += end_of_scan_ && stamp + 20ms < *end_of_scan_;
  }

  RawlogAccount finish()
  {
    for (auto& [label, history] : labels_) account_.labels[label] = finished(std::move(history));
    return std::move(account_);
  }

 private:
  RawlogAccount account_;
  std::map<std::string, LabelHistory> labels_;
  std::optional<Timestamp> end_of_scan_;  // of the latest scan
};

Finding finding(const std::string& about, const std::string& measure, Verdict verdict, const std::string& says,
                const std::string& mend = "")
{
  return {about, measure, verdict, says, verdict > Verdict::Ok ? mend : ""};
}

void addDelivery(const std::string& label, const LabelAccount& a, Findings& findings)
{
  const double span = seconds(a.last - a.first);
  findings.push_back(
      finding(label, "span", Verdict::Ok,
              fmt::format("{} in {:.3f} s, one in {:.2f} ms", a.count, span, 1e3 * seconds(a.usual_interval))));
  findings.push_back(finding(label, "order", a.backwards > 0 ? Verdict::NotFit : Verdict::Ok,
                             fmt::format("{} stamps do not rise", a.backwards),
                             "cut the rawlog where the clock stepped (--from-time, --to-time)"));
  const double loss = a.count > 0 ? static_cast<double>(a.lost) / static_cast<double>(a.count + a.lost) : 0;
  findings.push_back(
      finding(label, "gaps", grade(loss, limits::kLossWarning, limits::kLossNotFit),
              fmt::format("{} gaps, {} lost ({:.2f} %), longest interval {:.1f} ms", a.gaps, a.lost, 100 * loss,
                          1e3 * seconds(a.longest_interval)),
              "examine the capture with 'scanloom doctor': a rawlog does not tell where they were lost"));
}

void addClouds(const std::string& label, const CloudAccount& a, const RecordingHeader& header, Findings& findings)
{
  if (a.impossible > 0)
    findings.push_back(finding(
        label, "points", Verdict::Warning,
        fmt::format("{} of {} are not finite or 100 km away: left out", a.impossible, a.points + a.impossible),
        "leave out directions without a return in the program that wrote the rawlog, or check its memory and disk"));
  findings.push_back(
      finding(label, "point times", a.outside > 0 ? Verdict::NotFit : Verdict::Ok,
              fmt::format("{} outside of their scan, {} earlier than the point before", a.outside, a.disordered),
              "make the rawlog from the capture again (--from-pcap)"));
  for (std::size_t id = 0; id < a.lidars.size(); ++id)
  {
    const LidarShare& lidar = a.lidars[id];
    const double share = a.points > 0 ? static_cast<double>(lidar.points) / static_cast<double>(a.points) : 0;
    const auto part = partOf(label, header);
    if (part && part->lidar != id) continue;
    const std::string about = part ? label : label + " " + header.lidars[id].name;
    const Verdict verdict = lidar.points == 0 ? Verdict::NotFit : share < kSmallShare ? Verdict::Warning : Verdict::Ok;
    findings.push_back(
        finding(about, "share", verdict,
                fmt::format("{:.1f} % of the points, silent in {} scans", 100 * share, lidar.silent_scans),
                "the lidar is covered or failed, or the recording is without it (--keep-lidars)"));
    const auto all = static_cast<double>(lidar.columns + lidar.missing_columns);
    const double missing = all > 0 ? static_cast<double>(lidar.missing_columns) / all : 0;
    findings.push_back(
        finding(about, "columns", grade(missing, kFewColumnsWarning, kFewColumnsNotFit),
                fmt::format("{:.2f} % fewer than in the median scan", 100 * missing),
                "examine the capture with 'scanloom doctor': packets were lost, or the lidar saw open sky"));
  }
}
}  // namespace

RawlogAccount accountOf(const std::filesystem::path& path, const KeepReading& keep_reading)
{
  AccountBuilder builder;
  const RawlogEdited read = readRawlog(
      path, readOnly([&](const ObservationPtr& observation) { builder.add(observation); }, [] {}), keep_reading);
  RawlogAccount account = builder.finish();
  account.passed_over = read.passed_over;
  account.damage = read.damage;
  return account;
}

Findings findingsOf(const RawlogAccount& account)
{
  Findings findings;
  findings.push_back(finding("rawlog", "file", account.damage.empty() ? Verdict::Ok : Verdict::NotFit,
                             account.damage.empty() ? "whole" : account.damage,
                             "'scanloom edit' writes what is before the damage, e.g. with --from-index 0"));
  findings.push_back(finding("rawlog", "header", account.header ? Verdict::Ok : Verdict::NotFit,
                             account.header ? fmt::format("{} lidars", account.header->lidars.size()) : "none",
                             "the lidars are unknown: record with scanloom"));
  findings.push_back(finding("rawlog", "late IMU", account.late_imu > 0 ? Verdict::Warning : Verdict::Ok,
                             fmt::format("{} samples come more than 20 ms after they were needed", account.late_imu),
                             "programs that read in the file's order deskew without them"));
  for (const auto& [label, a] : account.labels)
  {
    addDelivery(label, a, findings);
    if (a.of_clouds.clouds > 0 && account.header) addClouds(label, a.of_clouds, *account.header, findings);
  }
  return findings;
}

std::string toJson(const RawlogAccount& account)
{
  using nlohmann::json;
  const auto secondsOf = [](Timestamp t) { return seconds(t.time_since_epoch()); };
  json labels = json::object();
  for (const auto& [label, a] : account.labels)
  {
    json entry = {{"count", a.count},
                  {"first_s", secondsOf(a.first)},
                  {"last_s", secondsOf(a.last)},
                  {"usual_interval_s", seconds(a.usual_interval)},
                  {"longest_interval_s", seconds(a.longest_interval)},
                  {"gaps", a.gaps},
                  {"lost", a.lost},
                  {"backwards", a.backwards}};
    if (const CloudAccount& c = a.of_clouds; c.clouds > 0)
    {
      entry.update({{"points", c.points},
                    {"empty", c.empty},
                    {"outside", c.outside},
                    {"disordered", c.disordered},
                    {"impossible", c.impossible}});
      entry["lidars"] = json::object();
      for (std::size_t id = 0; id < c.lidars.size(); ++id)
        entry["lidars"][account.header->lidars[id].name] = {{"points", c.lidars[id].points},
                                                            {"columns", c.lidars[id].columns},
                                                            {"silent_scans", c.lidars[id].silent_scans},
                                                            {"missing_columns", c.lidars[id].missing_columns}};
    }
    labels[label] = std::move(entry);
  }
  return jsonText({{"labels", labels},
                   {"first_s", secondsOf(account.first)},
                   {"last_s", secondsOf(account.last)},
                   {"span_s", seconds(account.last - account.first)},
                   {"late_imu", account.late_imu},
                   {"passed_over", account.passed_over},
                   {"damage", account.damage}});
}

CheckedRawlog checkRawlog(const std::filesystem::path& path, const CropOptions& crop, const KeepReading& keep_reading)
{
  bool stopped = false;
  CheckedRawlog check;
  check.account = accountOf(path, [&](std::uint64_t bytes) { return !(stopped = !keep_reading(bytes)); });
  check.findings = findingsOf(check.account);
  if (stopped || !check.account.header) return check;
  RawlogInput input(path);
  check.rig = examine(scanEvidence(input, true, [] { return true; }), crop);
  const Findings of_rig = findingsOf(check.rig);
  check.findings.insert(check.findings.end(), of_rig.begin(), of_rig.end());
  return check;
}

std::string toJson(const CheckedRawlog& check)
{
  auto result = nlohmann::json::parse(toJson(check.rig, check.findings));
  result["rawlog"] = nlohmann::json::parse(toJson(check.account));
  return jsonText(result);
}
}  // namespace scanloom
