#pragma once
#include "doctor/RigEvidence.h"

#include <filesystem>
#include <string>

namespace scanloom
{
struct RawlogEvidence
{
  RigEvidence rig;
  std::string damage;  // a message; empty if the whole file was read
};

/**
 * IMU samples and some scans of a rawlog; it holds no packets. Throws std::runtime_error if it can't be opened or its
 * first object is not scanloom's header.
 */
RawlogEvidence rawlogEvidence(const std::filesystem::path&);
}  // namespace scanloom
