/** Streams a rawlog through an operation, one observation at a time: the core of `scanloom edit`. */
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mrpt::obs
{
class CObservation;
}

namespace scanloom
{
using ObservationPtr = std::shared_ptr<mrpt::obs::CObservation>;
using Observations = std::vector<ObservationPtr>;

/**
 * Takes one observation and returns what is written in its place: none, one or several. The header is the first
 * observation of the file and is given like any other. A null pointer is the end of the input: the operation then
 * returns what it still holds. It owns what it is given and may change it.
 */
using RawlogOperation = std::function<Observations(const ObservationPtr&)>;

/** `second` receives everything that `first` returns. */
RawlogOperation chained(RawlogOperation first, RawlogOperation second);

/** For an operation that writes no rawlog: `add` receives every observation, `close` is called at the end of input. */
RawlogOperation readOnly(std::function<void(const ObservationPtr&)> add, std::function<void()> close);

/** Called after each observation with the bytes of the file that were read. False stops; what was read is kept. */
using KeepReading = std::function<bool(std::uint64_t)>;

struct LabelCount
{
  std::uint64_t read = 0, written = 0;
};

struct RawlogEdited
{
  std::map<std::string, LabelCount> labels;
  std::uint64_t passed_over = 0;  // objects that are no observations
  std::string damage;             // empty if the whole file was read
  bool stopped = false;           // by KeepReading
  std::filesystem::path output;   // what was written, if anything was

  std::uint64_t read() const;
  std::uint64_t written() const;
};

/** Runs the operation without writing what it returns. Throws what ObservationReader and the operation throw. */
RawlogEdited readRawlog(const std::filesystem::path&, const RawlogOperation&, const KeepReading&);

/**
 * Writes what the operation returns as a gzipped rawlog of the observation format. A damaged input is edited up to the
 * damage. The output appears under its name only when it is complete; if it was stopped, it replaces no other file, but
 * is put beside it (OutputFile). After an exception there is none.
 */
RawlogEdited editRawlog(const std::filesystem::path& input, const RawlogOperation&, const std::filesystem::path& output,
                        const KeepReading&);
}  // namespace scanloom
