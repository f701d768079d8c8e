#pragma once
#include "input/rawlogs/RawlogObservations.h"
#include "mrpt/observations/registerClasses.h"

namespace scanloom
{
/** The same with clouds of our own class, which MRPT's before 2.15 does not have. */
class ObservationReader : public RawlogObservations
{
 public:
  /** Throws as RawlogObservations do. */
  explicit ObservationReader(const std::filesystem::path& path) : RawlogObservations(path) { registerClasses(); }
};
}  // namespace scanloom
