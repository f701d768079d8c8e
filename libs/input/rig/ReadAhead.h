#pragma once
#include "base/core/BoundedQueue.h"
#include "input/rig/SensorInput.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace scanloom
{
/**
 * The same events in the same order, read by a thread of its own while the caller works on those before. For inputs
 * that do not wait (files). The thread starts with the first next(), so that setup() before it does not depend on how
 * fast the thread reads. It is `scans` scans ahead at most. What the input throws, next() throws after the events
 * before.
 */
class ReadAhead : public SensorInput
{
 public:
  explicit ReadAhead(std::unique_ptr<SensorInput>, std::size_t scans = 2);
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;
  ~ReadAhead() override;

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override { return queue_.ended(); }
  void stop() override { input_->stop(); }
  SensorSetup setup() const override;

  /** As of the event that next() gave last. */
  double progress() const override { return progress_; }
  RigAccount account() const override;
  std::map<std::string, StageTime> stages() const override;
  std::vector<std::string> takeWarnings() override;

 private:
  struct Event
  {
    SensorEvent event;
    double progress;
  };

  void read();
  std::optional<Event> readOne();

  std::unique_ptr<SensorInput> input_;
  StageTimes times_;
  mutable std::mutex reading_;  // of the two above
  BoundedQueue<Event> queue_;
  double progress_ = 0;
  std::thread thread_;  // last: it uses all of the above
};
}  // namespace scanloom
