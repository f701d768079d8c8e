/** A summary of a rawlog's contents. */
#pragma once
#include "base/core/Time.h"
#include "input/rig/RecordingHeader.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** The observations of one label and class. */
struct RawlogSensor
{
  std::string label;
  std::string observation_class;  // "mrpt::obs::CObservationPointCloud"
  std::string cloud_class;        // "mrpt::maps::CGenericPointsMap"; empty for what is no cloud
  std::size_t count = 0;
  std::uint64_t points = 0;
  Timestamp first;  // earliest and latest stamp
  Timestamp last;
};

struct RawlogInfo
{
  std::optional<RecordingHeader> header;
  std::vector<RawlogSensor> sensors;  // in order of label, then class; the header is not among them
  std::uintmax_t file_size = 0;       // bytes on disk
  std::string damage;                 // empty if the file is whole

  std::size_t observations() const;
  std::uint64_t points() const;

  /** From the earliest stamp to the latest; 0 if there is no observation. */
  Duration span() const;
};

/** Throws std::runtime_error if the file cannot be opened, std::invalid_argument if its header is damaged. */
RawlogInfo rawlogInfo(const std::filesystem::path&);
}  // namespace scanloom
