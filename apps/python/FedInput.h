/** A sensor input that is given its events one by one by the program that it is part of. */
#pragma once
#include "input/rig/SensorInput.h"

#include <condition_variable>
#include <deque>
#include <mutex>

namespace scanloom
{
/**
 * Who feeds it waits until the reader has worked on everything: so the results depend on the events alone, not on the
 * pace of threads.
 */
class FedInput : public SensorInput
{
 public:
  explicit FedInput(SensorSetup setup) : setup_(std::move(setup)) {}

  void add(SensorEvent);

  /** The reader asks for more than was added. False if it did not do so within `patience`. */
  bool waitForReader(Duration patience);

  using SensorInput::next;
  std::optional<SensorEvent> next(Duration patience) override;
  bool ended() const override;
  void stop() override;
  SensorSetup setup() const override { return setup_; }

 private:
  SensorSetup setup_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<SensorEvent> events_;
  bool reader_waits_ = false, stopped_ = false;
};
}  // namespace scanloom
