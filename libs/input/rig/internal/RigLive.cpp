#include "input/rig/internal/RigLive.h"

#include "input/rig/internal/eventLimits.h"
#include "input/rig/receiverOptions.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr auto kAccountPeriod = 100ms;
constexpr std::size_t kWarningsKept = 1000;  // if nobody takes them

std::vector<std::string> warningsOfStart(const Rig& rig, const UdpReceiver& receiver)
{
  std::vector<std::string> warnings = receiver.warnings();
  for (const RigSensor& sensor : rig.sensors)
    if (!sensor.metadata)
      warnings.push_back(
          fmt::format("lidar '{}' joins when its sensor answers: {}", sensor.options.name, sensor.failure));
  return warnings;
}

const Rig& withoutRecordedImu(const Rig& rig)
{
  if (!rig.body_imu.empty())
    throw std::invalid_argument("imu_csv is a recording: it goes with pcap_input, not with live lidars");
  return rig;
}
}  // namespace

RigLive::RigLive(const Rig& rig)
  : stream_(withoutRecordedImu(rig), RigStream::ReceiveTimes::Steady),
    queue_(eventLimits(rig), [](const ReceivedEvent& event) { return event.event.index(); }),
    capture_(rig.live.capture.empty() ? nullptr : std::make_unique<LiveCapture>(rig.live.capture)),
    receiver_(receiverOptions(rig)),
    sensors_(rig),
    rig_(rig),
    account_(stream_.account()),
    warnings_(warningsOfStart(rig, receiver_)),
    thread_([this] { merge(); })
{
  ::pthread_setname_np(thread_.native_handle(), "scanloom-merge");
}

RigLive::~RigLive()
{
  stop();
  thread_.join();
}

std::optional<SensorEvent> RigLive::next(Duration patience)
{
  std::optional<ReceivedEvent> received = queue_.pop(patience);
  if (!received) return std::nullopt;
  if (std::holds_alternative<Scan>(received->event)) release_latency_ = receiver_.now() - received->newest;
  return std::move(received->event);
}

void RigLive::merge()
{
  std::exception_ptr error;
  try
  {
    Clock::time_point published = Clock::now();
    for (bool last = false; !last;)
    {
      receiver_.wait(kAccountPeriod);
      last = receiver_.ended();
      takeUntil(last ? Timestamp::max() : receiver_.drainedUntil());
      if (Clock::now() - published < kAccountPeriod) continue;
      publish();
      published = Clock::now();
    }
    stream_.finish();
    giveOut();
  }
  catch (...)
  {
    error = std::current_exception();
    receiver_.stop();
  }
  if (capture_) capture_->close();
  publish();
  queue_.end(error);
}

void RigLive::takeUntil(Timestamp drained)
{
  while (const std::optional<std::size_t> port = receiver_.oldestBefore(drained)) takeFrom(*port);
  if (drained == Timestamp::max()) return;
  stream_.advance(drained);
  giveOut();
}

void RigLive::takeFrom(std::size_t port)
{
  DatagramRing& ring = receiver_.ring(port);
  const DatagramRing::Slot& slot = *ring.front();
  DatagramView datagram;
  // The kernel may be interrupted between stamping a datagram and queueing it. Such a datagram gets the batcher's time
  // as its receive time, here and in the capture: time never goes back.
  restamped_ += slot.received < stream_.time();
  datagram.received = std::max(slot.received, stream_.time());
  datagram.source = slot.source;
  datagram.source_port = slot.source_port;
  datagram.destination_port = receiver_.port(port);
  datagram.payload = {slot.bytes, slot.size};
  newest_ = datagram.received;
  if (capture_) capture_->add(datagram);
  stream_.take(datagram);
  ring.pop();
  giveOut();
}

void RigLive::giveOut()
{
  while (std::optional<SensorEvent> event = stream_.next()) queue_.pushDroppingOldest({*std::move(event), newest_});
}

void RigLive::publish()
{
  RigAccount account = stream_.account();
  account.input["datagrams_restamped"] = restamped_;
  std::vector<std::string> warnings = stream_.takeWarnings();
  if (const std::string failure = capture_ ? capture_->takeFailure() : ""; !failure.empty())
    warnings.push_back(failure + ": datagrams are captured no more; scans go on");
  followSensors(warnings);

  const std::lock_guard lock(mutex_);
  account_ = std::move(account);
  for (std::string& warning : warnings)
    if (warnings_.size() < kWarningsKept) warnings_.push_back(std::move(warning));
}

void RigLive::followSensors(std::vector<std::string>& warnings)
{
  for (const LidarIndex lidar : stream_.takeSuspects()) sensors_.recheck(lidar);
  for (LiveSensors::Change& change : sensors_.takeChanges(warnings))
  {
    {
      const std::lock_guard lock(mutex_);  // before the batcher: an event's decoder is known when the event comes
      rig_.lidars[change.lidar].decoder = change.decoder;
    }
    if (!receivesAt(change.address.lidar_port))
      warnings.push_back(
          fmt::format("{} sends its packets to UDP port {}, where nobody listens: give the key 'port' "
                      "and restart",
                      change.metadata.name, change.address.lidar_port));
    stream_.replace(change.lidar, std::move(change.decoder), change.address);
  }
}

bool RigLive::receivesAt(std::uint16_t port) const
{
  for (std::size_t i = 0; i < receiver_.ports(); ++i)
    if (receiver_.port(i) == port) return true;
  return false;
}

SensorSetup RigLive::setup() const
{
  const std::lock_guard lock(mutex_);
  return setupOf(rig_);
}

RigAccount RigLive::account() const
{
  RigAccount account;
  {
    const std::lock_guard lock(mutex_);
    account = account_;
  }
  UdpCounters sum;
  for (std::size_t i = 0; i < receiver_.ports(); ++i) sum += receiver_.counters(i);
  account.input["datagrams"] = sum.datagrams;
  account.input["datagrams_filtered"] = sum.filtered;
  account.input["datagrams_truncated"] = sum.truncated;
  account.input["datagrams_dropped"] = sum.dropped;
  account.input["datagrams_dropped_by_kernel"] = sum.kernel_drops;
  account.input["socket_errors"] = sum.errors;
  account.input["host_clock_steps"] = receiver_.clockSteps();
  account.input["datagrams_not_captured"] = capture_ ? capture_->dropped() : 0;
  addQueueCounts(queue_, account);
  return account;
}

std::vector<std::string> RigLive::takeWarnings()
{
  const std::lock_guard lock(mutex_);
  return std::exchange(warnings_, {});
}
}  // namespace scanloom
