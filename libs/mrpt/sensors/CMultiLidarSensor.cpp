#include "mrpt/sensors/CMultiLidarSensor.h"

#include "base/core/Interruption.h"
#include "input/rig/Rig.h"
#include "mrpt/observations/readByAll.h"
#include "mrpt/sensors/internal/rigSettingsFrom.h"

#include <algorithm>
#include <utility>

IMPLEMENTS_GENERIC_SENSOR(CMultiLidarSensor, scanloom)

namespace scanloom
{
namespace
{
/** After so many periods in which it freed nothing, the grabber will not write any more. */
constexpr int kGrabberPeriods = 12;

constexpr std::size_t kReadAhead = 100;         // observations
constexpr std::size_t kMostScansWaiting = 100;  // scans at the application: while it has so many, reading rests
}  // namespace

CMultiLidarSensor::~CMultiLidarSensor()
{
  if (observations_) observations_->stop();  // the feed's thread may be waiting for them
}

void CMultiLidarSensor::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                                  const std::string& section)
{
  settings_ = rigSettingsFrom(source, section);
  cloudClassFromName(settings_.driver.cloud_class);
  setSensorLabel(settings_.driver.sensorLabel);
  // The base class would decimate headers and IMU samples, too.
  scan_decimation_ = std::exchange(m_grab_decimation, 0);
  const std::chrono::milliseconds grabber_period{source.read_int("global", "GRABBER_PERIOD_MS", 1000)};
  scans_given_.emplace(kGrabberPeriods * grabber_period);
  others_given_.emplace(kGrabberPeriods * grabber_period);
}

void CMultiLidarSensor::initialize()
{
  observations_ = std::make_unique<RigObservations>(makeRig(settings_), settings_.driver);
  feed_ = std::make_unique<ObservationFeed>([this] { return observations_->next(); }, kReadAhead);
  if (isLive()) catchUnhandledInterruption();  // stock applications would end at once and leave a cut file
  m_state = ssWorking;
}

void CMultiLidarSensor::doProcess()
{
  const Time now = std::chrono::steady_clock::now();
  if (isLive())
  {
    if (interrupted()) observations_->stop();
    logWarnings();
  }
  if (!input_ended_) handOver(now);
  if (!input_ended_) return;

  if (scans_given_->isWorthWaitingFor(now) || others_given_->isWorthWaitingFor(now)) return;
  if (error_) std::rethrow_exception(error_);
  throw std::runtime_error("end of input: drained (not an error)");
}

void CMultiLidarSensor::handOver(Time now)
{
  try
  {
    while (scans_given_->held(now) < kMostScansWaiting || !scans_given_->isWorthWaitingFor(now))
    {
      const auto observation = feed_->take();
      if (!observation) break;
      give(observation, now);
    }
    input_ended_ = feed_->ended();
  }
  catch (...)
  {
    // The application first writes what was read before the error; then doProcess() throws it.
    error_ = std::current_exception();
    input_ended_ = true;
    m_state = ssError;
  }
  if (!input_ended_) return;
  logWarnings();
  logAccount();
  announceEnd();
}

void CMultiLidarSensor::give(const mrpt::obs::CObservation::Ptr& observation, Time now)
{
  latest_stamp_ = std::max(latest_stamp_, observation->timestamp);
  const bool is_scan = IS_CLASS(*observation, mrpt::obs::CObservationPointCloud) && !isSlice(*observation);
  if (is_scan && isDecimated()) return;
  (is_scan ? scans_given_ : others_given_)->add(observation, now);
  appendObservation(observation);
}

bool CMultiLidarSensor::isDecimated()
{
  if (++scans_left_out_ < scan_decimation_) return true;
  scans_left_out_ = 0;
  return false;
}

/** As a comment, because rawlog-grabber never writes the last object that it was given. */
void CMultiLidarSensor::announceEnd()
{
  auto comment = std::make_shared<CommentReadByAll>();
  comment->timestamp = latest_stamp_ + mrpt::Clock::duration(1);
  comment->text = "end of input";
  appendObservation(comment);
}

void CMultiLidarSensor::logWarnings()
{
  for (const std::string& warning : observations_->takeWarnings()) MRPT_LOG_WARN(warning);
}

void CMultiLidarSensor::logAccount() const
{
  const RigAccount account = observations_->account();
  for (const auto& [what, count] : account.input)
    if (count > 0 && what.find("dropped") != std::string::npos) MRPT_LOG_WARN_STREAM(what << ": " << count);
  for (const auto& [name, c, of_other_senders, clock_offset] : account.lidars)
  {
    MRPT_LOG_INFO_STREAM(name << ": " << c.packets << " packets, " << c.emitted << " columns, " << c.points
                              << " points");
    if (c.lost + c.late + c.dropped + c.implausible + c.malformed_packets + c.bad_crc_packets > 0)
      MRPT_LOG_WARN_STREAM(name << ": " << c.lost << " columns lost on the wire, " << c.late << " late, " << c.dropped
                                << " dropped, " << c.implausible << " with implausible stamps; " << c.malformed_packets
                                << " packets malformed, " << c.bad_crc_packets << " with a wrong check sum");
    if (of_other_senders > 0) MRPT_LOG_WARN_STREAM(name << ": " << of_other_senders << " packets of other senders");
  }
}
}  // namespace scanloom
