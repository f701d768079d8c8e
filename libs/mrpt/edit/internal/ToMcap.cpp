#include "mrpt/edit/internal/ToMcap.h"

#include "base/core/OutputFile.h"
#include "input/bags/MessageWriter.h"
#include "input/bags/RosDefinitions.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/edit/internal/ExportTables.h"
#include "mrpt/observations/Observations.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>

namespace scanloom
{
namespace
{
const std::string kBodyFrame = "base_link", kMapFrame = "map";

/** Letters, digits and '_': what ROS allows in names. */
std::string rosName(std::string label)
{
  const auto is_allowed = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  std::replace_if(
      label.begin(), label.end(), [&](unsigned char c) { return !is_allowed(c); }, '_');
  return label.empty() ? "unnamed" : label;
}

/** The points by `frame_T_body` in the frame of this name. */
std::vector<std::uint8_t> cloudMessageOf(const Scan& scan, const std::string& frame, const Rigid& frame_T_body)
{
  struct Field
  {
    const char* name;
    std::uint32_t offset;
    std::uint8_t type;  // of sensor_msgs/PointField
  };
  constexpr Field kFields[] = {{"x", 0, 7},  {"y", 4, 7},     {"z", 8, 7},     {"intensity", 12, 7},
                               {"t", 16, 6}, {"ring", 20, 4}, {"lidar", 22, 2}};
  constexpr std::uint32_t kStep = 24;
  const PointCloud& points = scan.points;
  std::vector<std::uint8_t> data(points.size() * kStep);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3d in_body(points.x[i], points.y[i], points.z[i]);
    const Eigen::Vector3f in_frame = (frame_T_body * in_body).cast<float>();
    for (std::size_t axis = 0; axis < 3; ++axis) store(data, i * kStep + 4 * axis, in_frame[static_cast<int>(axis)]);
    store(data, i * kStep + 12, static_cast<float>(points.intensity[i]));
    store(data, i * kStep + 16, static_cast<std::uint32_t>(std::max(points.t[i], 0)));
    store(data, i * kStep + 20, std::uint16_t{points.ring[i]});
    data[i * kStep + 22] = points.sensor_id[i];
  }
  MessageWriter message;
  message.header(scan.start, frame);
  message.number(std::uint32_t{1});
  message.number(static_cast<std::uint32_t>(points.size()));
  message.number(static_cast<std::uint32_t>(std::size(kFields)));
  for (const Field& field : kFields)
  {
    message.string(field.name);
    message.number(field.offset);
    message.number(field.type);
    message.number(std::uint32_t{1});
  }
  message.number(std::uint8_t{0});  // little endian
  message.number(kStep);
  message.number(static_cast<std::uint32_t>(data.size()));
  message.byteSequence(data);
  message.number(std::uint8_t{1});  // no point without coordinates
  return message.bytes();
}

std::vector<std::uint8_t> pathMessageOf(const Trajectory& trajectory)
{
  MessageWriter message;
  message.header(trajectory.back().stamp, kMapFrame);
  message.number(static_cast<std::uint32_t>(trajectory.size()));
  for (const StampedPose& pose : trajectory)
  {
    message.header(pose.stamp, kMapFrame);
    message.vector(pose.map_T_body.translation);
    message.quaternion(pose.map_T_body.rotation);
  }
  return message.bytes();
}

class McapExport
{
 public:
  McapExport(const std::filesystem::path& path, Trajectory trajectory, std::optional<RecordingHeader> header)
    : file_(path),
      writer_(file_.stream()),
      trajectory_(std::move(trajectory)),
      header_(std::move(header)),
      poses_given_(!trajectory_.empty())
  {
  }

  void add(const ObservationPtr& observation)
  {
    const Timestamp stamp = fromMrpt(observation->timestamp);
    writePosesUntil(stamp);
    if (const auto cloud = cloudIn(observation); cloud && !isSlice(*cloud)) add(*cloud);
    const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get());
    if (const auto recorded = imu ? fromObservation(*imu) : std::nullopt) add(*recorded);
    if (const auto pose = poses_given_ ? std::nullopt : robotPoseIn(*observation))
      trajectory_.push_back({stamp, *pose});
  }

  void close()
  {
    writePosesUntil(Timestamp::max());
    if (!trajectory_.empty())
      writer_.add(topic("/path", pathSchema()), trajectory_.back().stamp, pathMessageOf(trajectory_));
    writer_.close();
    file_.commit();
  }

 private:
  std::uint16_t topic(const std::string& name, const McapSchema& schema)
  {
    const auto known = topics_.find(name);
    return known != topics_.end() ? known->second : topics_[name] = writer_.addTopic(name, schema);
  }

  void add(const mrpt::obs::CObservationPointCloud& cloud)
  {
    const Scan scan = fromObservation(cloud, header_);
    const RecordedLidar* lidar = onlyLidarOf(cloud);
    const std::string frame = lidar ? rosName(lidar->name) : kBodyFrame;
    const Rigid body_T_frame = lidar ? lidar->body_T_sensor : Rigid::identity();
    if (lidar) addFrame(scan.start, frame, body_T_frame);
    writer_.add(topic("/" + rosName(cloud.sensorLabel), pointCloudSchema()), scan.start,
                cloudMessageOf(scan, frame, body_T_frame.inverse()));
  }

  /** Of a cloud that splitLidars() made. */
  const RecordedLidar* onlyLidarOf(const mrpt::obs::CObservationPointCloud& cloud) const
  {
    const auto part = header_ ? partOf(cloud.sensorLabel, *header_) : std::nullopt;
    return part ? &header_->lidars[part->lidar] : nullptr;
  }

  void addFrame(Timestamp stamp, const std::string& frame, const Rigid& body_T_frame)
  {
    if (frames_.insert(frame).second)
      writer_.add(topic("/tf_static", transformsSchema()), stamp,
                  transformMessage(stamp, kBodyFrame, frame, body_T_frame));
  }

  void add(const RecordedImu& imu)
  {
    const std::string frame = rosName(imu.label);
    addFrame(imu.sample.stamp, frame, imu.body_T_imu);
    writer_.add(topic("/" + frame, imuSchema()), imu.sample.stamp, imuMessage(imu.sample, frame));
  }

  void writePosesUntil(Timestamp end)
  {
    for (; written_ < trajectory_.size() && trajectory_[written_].stamp <= end; ++written_)
    {
      const StampedPose& pose = trajectory_[written_];
      writer_.add(topic("/tf", transformsSchema()), pose.stamp,
                  transformMessage(pose.stamp, kMapFrame, kBodyFrame, pose.map_T_body));
    }
  }

  OutputFile file_;
  McapWriter writer_;
  Trajectory trajectory_;
  std::optional<RecordingHeader> header_;
  bool poses_given_;
  std::size_t written_ = 0;  // poses
  std::map<std::string, std::uint16_t> topics_;
  std::set<std::string> frames_;  // whose pose was written
};
}  // namespace

RawlogOperation toMcap(const std::filesystem::path& file, Trajectory trajectory,
                       const std::optional<RecordingHeader>& header)
{
  auto mcap = std::make_shared<McapExport>(file, std::move(trajectory), header);
  return readOnly([mcap](const ObservationPtr& observation) { mcap->add(observation); }, [mcap] { mcap->close(); });
}
}  // namespace scanloom
