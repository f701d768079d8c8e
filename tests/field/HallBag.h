/** A drive of 7 s through a hall of posts as messages of ROS 1: one lidar of 16 beams, and an IMU beside it. */
#pragma once
#include "base/core/Angle.h"
#include "estimation/imu/AnalyticDrive.h"
#include "estimation/ndt/RayWorld.h"
#include "support/HandmadeMessages.h"

#include <functional>
#include <string>
#include <vector>

namespace scanloom
{
/** A point as a lidar's driver knows it. */
struct DriverPoint
{
  float x = 0, y = 0, z = 0;
  std::uint32_t after = 0;  // ns after the turn's first column
  std::uint16_t ring = 0;
};

struct HallDrive
{
  struct Turn
  {
    std::uint64_t start;  // ns
    std::vector<DriverPoint> points;
  };
  std::vector<Turn> turns;
  std::vector<ImuSample> imu;
};

namespace hall_drive
{
constexpr std::uint64_t kStart = 1'750'000'000'000'000'000, kTurn = 100'000'000;
constexpr int kColumns = 900, kBeams = 16;

inline RayWorld hall()
{
  RayWorld world{{{Eigen::Vector3d::UnitZ(), -1.8},
                  {Eigen::Vector3d::UnitX(), -15},
                  {Eigen::Vector3d::UnitX(), 25},
                  {Eigen::Vector3d::UnitY(), -20},
                  {Eigen::Vector3d::UnitY(), 20}},
                 {}};
  for (int i = 0; i < 24; ++i) world.stems.push_back({{-12.0 + 1.4 * i, i % 2 == 0 ? 4.0 + i % 7 : -4.0 - i % 5}, 0.2});
  return world;
}

/** 2 s at rest, then ahead and to the left. */
inline NavState stateAt(Duration t, const AnalyticDrive& drive)
{
  return drive.stateAt(std::max(Timestamp{t}, Timestamp{2s}) - 2s);
}

inline AnalyticDrive drive()
{
  AnalyticDrive d;
  d.x = {0, 1.5, -1.5, 1, 0}, d.y = {0, 0, 0, 1, 0}, d.z = {0, 0, 0, 1, 0};
  d.yaw = {0, 0.1, -0.1, 1, 0}, d.pitch = {0, 0, 0, 1, 0}, d.roll = {0, 0.02, -0.02, 1, 0};
  return d;
}
}  // namespace hall_drive

inline HallDrive driveThroughHall()
{
  using namespace hall_drive;
  const AnalyticDrive path = drive();
  const RayWorld world = hall();
  HallDrive recorded;
  for (int turn = 0; turn < 70; ++turn)
  {
    HallDrive::Turn seen{kStart + static_cast<std::uint64_t>(turn) * kTurn, {}};
    for (int column = 0; column < kColumns; ++column)
    {
      const auto after = static_cast<std::uint32_t>(column * (kTurn / kColumns));
      const Rigid world_T_lidar = stateAt(turn * 100ms + Duration{after}, path).map_T_imu;
      for (int ring = 0; ring < kBeams; ++ring)
      {
        const Eigen::Vector3d ray = rayAt(-2 * M_PI * column / kColumns, (2 * ring - 15) * kDegree);
        const auto range = world.range(world_T_lidar.translation, world_T_lidar.rotation * ray, 100);
        if (!range) continue;
        const Eigen::Vector3f p = (*range * ray).cast<float>();
        seen.points.push_back({p.x(), p.y(), p.z(), after, static_cast<std::uint16_t>(ring)});
      }
    }
    recorded.turns.push_back(std::move(seen));
  }
  for (Duration t{0}; t < 7s; t += 5ms)
  {
    ImuSample sample = path.sampleAt(std::max(Timestamp{t}, Timestamp{2s}) - 2s);
    if (t < 2s) sample.gyro.setZero(), sample.accel = -gravityInMap();
    sample.stamp = Timestamp{Duration{static_cast<std::int64_t>(kStart)} + t};
    recorded.imu.push_back(sample);
  }
  return recorded;
}

/** A field of a cloud's points, and its value of a point. */
struct DriverField
{
  std::string name;
  std::uint8_t type;  // 4 uint16, 6 uint32, 7 float, 8 double
  std::function<std::string(const DriverPoint&)> valueOf;
};

inline DriverField fieldOf(const std::string& name, float DriverPoint::*member)
{
  return {name, 7, [member](const DriverPoint& p) { return littleEndian(p.*member); }};
}

inline std::vector<DriverField> positions()
{
  return {fieldOf("x", &DriverPoint::x), fieldOf("y", &DriverPoint::y), fieldOf("z", &DriverPoint::z)};
}

inline DriverField ringField()
{
  return {"ring", 4, [](const DriverPoint& p) { return littleEndian(p.ring); }};
}

/** sensor_msgs/PointCloud2 of a driver with these fields. */
inline std::string cloudWith(const std::vector<DriverField>& fields, std::uint64_t stamp,
                             const std::vector<DriverPoint>& points)
{
  std::string described, data;
  std::uint32_t step = 0;
  for (const DriverField& field : fields)
  {
    described += cloudField(field.name, step, field.type);
    step += static_cast<std::uint32_t>(field.valueOf(DriverPoint{}).size());
  }
  for (const DriverPoint& p : points)
    for (const DriverField& field : fields) data += field.valueOf(p);
  const auto count = static_cast<std::uint32_t>(points.size());
  return headerOf(stamp, "lidar") + littleEndian(std::uint32_t{1}) + littleEndian(count) +
         littleEndian(static_cast<std::uint32_t>(fields.size())) + described + std::string(1, '\0') +
         littleEndian(step) + littleEndian(step * count) + withLength(data) + std::string(1, '\1');
}

/** sensor_msgs/Imu. */
inline std::string imuOf(const ImuSample& sample)
{
  std::string numbers = littleEndian(0.0) + littleEndian(0.0) + littleEndian(0.0) + littleEndian(1.0);
  const std::string unknown(9 * sizeof(double), '\0');
  numbers += unknown;
  for (const Eigen::Vector3d& v : {sample.gyro, sample.accel})
    numbers += littleEndian(v.x()) + littleEndian(v.y()) + littleEndian(v.z()) + unknown;
  return headerOf(static_cast<std::uint64_t>(nanoseconds(sample.stamp)), "imu") + numbers;
}
}  // namespace scanloom
