/** The results of `scanloom register` as text and as JSON. */
#pragma once
#include "lab/evaluation/CloudRegistration.h"

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
  double target_milliseconds = 0, source_milliseconds = 0;  // to make the cells
  TimedRegistration registration;
  std::optional<PoseError> error;          // none: the true pose is not known
  std::optional<PoseError> contradiction;  // CloudPair::contradiction()

  bool trustworthy() const { return registration.result.trustworthy() && !contradiction; }
};

/** Registers, and looks for another pose that may be the true one where the guess has no covariance. */
RegistrationReport registrationReport(const CloudPair::Points& target, const CloudPair::Points& source,
                                      const PoseGuess&);

std::string toText(const RegistrationReport&);
std::string toJson(const RegistrationReport&);
}  // namespace scanloom
