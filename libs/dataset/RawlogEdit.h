/** A rawlog through an operation, object by object: what `scanloom edit` is made of. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace scanloom
{
using ObservationPtr = mrpt::obs::CObservation::Ptr;
using Observations = std::vector<ObservationPtr>;

/**
 * What becomes of an observation: none, one or several. The header is one like any other, and the first. Null is the
 * end of input: what still waits comes out. Takes what it is given for its own and may change it.
 */
using RawlogOperation = std::function<Observations(const ObservationPtr&)>;

/** `second` with all that `first` gives. */
RawlogOperation chained(RawlogOperation first, RawlogOperation second);

/** Called after each observation with the bytes of the file that were read; false stops, keeping what there is. */
using KeepReading = std::function<bool(std::uint64_t)>;

struct LabelCount
{
  std::uint64_t read = 0, written = 0;
};

struct RawlogEdited
{
  std::map<std::string, LabelCount> labels;
  std::uint64_t passed_over = 0;  // objects that are no observations
  std::string damage;             // empty if all of the file was read

  std::uint64_t read() const;
  std::uint64_t written() const;
};

/** For operations that only look, or write files of their own. Throws what ObservationReader and the operation throw.
 */
RawlogEdited readRawlog(const std::filesystem::path&, const RawlogOperation&, const KeepReading&);

/**
 * What the operation gives, gzipped, in the observation format; it may replace `input` itself. A damaged input is
 * edited up to the damage. Appears under its name when it is whole; if something throws, it does not appear.
 */
RawlogEdited editRawlog(const std::filesystem::path& input, const RawlogOperation&, const std::filesystem::path& output,
                        const KeepReading&);
}  // namespace scanloom
