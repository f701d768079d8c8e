#include "SlamThread.h"

#include <utility>

namespace scanloom
{
SlamThread::SlamThread(SensorInput& input, const SlamSettings& settings, KeptClouds kept, std::size_t ahead,
                       const GivenMap& map)
  : input_(input), kept_(kept), poses_(ahead), thread_([this, settings, map] { run(settings, map); })
{
}

SlamThread::~SlamThread() { stop(); }

void SlamThread::stop()
{
  stop_ = true;
  poses_.close();
  if (thread_.joinable()) thread_.join();
}

void SlamThread::run(const SlamSettings& settings, const GivenMap& map)
try
{
  result_ = runSlam(
      input_, settings, [this](const StateEstimate& estimate) { poses_.push(poseOf(estimate, kept_)); },
      [this](const RunProgress&)
      {
        for (const std::string& warning : input_warnings_.due(input_)) warn(warning);
        return !stop_;
      },
      [this](const std::string& warning) { warn(warning); }, [](const EventMark&) {}, map);
  for (const std::string& warning : input_.takeWarnings()) warn(warning);
  poses_.end();
}
catch (...)
{
  poses_.end(std::current_exception());
}

void SlamThread::warn(const std::string& warning)
{
  const std::lock_guard lock(warning_);
  if (std::optional<std::string> text = repeated_.toSay(warning)) warnings_.push_back(std::move(*text));
}

std::vector<std::string> SlamThread::takeWarnings()
{
  const std::lock_guard lock(warning_);
  return std::exchange(warnings_, {});
}
}  // namespace scanloom
