#include "mrpt/edit/internal/ToMcap.h"

#include "base/core/OutputFile.h"
#include "base/core/rosName.h"
#include "input/bags/MessageWriter.h"
#include "input/bags/RosDefinitions.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/RawlogHeader.h"
#include "mrpt/edit/internal/ExportTables.h"
#include "mrpt/observations/Observations.h"

#include <algorithm>
#include <memory>
#include <set>

namespace scanloom
{
namespace
{
const std::string kBodyFrame = "base_link", kMapFrame = "map";

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
                cloudMessage(scan.points, scan.start, frame, body_T_frame.inverse()));
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
                  transformsMessage({{stamp, kBodyFrame, frame, body_T_frame}}));
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
                  transformsMessage({{pose.stamp, kMapFrame, kBodyFrame, pose.map_T_body}}));
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
