#include "run/topics/RosTopics.h"

#include "base/core/rosName.h"
#include "estimation/preprocessing/Thin.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>

namespace scanloom
{
namespace
{
const std::string kMapFrame = "map", kOdometryFrame = "odom", kBodyFrame = "base_link", kImuFrame = "imu_link";

constexpr double kMapEdge = 0.2;     // m, of the cubes of a keyframe with one point each
constexpr int kKeptKeyframes = 200;  // for readers that come late: half a megabyte each
constexpr int kKeptScans = 5;
constexpr int kKeptSamples = 500;

/** The same about the axes of the map, as ROS has them; ours are along the body's. */
Matrix6d alongMap(const Matrix6d& along_body, const Eigen::Quaterniond& map_R_body)
{
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = map_R_body.toRotationMatrix();
  return turn * along_body * turn.transpose();
}

std::vector<StampedTransform> framesOf(const SensorSetup& setup, int imu, Timestamp stamp)
{
  std::vector<StampedTransform> frames;
  for (const RecordedLidar& lidar : setup.header.lidars)
    frames.push_back({stamp, kBodyFrame, rosName(lidar.name), lidar.body_T_sensor});
  if (const auto pose = setup.body_T_imu.find(imu); pose != setup.body_T_imu.end())
    frames.push_back({stamp, kBodyFrame, kImuFrame, pose->second});
  return frames;
}

bool isSame(const Rigid& a, const Rigid& b)
{
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

bool isSame(const std::vector<StampedTransform>& a, const std::vector<StampedTransform>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const StampedTransform& one, const StampedTransform& two)
                    { return one.child == two.child && isSame(one.parent_T_child, two.parent_T_child); });
}

DiagnosticStatus statusOf(const LidarAccount& now, const LidarCounters& before)
{
  using Level = DiagnosticStatus::Level;
  const LidarCounters& counters = now.counters;
  const std::uint64_t emitted = counters.emitted - before.emitted;
  const std::uint64_t lost = counters.lost - before.lost, late = counters.late - before.late;
  DiagnosticStatus status{Level::Ok, "scanloom: lidar " + now.name, "OK", "", {}};
  if (emitted == 0)
  {
    status.level = Level::Error;
    status.message = "SILENT";
  }
  else if (lost + late > 0)
  {
    status.level = Level::Warning;
    status.message = fmt::format("{} blocks lost, {} late in the last second", lost, late);
  }
  forEachCount(counters, [&](const char* name, std::uint64_t count)
               { status.values.emplace_back(name, fmt::format("{}", count)); });
  status.values.emplace_back("clock_offset_s", fmt::format("{:.6f}", seconds(now.clock_offset)));
  return status;
}

DiagnosticStatus statusOf(Health health)
{
  using Level = DiagnosticStatus::Level;
  const Level level = health == Health::Ok ? Level::Ok : health == Health::Lost ? Level::Error : Level::Warning;
  return {level, "scanloom: localisation", toString(health), "", {}};
}

/** Of a scan its end: then it is whole. */
Timestamp stampOf(const SensorEvent& event)
{
  if (const auto* scan = std::get_if<Scan>(&event)) return scan->end();
  if (const auto* part = std::get_if<ScanPart>(&event)) return part->scan.end();
  if (const auto* imu = std::get_if<SensorImu>(&event)) return imu->sample.stamp;
  return std::get<EventMark>(event).stamp;
}
}  // namespace

RosTopics::RosTopics(std::shared_ptr<Ros2Node> node, const std::string& name_space, bool localised)
  : node_(std::move(node)), name_space_(name_space), localised_(localised)
{
  constexpr const char *kClouds = "sensor_msgs/msg/PointCloud2", *kTransforms = "tf2_msgs/msg/TFMessage";
  points_ = advertise(name_space_ + "/points", kClouds, {kKeptScans});
  imu_ = advertise(name_space_ + "/imu", "sensor_msgs/msg/Imu", {kKeptSamples});
  tf_static_ = advertise("/tf_static", kTransforms, {1, true});
  diagnostics_ = advertise("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", {10});
  if (localised_)
  {
    odometry_ = advertise(name_space_ + "/odometry", "nav_msgs/msg/Odometry", {kKeptSamples});
    map_ = advertise(name_space_ + "/map", kClouds, {kKeptKeyframes, true});
    tf_ = advertise("/tf", kTransforms, {kKeptSamples});
  }
  thread_ = std::thread(
      [this]
      {
        while (std::optional<Outgoing> next = queue_.pop())
          if (!node_->publish(next->topic, std::move(next->message))) ++refused_;
      });
  ::pthread_setname_np(thread_.native_handle(), "scanloom-pub");
}

RosTopics::~RosTopics()
{
  queue_.end();
  thread_.join();
}

std::size_t RosTopics::advertise(const std::string& topic, const std::string& type, const Ros2Keep& keep)
{
  return node_->advertise({topic, type}, keep);
}

void RosTopics::send(std::size_t topic, std::size_t kind, std::vector<std::uint8_t> message)
{
  queue_.pushDroppingOldest({topic, kind, std::move(message)});
}

int RosTopics::imuInUse() const
{
  return setup_.body_T_imu.empty() ? SensorImu::kBody : setup_.body_T_imu.begin()->first;
}

