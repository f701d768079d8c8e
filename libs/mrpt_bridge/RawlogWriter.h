#pragma once
#include "batching/Scan.h"
#include "mrpt_bridge/Observations.h"
#include "mrpt_bridge/RecordingHeader.h"

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
  int compression_level = 1;  // gzip: 0 live (6 to 13 ms a scan), 1 offline (a quarter of the size, 68 ms)
  CloudClass cloud_class = CloudClass::CGenericPointsMap;
  Duration safe_every{
      0};  // of the host's time: what is older survives kill -9, see secure(); 0: nothing before close()
};

/**
 * A rawlog in the observation format, header first. Objects go to `<path>.part`, which becomes `path` in close(): under
 * its own name a rawlog is always whole. Whether an older file may be replaced is for the caller to ask.
 *
 * Without close(), as when an exception passes, the `.part` stays: it is readable up to its last object, and an
 * abandoned recording is worth more than a clean folder. Throws std::runtime_error with the file's name if the disk
 * says no.
 */
class RawlogWriter
{
 public:
  RawlogWriter(const std::filesystem::path&, RecordingHeader, const RawlogOptions& = {});
  ~RawlogWriter();

  void write(const Scan&, const std::string& label = kLidarLabel);
  void write(const ImuSample&, const Rigid& body_T_imu, const std::string& label = kImuLabel);
  void write(const mrpt::obs::CObservation&);

  /** For times without anything to write: hands what is older than `safe_every` to the operating system. */
  void secure();

  /** Also writes the header if nothing else was written. */
  void close();

 private:
  void writeHeaderOnce(Timestamp);

  std::filesystem::path path_;
  std::filesystem::path part_;
  RawlogOptions options_;
  std::optional<RecordingHeader> header_;  // until it is written: its stamp is that of the first object
  std::unique_ptr<GzipArchive> archive_;   // until close()
  std::chrono::steady_clock::time_point secured_ = std::chrono::steady_clock::now();
  bool unsecured_ = false;  // something was written since
};
}  // namespace scanloom
