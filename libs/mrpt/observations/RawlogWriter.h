#pragma once
#include "base/core/OutputFile.h"
#include "input/rig/RecordingHeader.h"

#include <mrpt/obs/obs_frwds.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace scanloom
{
class GzipArchive;

struct RawlogOptions
{
  int compression_level = 1;  // gzip, 0 to 12: 0 live (5 ms of CPU a scan), 1 offline (half the size, 10 ms)
  Duration safe_every{0};     // of the host's time: older objects survive kill -9, see secure(); 0: only after close()
};

/**
 * A rawlog in the observation format, header first. Objects are written to `<path>.part` (OutputFile), which close()
 * renames to `path`. An older file is replaced then.
 *
 * Without close(), for example after an exception, `<path>.part` remains; it is readable up to its last object. Throws
 * std::runtime_error with the file's name if it cannot be written.
 */
class RawlogWriter
{
 public:
  RawlogWriter(const std::filesystem::path&, RecordingHeader, const RawlogOptions& = {});
  ~RawlogWriter();

  void write(const mrpt::obs::CObservation&);

  /** Passes objects older than `safe_every` to the operating system. Call it also while there is nothing to write. */
  void secure();

  /** Where an earlier recording that did not end was moved to; empty: there was none. */
  const std::filesystem::path& earlierPart() const { return file_.earlier(); }

  /** Also writes the header if nothing else was written. @return the file's name: a partial one replaces no other. */
  std::filesystem::path close(Completeness = Completeness::Whole);

 private:
  void writeHeaderOnce(Timestamp);

  OutputFile file_;
  RawlogOptions options_;
  std::optional<RecordingHeader> header_;  // until it is written: its stamp is that of the first object
  std::unique_ptr<GzipArchive> archive_;   // until close()
  std::chrono::steady_clock::time_point secured_ = std::chrono::steady_clock::now();
  bool unsecured_ = false;  // something was written since
};
}  // namespace scanloom
