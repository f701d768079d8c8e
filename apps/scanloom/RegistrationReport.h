/** What `scanloom register` says: for persons and for programs. */
#pragma once
#include "evaluation/RegistrationTrials.h"

#include <cstddef>
#include <optional>
#include <string>

namespace scanloom
{
struct CloudCounts
{
  std::size_t target = 0, target_dropped = 0, source = 0, source_dropped = 0;
};

struct RegistrationReport
{
  CloudCounts points;
  double target_milliseconds = 0, source_milliseconds = 0;  // of preparation
  TimedRegistration registration;
  std::optional<PoseError> error;  // where the truth is known
};

/** "0.97 y + 0.24 about z": a direction in the tangent of boxPlus, small components left out. */
std::string directionName(const Vector6d&);

std::string toText(const RegistrationReport&);
std::string toJson(const RegistrationReport&);

std::string toText(const TrialsReport&);
std::string toJson(const TrialsReport&);
}  // namespace scanloom
