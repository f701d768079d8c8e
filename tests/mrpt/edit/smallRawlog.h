/** Rawlogs of a few kilobytes, and what is in them. */
#pragma once
#include "base/core/StampedPose.h"
#include "base/formats/CompressedFile.h"
#include "mrpt/edit/RawlogEdit.h"
#include "mrpt/observations/ObservationReader.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/RawlogWriter.h"
#include "mrpt/observations/someScan.h"
#include "support/TemporaryFolder.h"
#include "support/runProgram.h"

#include <mrpt/obs/CObservation.h>

namespace scanloom
{
inline const Timestamp kSmallStart = fromNanoseconds(1'700'000'000'000'000'000);

/** Scans of 120 points at 10 Hz, each after two samples of `imu` and one of `imu_right`; the last scan is empty. */
inline std::filesystem::path writeSmallRawlog(const std::filesystem::path& path, int scans = 4)
{
  RawlogWriter writer(path, someHeader());
  for (int i = 0; i < scans; ++i)
  {
    const Timestamp start = kSmallStart + i * 100ms;
    writer.write(*toObservation(ImuSample{start + 10ms, {1, 2, 3}, {4, 5, 6}}, Rigid::identity()));
    writer.write(*toObservation(ImuSample{start + 50ms, {1, 2, 3}, {4, 5, 6}}, someHeader().lidars[1].body_T_sensor,
                                "imu_right"));
    writer.write(*toObservation(ImuSample{start + 60ms, {1, 2, 3}, {4, 5, 6}}, Rigid::identity()));
    Scan scan = someScan(start);
    if (i + 1 == scans) scan.points.clear();
    writer.write(*toObservation(scan));
  }
  writer.close();
  return path;
}

/** 10 m/s along x from 5 ms before the first scan on, for 250 ms. */
inline Trajectory straightOn()
{
  return {{kSmallStart - 5ms, Rigid::fromXyzYawPitchRoll(0, 0, 0, 0, 0, 0)},
          {kSmallStart + 245ms, Rigid::fromXyzYawPitchRoll(2.5, 0, 0, 0, 0, 0)}};
}

/** By gunzip, so that tests of equality do not rely on our own reader; only zstd, as MRPT 2.15 writes, by it. */
inline std::string uncompressed(const std::filesystem::path& path)
{
  const Ended ended = runProgram("gunzip -c < " + path.string());
  if (ended.status == 0) return ended.output;
  std::string bytes(uncompressedBytes(path), '\0');
  CompressedFile(path).read(bytes.data(), bytes.size());
  return bytes;
}

inline RawlogEdited edited(const std::filesystem::path& in, const RawlogOperation& operation,
                           const std::filesystem::path& out)
{
  return editRawlog(in, operation, out, [](std::uint64_t) { return true; });
}

inline Observations observationsIn(const std::filesystem::path& path)
{
  ObservationReader reader(path);
  Observations all;
  while (auto observation = reader.next()) all.push_back(observation);
  return all;
}

inline Observations observationsIn(const std::filesystem::path& path, const std::string& label)
{
  Observations some;
  for (const ObservationPtr& observation : observationsIn(path))
    if (observation->sensorLabel == label) some.push_back(observation);
  return some;
}
}  // namespace scanloom