void RosTopics::describe(const SensorSetup& setup)
{
  const std::vector<StampedTransform> before = framesOf(setup_, imuInUse(), newest_);
  setup_ = setup;
  const std::vector<StampedTransform> frames = framesOf(setup_, imuInUse(), newest_);
  if (frames.empty() || isSame(frames, before)) return;
  send(tf_static_, kSmall, transformsMessage(frames));
  if (const auto imu = setup_.body_T_imu.find(imuInUse()); imu != setup_.body_T_imu.end()) motion_.setImu(imu->second);
}

void RosTopics::sendPoints(std::size_t topic, const Scan& scan)
{
  if (node_->hasReaders(topic)) send(topic, kLarge, cloudMessage(scan.points, scan.start, kBodyFrame));
}

void RosTopics::add(const Scan& scan)
{
  newest_ = std::max(newest_, scan.end());
  sendPoints(points_, scan);
}

void RosTopics::add(const ScanPart& part)
{
  if (!slices_) slices_ = advertise(name_space_ + "/slices", "sensor_msgs/msg/PointCloud2", {10 * kKeptScans});
  sendPoints(*slices_, part.scan);
}

void RosTopics::add(const SensorImu& imu)
{
  if (imu.sensor != imuInUse()) return;
  if (node_->hasReaders(imu_)) send(imu_, kSmall, imuMessage(imu.sample, kImuFrame));
  const std::optional<PredictedMotion::Motion> predicted = localised_ ? motion_.add(imu.sample) : std::nullopt;
  if (!predicted) return;
  sendOdometry({predicted->stamp, kOdometryFrame, kBodyFrame, map_T_odom_.inverse() * predicted->map_T_body,
                Matrix6d::Zero(), predicted->velocity, predicted->turn_rate});
}

void RosTopics::add(const StateEstimate& estimate)
{
  health_ = estimate.health;
  const PredictedMotion::Motion motion = motion_.correct(estimate);
  // Found again elsewhere: the body has not jumped in odom, which goes on smoothly (REP-105).
  if (estimate.leaps()) map_T_odom_ = estimate.map_T_body * odom_T_body_.inverse();
  odom_T_body_ = map_T_odom_.inverse() * estimate.map_T_body;
  sendOdometry({estimate.stamp, kOdometryFrame, kBodyFrame, odom_T_body_,
                alongMap(estimate.covariance, odom_T_body_.rotation), motion.velocity, motion.turn_rate});
  if (estimate.keyframe) addMap(*estimate.keyframe);
}

void RosTopics::addMap(const Keyframe& keyframe)
{
  PointCloud points = thin(keyframe.points, kMapEdge);
  send(map_, kLarge, cloudMessage(points, keyframe.stamp, kMapFrame, keyframe.map_T_body));
}

void RosTopics::add(const StampedPose& pose)
{
  sendOdometry({pose.stamp, kOdometryFrame, kBodyFrame, pose.map_T_body});
}

void RosTopics::sendOdometry(const BodyMotion& motion)
{
  if (node_->hasReaders(odometry_)) send(odometry_, kSmall, odometryMessage(motion));
  if (!node_->hasReaders(tf_)) return;
  send(tf_, kSmall,
       transformsMessage({{motion.stamp, kMapFrame, kOdometryFrame, map_T_odom_},
                          {motion.stamp, kOdometryFrame, kBodyFrame, motion.frame_T_body}}));
}

void RosTopics::update(const RigAccount& account, Clock::time_point now)
{
  constexpr auto kEvery = 1s;
  if (now - diagnosed_ < kEvery) return;
  diagnosed_ = now;
  std::vector<DiagnosticStatus> all;
  if (localised_) all.push_back(statusOf(health_));
  for (std::size_t i = 0; i < account.lidars.size(); ++i)
    all.push_back(
        statusOf(account.lidars[i], i < account_.lidars.size() ? account_.lidars[i].counters : LidarCounters{}));
  account_ = account;
  send(diagnostics_, kSmall, diagnosticsMessage(newest_, all));
}

std::optional<SensorEvent> PublishedInput::next(Duration patience)
{
  constexpr auto kReadAgainAfter = 1s;  // setup() copies all that is known; live it becomes more, but not at each event
  std::optional<SensorEvent> event = input_.next(patience);
  const auto now = RosTopics::Clock::now();
  if (now - described_ > kReadAgainAfter)
  {
    topics_.describe(input_.setup());
    topics_.update(input_.account(), now);
    described_ = now;
  }
  if (!event) return event;
  if (pace_ == Pace::OfSensors) keepPace(*event);
  if (const auto* scan = std::get_if<Scan>(&*event))
  {
    topics_.add(*scan);
    if (const std::optional<Rigid> pose = poseAt(poses_, scan->end(), 1s)) topics_.add(StampedPose{scan->end(), *pose});
  }
  if (const auto* part = std::get_if<ScanPart>(&*event)) topics_.add(*part);
  if (const auto* sample = std::get_if<SensorImu>(&*event)) topics_.add(*sample);
  return event;
}

void PublishedInput::keepPace(const SensorEvent& event)
{
  constexpr auto kLongestPause = 1s;  // a recording may have a gap of hours
  const Timestamp stamp = stampOf(event);
  const auto now = RosTopics::Clock::now();
  if (!first_)
  {
    first_ = stamp;
    started_ = now;
  }
  const RosTopics::Clock::time_point due = started_ + (stamp - *first_);
  if (due > now + kLongestPause) started_ -= due - now - kLongestPause;
  std::this_thread::sleep_until(std::min(due, now + kLongestPause));
}

RigAccount PublishedInput::account() const
{
  RigAccount account = input_.account();
  account.input["messages_not_published"] = topics_.dropped();
  return account;
}
}  // namespace scanloom
