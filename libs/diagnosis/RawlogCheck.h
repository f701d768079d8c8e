/** Checks a rawlog: order, completeness and times of its observations, and the rig behind it. */
#pragma once
#include "base/core/Finding.h"
#include "base/core/Time.h"
#include "diagnosis/internal/RigExamination.h"
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scanloom
{
struct LidarShare
{
  std::uint64_t points = 0, columns = 0;
  std::uint64_t silent_scans = 0;     // without a point of this lidar
  std::uint64_t missing_columns = 0;  // below the median per scan; the first and the last scan are not counted
};

struct CloudAccount
{
  std::uint64_t clouds = 0, points = 0, empty = 0;
  std::uint64_t impossible = 0;    // points left out: not finite, or 100 km away; not in `points`
  std::uint64_t outside = 0;       // points whose time is not within their scan's period
  std::uint64_t disordered = 0;    // points that are earlier than the one before
  std::vector<LidarShare> lidars;  // by sensor_id; empty if the points have none
};

/** The observations of one label. */
struct LabelAccount
{
  std::uint64_t count = 0;
  Timestamp first, last;         // smallest and largest stamp
  Duration usual_interval{0};    // median
  Duration longest_interval{0};  // in the order of the file
  std::uint64_t gaps = 0;        // intervals of more than 1.5 times the usual one
  std::uint64_t lost = 0;        // observations missing in the gaps
  std::uint64_t backwards = 0;   // stamps that do not rise
  CloudAccount of_clouds;
};

struct RawlogAccount
{
  std::optional<RecordingHeader> header;
  std::map<std::string, LabelAccount> labels;
  Timestamp first, last;          // of all
  std::uint64_t late_imu = 0;     // samples that come after a scan but are 20 ms or more older than its end
  std::uint64_t passed_over = 0;  // objects that are no observations
  std::string damage;
};

/** Memory grows by some bytes for each observation. Throws what readRawlog throws. */
RawlogAccount accountOf(const std::filesystem::path&, const KeepReading&);

/** NotFit for damage, stamps that go back, points outside of their scan, and a lidar without points. */
Findings findingsOf(const RawlogAccount&);

/** Times in s. */
std::string toJson(const RawlogAccount&);

struct CheckedRawlog
{
  RawlogAccount account;
  RigExamination rig;  // empty if the rawlog has no header, and if the check was stopped
  Findings findings;   // on both
};

/** Reads the rawlog twice, the second time without asking. Throws what readRawlog throws. */
CheckedRawlog checkRawlog(const std::filesystem::path&, const CropOptions&, const KeepReading&);

/** As toJson() of a RigExamination, with the account as "rawlog". */
std::string toJson(const CheckedRawlog&);
}  // namespace scanloom
