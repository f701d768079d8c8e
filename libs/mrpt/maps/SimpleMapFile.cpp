#include "mrpt/maps/SimpleMapFile.h"

#include "input/rawlogs/Conversions.h"
#include "mrpt/maps/internal/PoseCovariance.h"

#include <fmt/format.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <fcntl.h>

#include <algorithm>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** The points of one lidar, in its own frame, as at one instant. */
Scan scanOf(const Keyframe& keyframe, std::size_t lidar, const Rigid& sensor_T_body)
{
  const PointCloud& all = keyframe.points;
  Scan scan;
  scan.start = keyframe.stamp;
  PointCloud& points = scan.points;
  points.resize(static_cast<std::size_t>(std::count(all.sensor_id.begin(), all.sensor_id.end(), lidar)));
  std::size_t next = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (all.sensor_id[i] != lidar) continue;
    const Eigen::Vector3f p = (sensor_T_body * all.position(i).cast<double>().eval()).cast<float>();
    points.x[next] = p.x();
    points.y[next] = p.y();
    points.z[next] = p.z();
    points.intensity[next] = all.intensity[i];
    points.ring[next] = all.ring[i];
    points.column[next] = all.column[i];
    points.sensor_id[next++] = all.sensor_id[i];
  }
  return scan;
}
using Bytes = std::vector<std::uint8_t>;

/**
 * A CSimpleMap that says how many keyframes follow, and holds none of them. Since 2.11.11 MRPT writes version 2, with
 * velocities; every MRPT from 2.5 on reads version 1.
 */
class SimpleMapWithout : public mrpt::maps::CSimpleMap
{
 public:
  explicit SimpleMapWithout(std::uint32_t keyframes) : keyframes_(keyframes) {}

 protected:
  std::uint8_t serializeGetVersion() const override { return 1; }
  void serializeTo(mrpt::serialization::CArchive& out) const override { out << keyframes_; }

 private:
  std::uint32_t keyframes_;
};

/** What is written before the keyframes, and behind them the last byte. */
Bytes withoutKeyframes(std::uint32_t count)
{
  const SimpleMapWithout map(count);
  Bytes bytes;
  mrpt::serialization::ObjectToOctetVector(&map, bytes);
  return bytes;
}

/** Stored without compression, it is as long for any number of keyframes. */
void writeHead(const std::filesystem::path& path, std::uint32_t keyframes)
{
  constexpr int kStored = 0;
  GzipArchive head(::open(path.c_str(), O_WRONLY | O_CLOEXEC), path, kStored);
  const Bytes bytes = withoutKeyframes(keyframes);
  head.WriteBuffer(bytes.data(), bytes.size() - 1);
  head.close();
}

std::filesystem::path withHead(const std::filesystem::path& path)
{
  writeHead(path, 0);
  return path;
}

constexpr int kFast = 1;
}  // namespace

SimpleMapWriter::SimpleMapWriter(const std::filesystem::path& path, std::vector<MountedLidar> lidars,
                                 CloudClass cloud_class)
  : lidars_(std::move(lidars)),
    cloud_class_(cloud_class),
    file_(path),
    archive_(::open(withHead(file_.temporary()).c_str(), O_WRONLY | O_APPEND | O_CLOEXEC), path, kFast)
{
  toObservation(Scan{}, cloud_class);  // throws here instead of at the first keyframe
}

void SimpleMapWriter::add(const MeasuredKeyframe& measured)
{
  const Keyframe& keyframe = measured.keyframe;
  for (const std::uint8_t sensor_id : keyframe.points.sensor_id)
    if (sensor_id >= lidars_.size())
      throw std::invalid_argument(fmt::format(
          "keyframes.simplemap: a point has sensor_id = {}, but there are {} lidars", sensor_id, lidars_.size()));

  mrpt::obs::CSensoryFrame frame;
  if (measured.imu) frame.insert(toObservation(measured.imu->sample, measured.imu->body_T_imu));
  for (std::size_t lidar = 0; lidar < lidars_.size(); ++lidar)
  {
    const Scan scan = scanOf(keyframe, lidar, lidars_[lidar].body_T_sensor.inverse());
    if (scan.points.empty()) continue;
    const auto observation = toObservation(scan, cloud_class_, lidars_[lidar].name);
    observation->sensorPose = toMrpt(lidars_[lidar].body_T_sensor);
    frame.insert(observation);
  }
  const mrpt::poses::CPose3DPDFGaussian pose(
      toMrpt(keyframe.map_T_body), mrpt::math::CMatrixDouble66(ofAngles(keyframe.map_T_body, measured.covariance)));
  archive_ << pose << frame;
  ++keyframes_;
}

void SimpleMapWriter::close()
{
  archive_ << withoutKeyframes(0).back();
  archive_.close();
  writeHead(file_.temporary(), keyframes_);
  file_.commit();
}
}  // namespace scanloom
