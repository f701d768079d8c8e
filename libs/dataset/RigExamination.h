/** Every measure of `scanloom doctor`, taken on one rig. */
#pragma once
#include "dataset/ClockDrift.h"
#include "dataset/ClockKind.h"
#include "dataset/CloudAgreement.h"
#include "dataset/Delivery.h"
#include "dataset/DoctorLimits.h"
#include "dataset/GroundPlane.h"
#include "imu/GyroAgreement.h"
#include "imu/GyroScale.h"
#include "dataset/ImuTiming.h"
#include "imu/MeanForce.h"
#include "dataset/OwnParts.h"
#include "dataset/RigEvidence.h"
#include "dataset/RotorPhase.h"
#include "dataset/SensorFlags.h"

/** What came back, the machine's own parts included. */
struct ReturnStatistics
{
  double share = 0;                                    // of all readings
  double range_p05 = 0, range_p50 = 0, range_p95 = 0;  // m from the sensor, of the returns beyond half a metre
};

namespace scanloom
{
struct LidarExamination
{
  std::string name;
  LidarDescription lidar;
  Delivery delivery;
  std::uint64_t malformed = 0, bad_crc = 0;
  SensorFlags flags;

  std::optional<Epoch> epoch;
  std::vector<ClockStep> steps;
  std::optional<ArrivalJitter> jitter;
  double late_share = 0;                   // of packets, beyond the configured deadline
  std::optional<ClockDrift> drift;         // against the recording computer
  std::optional<Duration> ahead_of_host;   // the clock, by its fastest packets of the last 2 s
  std::optional<Duration> ahead_of_first;  // against the first lidar's; not of the first itself
  std::optional<ClockDrift> drift_to_first;
  std::optional<RotorPhase> phase;

  std::optional<ReturnStatistics> returns;
  std::optional<GroundPlane> ground;
  OwnParts own_parts;
};

struct ImuExamination
{
  std::string name;
  ImuTiming timing;
  Eigen::Vector3d force_in_body = Eigen::Vector3d::Zero();  // mean specific force
  std::optional<GyroScale> gyro_scale;
  std::optional<GyroAgreement> to_first;  // against the first IMU's gyroscope; not of the first itself
  std::optional<double> lidar_share;      // of the lidars' time that its samples cover
};

/** Lidar `lidar`, if lidar `reference` is where it is said to be. */
struct PairExamination
{
  std::size_t lidar = 0, reference = 0;
  std::optional<CloudAgreement> agreement;
};

struct RigExamination
{
  std::vector<LidarExamination> lidars;
  std::vector<ImuExamination> imus;
  std::vector<PairExamination> pairs;  // each against the first, if poses are known
  std::optional<SocketAccount> sockets;
  bool packets_known = true;
  bool poses_known = false;
  std::map<Origin, std::uint64_t> strangers;
  Duration deadline{0};
};

struct DoctorLimits
{
  DeliveryLimits delivery;
  ClockLimits clocks;
  ImuLimits imu;
  GeometryLimits geometry;
};

RigExamination examine(RigEvidence, const DoctorLimits&);
}  // namespace scanloom
