/** A scan and the IMU samples that came with it, as Python has them. */
#pragma once
#include "CloudMemory.h"
#include "input/batching/ImuOrder.h"
#include "input/batching/Scan.h"

#include <utility>
#include <vector>

namespace scanloom
{
class PythonScan : public CloudMemory
{
 public:
  PythonScan(Scan scan, std::vector<SensorImu> imu)
    : CloudMemory(std::move(scan.points)), frame_(std::move(scan)), imu_(std::move(imu))
  {
  }

  /** Without points, which are in the memory. */
  const Scan& frame() const { return frame_; }

  /** Samples after those of the scan before. */
  std::vector<SensorImu>& imu() { return imu_; }

  Scan copy() const
  {
    Scan scan = frame_;
    scan.points = CloudMemory::copy();
    return scan;
  }

 private:
  Scan frame_;
  std::vector<SensorImu> imu_;
};
}  // namespace scanloom
