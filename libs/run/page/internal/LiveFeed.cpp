#include "run/page/internal/LiveFeed.h"

#include "input/rig/RepeatedWarnings.h"
#include "run/page/internal/openDirection.h"

#include <algorithm>

namespace scanloom
{
namespace
{
using namespace std::chrono_literals;

constexpr std::size_t kScanPoints = 4000, kKeyframePoints = 60000, kMostWaiting = 8, kMostWarnings = 30,
                      kMostMarks = 100, kMarksShown = 20;
constexpr LiveFeed::Clock::duration kOfferEvery = 50ms, kRateEvery = 1s;
constexpr double kPathStep = 0.1;  // m

const std::string kBodyImu = "body";

double per(std::uint64_t count, double seconds) { return seconds > 0 ? static_cast<double>(count) / seconds : 0; }
}  // namespace

LiveFeed::LiveFeed(LiveExchange& exchange, const ViewedWork& work) : exchange_(exchange), localised_(work.localised)
{
  status_.verb = work.verb;
  status_.live = work.live;
  offer();
}

void LiveFeed::add(const Scan& scan, const RecordingHeader& header)
{
  ++status_.scans;
  status_.newest = scan.end();
  if (!status_.first) status_.first = scan.end();
  status_.scan_came = Clock::now();
  watchLidars(scan, header);
  PlacedCloud placed{scan.start, scan.period, {}, {}, thinned(scan.points, kScanPoints)};
  if (localised_)
    waiting_.push_back(std::move(placed));
  else
    news_.append({{std::move(placed)}, {}, {}, false});
  if (waiting_.size() > kMostWaiting) waiting_.pop_front();
}

void LiveFeed::watchLidars(const Scan& scan, const RecordingHeader& header)
{
  received_.resize(std::max(received_.size(), header.lidars.size()));
  status_.lidars.resize(received_.size());
  for (std::size_t i = 0; i < header.lidars.size(); ++i)
  {
    status_.lidars[i].name = header.lidars[i].name;
    status_.lidars[i].model = header.lidars[i].model;
    received_[i].beams = header.lidars[i].beams;
  }
  for (const Column& column : scan.columns)
  {
    if (column.sensor_id >= received_.size()) continue;
    ++received_[column.sensor_id].columns;
    received_[column.sensor_id].points += column.count;
    status_.lidars[column.sensor_id].seen = scan.end();
  }
}

void LiveFeed::add(const SensorImu& read, const RecordingHeader& header)
{
  const Timestamp stamp = read.sample.stamp;
  ReceivedImu& received = received_imus_.try_emplace(read.sensor, ReceivedImu{0, stamp}).first->second;
  ++received.samples;
  const auto of = static_cast<std::size_t>(read.sensor);
  const bool own = read.sensor >= 0 && of < header.lidars.size();
  const std::string& name = own ? header.lidars[of].name : kBodyImu;
  const auto before = [](const ViewedImu& imu, const std::string& other) { return imu.name < other; };
  auto shown = std::lower_bound(status_.imus.begin(), status_.imus.end(), name, before);
  if (shown == status_.imus.end() || shown->name != name) shown = status_.imus.insert(shown, {name, 0, stamp});
  shown->seen = stamp;
  const double since = seconds(stamp - received.since);
  if (since < 1) return;
  shown->rate = per(received.samples, since);
  received = {0, stamp};
}

void LiveFeed::add(const StateEstimate& estimate)
{
  ++status_.poses;
  status_.keyframes += estimate.keyframe.has_value();
  status_.health = toString(estimate.health);
  status_.why = estimate.health == Health::Ok ? "" : openDirection(estimate);
  status_.speed = estimate.velocity.norm();
  if (estimate.entered_map)  // what was drawn is in another frame
  {
    news_ = {};
    news_.restarted = true;
  }
  const bool leaps = !last_ || estimate.leaps();
  const Rigid before = leaps ? estimate.map_T_body : last_->map_T_body;
  status_.distance += (estimate.map_T_body.translation - before.translation).norm();
  addPath(estimate);
  while (!waiting_.empty() && waiting_.front().start + waiting_.front().period <= estimate.stamp)
  {
    PlacedCloud scan = std::move(waiting_.front());
    waiting_.pop_front();
    if (scan.start + scan.period < estimate.stamp) continue;  // it was skipped
    scan.map_T_begin = before;
    scan.map_T_end = estimate.map_T_body;
    news_.append({{std::move(scan)}, {}, {}, false});
  }
  if (estimate.keyframe) addMap(*estimate.keyframe);
  last_ = {estimate.stamp, estimate.map_T_body};
}

void LiveFeed::addMap(const Keyframe& keyframe)
{
  status_.keyframes_left_out += news_.keyframes.size() >= 16;
  news_.append({{},
                {{keyframe.stamp, Duration{0}, keyframe.map_T_body, keyframe.map_T_body,
                  thinned(keyframe.points, kKeyframePoints)}},
                {},
                false});
}

void LiveFeed::add(const EventMark& mark)
{
  ++status_.marks;
  status_.newest_marks.push_front({mark.text, status_.first ? seconds(mark.stamp - *status_.first) : 0});
  if (status_.newest_marks.size() > kMarksShown) status_.newest_marks.pop_back();
}

void LiveFeed::addPath(const StateEstimate& estimate)
{
  PathPoint point{estimate.map_T_body.translation.cast<float>(), static_cast<std::uint8_t>(estimate.health)};
  const bool leaps = estimate.leaps();
  if (last_path_ && !leaps && point.health == last_path_->health &&
      (point.position - last_path_->position).norm() < kPathStep)
    return;
  last_path_ = point;
  if (leaps) news_.path.push_back({point.position, kPathBreak});
  news_.path.push_back(point);
}

void LiveFeed::rateLidars(const RigAccount& account, double since, bool packets)
{
  for (std::size_t i = 0; i < received_.size(); ++i)
  {
    Received& received = received_[i];
    ViewedLidar& lidar = status_.lidars[i];
    const std::uint64_t now =
        packets && i < account.lidars.size() ? account.lidars[i].counters.packets : received.columns;
    lidar.rate = per(now - (packets ? received.packets : 0), since);
    received.packets = now;
    received.all_columns += received.columns;
    received.all_points += received.points;
    const auto share = [&](std::uint64_t points, std::uint64_t columns)
    { return static_cast<double>(points) / (received.beams * static_cast<double>(columns)); };
    if (received.beams > 0 && received.columns > 0)
    {
      lidar.returns = share(received.points, received.columns);
      lidar.usual_returns = share(received.all_points, received.all_columns);
    }
    received.columns = received.points = 0;
  }
}

void LiveFeed::update(const RigAccount& account, const FeedProgress& progress, Clock::time_point now)
{
  for (std::size_t i = 0; i < std::min(account.lidars.size(), status_.lidars.size()); ++i)
  {
    const LidarCounters& counters = account.lidars[i].counters;
    status_.lidars[i].lost = counters.lost;
    status_.lidars[i].clock_offset = seconds(account.lidars[i].clock_offset);
    status_.lidars[i].left_out = counters.late + counters.dropped;
  }
  if (now - rated_ < kRateEvery) return;
  rateLidars(account, std::chrono::duration<double>(now - rated_).count(), !account.lidars.empty());
  const double recorded = progress.recorded - rated_progress_.recorded, busy = progress.busy - rated_progress_.busy;
  if (recorded > 0 && busy > 0) status_.factor = recorded / busy;
  rated_progress_ = progress;
  rated_ = now;
}

void LiveFeed::warn(const std::string& text, Clock::time_point now)
{
  auto& warnings = status_.warnings;
  const std::string common = withoutNumbers(text);
  const auto known =
      std::find_if(warnings.begin(), warnings.end(), [&](auto& w) { return withoutNumbers(w.text) == common; });
  CountedWarning warning{text, 1, now};
  if (known != warnings.end())
  {
    warning.count += known->count;
    warnings.erase(known);
  }
  warnings.push_front(std::move(warning));
  if (warnings.size() > kMostWarnings) warnings.pop_back();
}

void LiveFeed::show(const PlayerStatus& player) { status_.player = player; }

void LiveFeed::restart()
{
  news_ = {};
  news_.restarted = true;
  waiting_.clear();
  last_.reset();
  last_path_.reset();
  received_imus_.clear();
  for (ViewedLidar& lidar : status_.lidars) lidar.seen.reset();
  status_.first = status_.newest = std::nullopt;
  status_.scans = status_.poses = status_.keyframes = status_.marks = 0;
  status_.newest_marks.clear();
  status_.distance = 0;
}

void LiveFeed::end()
{
  status_.ended = true;
  for (int tries = 0; tries < 20; ++tries)  // nothing is left that could be late
  {
    offered_ = {};
    offer();
    if (offered_ != Clock::time_point{}) return;
    std::this_thread::sleep_for(5ms);
  }
}

void LiveFeed::offer(Clock::time_point now)
{
  if (now - offered_ < kOfferEvery) return;
  const std::unique_lock lock(exchange_.mutex, std::try_to_lock);
  if (!lock) return;
  for (std::string& mark : exchange_.marks)
    if (marks_.size() < kMostMarks) marks_.push_back(std::move(mark));
  for (std::string& command : exchange_.commands)
    if (commands_.size() < kMostMarks) commands_.push_back(std::move(command));
  exchange_.marks.clear();
  exchange_.commands.clear();
  exchange_.status = status_;
  exchange_.news.append(std::move(news_));
  news_ = {};
  offered_ = now;
}

std::optional<EventMark> LiveFeed::takeMark()
{
  if (!status_.newest || marks_.empty()) return std::nullopt;
  EventMark mark{*status_.newest, std::move(marks_.front())};
  marks_.pop_front();
  return mark;
}

std::vector<std::string> LiveFeed::takeCommands() { return std::exchange(commands_, {}); }
}  // namespace scanloom
