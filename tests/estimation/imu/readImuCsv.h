#pragma once
#include "base/core/ImuSample.h"

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace scanloom
{
/** EuRoC layout: ns, gyro in rad/s, accelerometer in m/s2; what is no such line is skipped. */
inline std::vector<ImuSample> readImuCsv(const std::string& file)
{
  std::ifstream in(file);
  std::vector<ImuSample> samples;
  for (std::string line; std::getline(in, line);)
  {
    long long ns = 0;
    ImuSample s;
    if (std::sscanf(line.c_str(), "%lld,%lf,%lf,%lf,%lf,%lf,%lf", &ns, &s.gyro.x(), &s.gyro.y(), &s.gyro.z(),
                    &s.accel.x(), &s.accel.y(), &s.accel.z()) != 7)
      continue;
    s.stamp = fromNanoseconds(ns);
    samples.push_back(s);
  }
  return samples;
}
}  // namespace scanloom
