#pragma once
#include "dataset/RigEvidence.h"

#include <filesystem>
#include <string>

namespace scanloom
{
struct RawlogEvidence
{
  RigEvidence rig;
  std::string damage;  // for a person: empty if all of the file was read
};

/**
 * What a rawlog of ours still knows of a rig: IMU samples, and points as the batcher left them; no packets.
 * Throws std::runtime_error if it can't be opened or has no header of ours.
 */
RawlogEvidence rawlogEvidence(const std::filesystem::path&);
}  // namespace scanloom
