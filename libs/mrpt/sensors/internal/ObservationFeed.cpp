#include "mrpt/sensors/internal/ObservationFeed.h"

#include <utility>

namespace scanloom
{
ObservationFeed::ObservationFeed(Source source, std::size_t capacity)
  : source_(std::move(source)), queue_(capacity), thread_([this] { read(); })
{
}

ObservationFeed::~ObservationFeed()
{
  queue_.close();
  thread_.join();
}

void ObservationFeed::read()
{
  try
  {
    Observation observation = source_();
    while (observation && queue_.push(std::move(observation))) observation = source_();
    queue_.end();
  }
  catch (...)
  {
    queue_.end(std::current_exception());
  }
}
}  // namespace scanloom
