#include "input/rig/ReadAhead.h"

#include <utility>

namespace scanloom
{
namespace
{
constexpr std::size_t kOtherEvents = 10'000;  // a rawlog may hold nothing but IMU samples for hours
}  // namespace

ReadAhead::ReadAhead(std::unique_ptr<SensorInput> input, std::size_t scans)
  : input_(std::move(input)),
    queue_({kOtherEvents, scans}, [](const Event& event) { return std::holds_alternative<Scan>(event.event); })
{
}

ReadAhead::~ReadAhead()
{
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

std::optional<SensorEvent> ReadAhead::next(Duration patience)
{
  if (!thread_.joinable()) thread_ = std::thread([this] { read(); });
  std::optional<Event> event = queue_.pop(patience);
  if (!event) return std::nullopt;
  progress_ = event->progress;
  return std::move(event->event);
}

void ReadAhead::read()
{
  try
  {
    std::optional<Event> event = readOne();
    while (event && queue_.push(std::move(*event))) event = readOne();
    queue_.end();
  }
  catch (...)
  {
    queue_.end(std::current_exception());
  }
}

std::optional<ReadAhead::Event> ReadAhead::readOne()
{
  const std::lock_guard lock(reading_);
  std::optional<SensorEvent> event = times_.measure("reading", [&] { return input_->next(Duration::zero()); });
  if (!event) return std::nullopt;
  return Event{std::move(*event), input_->progress()};
}

SensorSetup ReadAhead::setup() const
{
  const std::lock_guard lock(reading_);
  return input_->setup();
}

RigAccount ReadAhead::account() const
{
  const std::lock_guard lock(reading_);
  return input_->account();
}

std::map<std::string, StageTime> ReadAhead::stages() const
{
  const std::lock_guard lock(reading_);
  return times_.stages();
}

std::vector<std::string> ReadAhead::takeWarnings()
{
  const std::lock_guard lock(reading_);
  return input_->takeWarnings();
}
}  // namespace scanloom
