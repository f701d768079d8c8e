/** All measures of `scanloom doctor`, taken on one rig. */
#pragma once
#include "calibration/GroundPlane.h"
#include "diagnosis/internal/ClockDrift.h"
#include "diagnosis/internal/ClockKind.h"
#include "diagnosis/internal/Delivery.h"
#include "diagnosis/internal/ImuComparison.h"
#include "diagnosis/internal/ImuSoundness.h"
#include "diagnosis/internal/ImuTiming.h"
#include "diagnosis/internal/PoseFinding.h"
#include "diagnosis/internal/RigEvidence.h"
#include "diagnosis/internal/RotorPhase.h"
#include "diagnosis/internal/SelfReturns.h"
#include "diagnosis/internal/SensorFlags.h"
#include "estimation/imu/MeanForce.h"

namespace scanloom
{
/** Offset to the first lidar's clock and drift against it: not for the first lidar itself. */
struct ClockExamination
{
  std::optional<Epoch> epoch;
  std::vector<ClockStep> steps;
  std::optional<ClockDrift> drift;        // against the recording computer
  std::optional<Duration> ahead_of_host;  // by the fastest packets of the last 2 s
  std::optional<Duration> ahead_of_first;
  std::optional<ClockDrift> drift_to_first;
  std::optional<RotorPhase> phase;
};

/** Returns of a lidar, those from the machine itself included. */
struct ReturnStatistics
{
  double share = 0;                                    // of all shots
  double range_p05 = 0, range_p50 = 0, range_p95 = 0;  // quantiles in m from the sensor, of returns beyond 0.5 m
};

struct LidarExamination
{
  std::string name;
  LidarDescription lidar;
  Delivery delivery;
  std::uint64_t malformed = 0, bad_crc = 0;  // packets
  SensorFlags flags;
  ClockExamination clock;
  std::optional<ArrivalJitter> jitter;
  std::optional<ReturnStatistics> returns;
  std::optional<GroundPlane> ground;
  SelfReturns own_parts;
};

struct ImuExamination
{
  std::string name;
  ImuTiming timing;
  ImuSoundness sound;
  Rigid configured_pose;                  // of the IMU, or of the lidar that holds it
  std::optional<ImuComparison> compared;  // with the reference (compareImus); not for the reference itself
  std::optional<double> lidar_share;      // share of the lidars' time that the samples cover
};

/** The pose of lidar `lidar` if that of lidar `reference` is right. */
struct PairExamination
{
  std::size_t lidar = 0, reference = 0;
  std::optional<CloudAgreement> agreement;
};

struct RigExamination : RigFacts
{
  std::vector<LidarExamination> lidars;
  std::vector<ImuExamination> imus;
  std::vector<PairExamination> pairs;  // each lidar against the first, if poses are known
  SelfReturns machine;                 // as all lidars see it, if their poses are known
};

/** Throws ConfigError if [crop] names a lidar that there is not. */
RigExamination examine(RigEvidence, const CropOptions& = {});
}  // namespace scanloom
