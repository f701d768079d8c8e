/** Whether a rawlog is fit to be used: what its objects say of their order, completeness and times. */
#pragma once
#include "core/Time.h"
#include "dataset/Finding.h"
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scanloom
{
struct LidarShare
{
  std::uint64_t points = 0, columns = 0;
  std::uint64_t silent_scans = 0;     // without a point of it
  std::uint64_t missing_columns = 0;  // against its usual number a scan (the median), but for the ends of the recording
};

/** The observations of one label. */
struct LabelAccount
{
  std::uint64_t count = 0;
  Timestamp first, last;         // smallest and largest stamp
  Duration usual_interval{0};    // median
  Duration longest_interval{0};  // in the order of the file
  std::uint64_t gaps = 0;        // intervals of more than 1.5 times the usual one
  std::uint64_t lost = 0;        // observations that would fill them
  std::uint64_t backwards = 0;   // stamps that do not rise

  // Clouds only.
  std::uint64_t clouds = 0, points = 0, empty = 0;
  std::uint64_t outside = 0;       // points whose time is not within their scan's period
  std::uint64_t disordered = 0;    // points that are earlier than the one before
  std::vector<LidarShare> lidars;  // by sensor_id; empty where points bear none
};

struct RawlogAccount
{
  std::optional<RecordingHeader> header;
  std::map<std::string, LabelAccount> labels;
  Timestamp first, last;          // of all
  std::uint64_t late_imu = 0;     // samples that come after a scan though they are 20 ms or more before its end
  std::uint64_t passed_over = 0;  // objects that are no observations
  std::string damage;
};

/** Memory grows by some bytes per observation, not with their points. Throws what readRawlog throws. */
RawlogAccount accountOf(const std::filesystem::path&, const KeepReading&);

/** The verdicts: NotFit for damage, stamps that go back, points outside of their scan, a lidar that is never heard. */
Findings findingsOf(const RawlogAccount&);

/** Times in s. */
std::string toJson(const RawlogAccount&);
}  // namespace scanloom
