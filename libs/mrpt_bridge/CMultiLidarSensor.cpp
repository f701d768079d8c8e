#include "mrpt_bridge/CMultiLidarSensor.h"

#include "mrpt_bridge/rigSettingsFrom.h"

#include <algorithm>
#include <csignal>
#include <utility>

IMPLEMENTS_GENERIC_SENSOR(CMultiLidarSensor, scanloom)

namespace scanloom
{
namespace
{
/** After so many periods of the grabber in which nothing was freed, nothing more can be expected of it. */
constexpr int kGrabberPeriods = 12;

/** Half of max_queue_len may be read ahead, and as many scans may wait at the application. */
std::size_t readAhead(std::size_t max_queue_len) { return std::max<std::size_t>(1, max_queue_len / 2); }

/** At least two: rawlog-grabber writes half of what waits, rounded down. */
std::size_t mostWaiting(std::size_t max_queue_len) { return std::max<std::size_t>(2, max_queue_len / 2); }

volatile std::sig_atomic_t g_interrupted = 0;  // all that a signal handler may touch

/** Stock applications die of these signals and leave a cut file. Whoever minds them already is left alone. */
void catchInterruption()
{
  g_interrupted = 0;
  for (const int signal : {SIGINT, SIGTERM})
  {
    struct sigaction current = {};
    sigaction(signal, nullptr, &current);
    if (current.sa_handler != SIG_DFL) continue;
    struct sigaction action = {};
    action.sa_handler = [](int) { g_interrupted = 1; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
}
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
  feed_ = std::make_unique<ObservationFeed>([this] { return observations_->next(); }, readAhead(m_max_queue_len));
  if (isLive()) catchInterruption();
  m_state = ssWorking;
}

void CMultiLidarSensor::doProcess()
{
  const Time now = std::chrono::steady_clock::now();
  if (isLive())
  {
    if (g_interrupted) observations_->stop();
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
    while (scans_given_->held(now) < mostWaiting(m_max_queue_len) || !scans_given_->isWorthWaitingFor(now))
    {
      const auto observation = feed_->take();
      if (!observation) break;
      give(observation, now);
    }
    input_ended_ = feed_->ended();
  }
  catch (...)
  {
    // What was read before the error is to be written like all else before the application hears of it.
    error_ = std::current_exception();
    input_ended_ = true;
    m_state = ssError;
  }
  if (!input_ended_) return;
  logWarnings();
  logAccount();
  giveSacrifice();
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
  if (++scans_passed_over_ < scan_decimation_) return true;
  scans_passed_over_ = 0;
  return false;
}

/** rawlog-grabber never writes its last object: let it be one that nobody misses. */
void CMultiLidarSensor::giveSacrifice()
{
  auto comment = mrpt::obs::CObservationComment::Create();
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
  for (const auto& [name, c] : account.lidars)
  {
    MRPT_LOG_INFO_STREAM(name << ": " << c.packets << " packets, " << c.emitted << " columns, " << c.points
                              << " points");
    if (c.lost + c.late + c.dropped + c.implausible + c.malformed_packets + c.bad_crc_packets > 0)
      MRPT_LOG_WARN_STREAM(name << ": " << c.lost << " columns lost on the wire, " << c.late << " late, " << c.dropped
                                << " dropped, " << c.implausible << " with implausible stamps; " << c.malformed_packets
                                << " packets malformed, " << c.bad_crc_packets << " with a wrong check sum");
  }
}
}  // namespace scanloom
