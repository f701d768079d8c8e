#include "dataset/RawlogCheck.h"

#include "dataset/CloudObservation.h"
#include "dataset/Statistics.h"
#include "mrpt_bridge/Conversions.h"
#include "mrpt_bridge/Observations.h"
#include "mrpt_bridge/RawlogReader.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
using mrpt::maps::CGenericPointsMap;

constexpr double kGap = 1.5;  // times the usual interval: one is lost
constexpr double kLossWarning = 0.001;
constexpr double kLossNotFit = 0.05;
constexpr double kSmallShare = 0.02;  // of the points: a lidar that is covered, or fails

/** What is gathered of a label until the medians are known. */
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
  LabelAccount& account = label.account;
  const Scan scan = fromObservation(cloud, header);
  ++account.clouds;
  account.points += scan.points.size();
  account.empty += scan.points.empty();
  const auto* generic = dynamic_cast<const CGenericPointsMap*>(cloud.pointcloud.get());
  if (!generic || !generic->getPointsBufferRef_float_field("t")) return;

  const std::int64_t period = scan.period.count();
  std::int32_t before = 0;
  constexpr std::int32_t kFloatStep = 20;  // ns: what floats and 100 ns stamps add at the rim
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
  if (!label.intervals.empty())
  {
    const double usual = median(label.intervals);
    account.usual_interval = fromSeconds(usual);
    for (const double interval : label.intervals)
      if (usual > 0 && interval > kGap * usual)
      {
        ++account.gaps;
        account.lost += static_cast<std::uint64_t>(std::lround(interval / usual)) - 1;
      }
  }
  for (std::size_t id = 0; id < account.lidars.size(); ++id)
    account.lidars[id].missing_columns = missingColumns(label.columns_of[id]);
  return account;
}

/** Looks at every observation and passes none on. */
struct Account
{
  RawlogAccount account;
  std::map<std::string, LabelHistory> labels;
  std::optional<Timestamp> scans_over;  // end of the latest scan

  void add(const ObservationPtr& observation)
  {
    if (!account.header && labels.empty())
      if ((account.header = headerIn(*observation))) return;
    const Timestamp stamp = fromMrpt(observation->timestamp);
    const bool first = labels.empty();
    account.first = first ? stamp : std::min(account.first, stamp);
    account.last = first ? stamp : std::max(account.last, stamp);
    LabelHistory& label = labels[observation->sensorLabel];
    addStamp(stamp, label);
    if (const auto cloud = cloudIn(observation))
    {
      addPoints(*cloud, account.header, label);
      if (account.header) scans_over = stamp + account.header->period();
    }
    else if (dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()))
      account.late_imu += scans_over && stamp + 20ms < *scans_over;
  }
};

Finding finding(const std::string& about, const std::string& measure, Verdict verdict, const std::string& says,
                const std::string& mend = "")
{
  return {about, measure, verdict, says, verdict > Verdict::Ok ? mend : ""};
}

Verdict ofShare(double share, double warning, double not_fit)
{
  return share > not_fit ? Verdict::NotFit : share > warning ? Verdict::Warning : Verdict::Ok;
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
  findings.push_back(finding(label, "gaps", ofShare(loss, kLossWarning, kLossNotFit),
                             fmt::format("{} gaps, {} lost ({:.2f} %), longest interval {:.1f} ms", a.gaps, a.lost,
                                         100 * loss, 1e3 * seconds(a.longest_interval)),
                             "look at the capture with 'scanloom doctor': the rawlog cannot say who lost it"));
}

void addClouds(const std::string& label, const LabelAccount& a, const RecordingHeader& header, Findings& findings)
{
  findings.push_back(
      finding(label, "point times", a.outside > 0 ? Verdict::NotFit : Verdict::Ok,
              fmt::format("{} outside of their scan, {} before their predecessor", a.outside, a.disordered),
              "batch the capture again (--from-pcap)"));
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
                "the lidar is covered, failed, or is not in this recording (--keep-lidars)"));
    const auto all = static_cast<double>(lidar.columns + lidar.missing_columns);
    const double missing = all > 0 ? static_cast<double>(lidar.missing_columns) / all : 0;
    findings.push_back(finding(about, "columns", ofShare(missing, 0.02, 0.2),
                               fmt::format("{:.2f} % fewer than in its usual scan", 100 * missing),
                               "look at the capture with 'scanloom doctor': packets, or open sky"));
  }
}
}  // namespace

RawlogAccount accountOf(const std::filesystem::path& path, const KeepReading& keep_reading)
{
  Account account;
  const RawlogEdited read = readRawlog(
      path,
      [&](const ObservationPtr& observation)
      {
        if (observation) account.add(observation);
        return Observations{};
      },
      keep_reading);
  for (auto& [label, history] : account.labels) account.account.labels[label] = finished(std::move(history));
  account.account.passed_over = read.passed_over;
  account.account.damage = read.damage;
  return account.account;
}

Findings findingsOf(const RawlogAccount& account)
{
  Findings findings;
  findings.push_back(finding("rawlog", "file", account.damage.empty() ? Verdict::Ok : Verdict::NotFit,
                             account.damage.empty() ? "whole" : account.damage,
                             "any operation writes what is before the damage"));
  findings.push_back(finding("rawlog", "header", account.header ? Verdict::Ok : Verdict::NotFit,
                             account.header ? fmt::format("{} lidars", account.header->lidars.size()) : "none",
                             "record it with scanloom: nothing is known of its lidars"));
  findings.push_back(finding("rawlog", "late IMU", account.late_imu > 0 ? Verdict::Warning : Verdict::Ok,
                             fmt::format("{} samples come more than 20 ms after they were needed", account.late_imu),
                             "a program that reads in the file's order deskews without them"));
  for (const auto& [label, a] : account.labels)
  {
    addDelivery(label, a, findings);
    if (a.clouds > 0 && account.header) addClouds(label, a, *account.header, findings);
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
    if (a.clouds > 0)
    {
      entry.update({{"points", a.points}, {"empty", a.empty}, {"outside", a.outside}, {"disordered", a.disordered}});
      entry["lidars"] = json::object();
      for (std::size_t id = 0; id < a.lidars.size(); ++id)
        entry["lidars"][account.header->lidars[id].name] = {{"points", a.lidars[id].points},
                                                            {"columns", a.lidars[id].columns},
                                                            {"silent_scans", a.lidars[id].silent_scans},
                                                            {"missing_columns", a.lidars[id].missing_columns}};
    }
    labels[label] = std::move(entry);
  }
  return json{{"labels", labels},
              {"first_s", secondsOf(account.first)},
              {"last_s", secondsOf(account.last)},
              {"span_s", seconds(account.last - account.first)},
              {"late_imu", account.late_imu},
              {"passed_over", account.passed_over},
              {"damage", account.damage}}
      .dump();
}
}  // namespace scanloom
