#include "mrpt_bridge/ReadAhead.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

namespace scanloom
{
namespace
{
class ReadAhead : public SensorInput
{
 public:
  ReadAhead(std::unique_ptr<SensorInput> input, std::size_t scans) : input_(std::move(input)), most_scans_(scans) {}
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  ~ReadAhead() override
  {
    {
      const std::lock_guard lock(queue_);
      stopping_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
  }

  std::optional<SensorEvent> next(Duration patience) override
  {
    if (!thread_.joinable()) thread_ = std::thread([this] { read(); });
    std::unique_lock lock(queue_);
    changed_.wait_for(lock, patience, [this] { return !ahead_.empty() || read_all_; });
    if (ahead_.empty())
    {
      ended_ = read_all_;
      if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
      return std::nullopt;
    }
    Read read = std::move(ahead_.front());
    ahead_.pop_front();
    scans_ahead_ -= std::holds_alternative<Scan>(read.event);
    progress_ = read.progress;
    changed_.notify_all();
    return std::move(read.event);
  }

  bool ended() const override { return ended_; }
  const RecordingHeader& header() const override { return input_->header(); }
  double progress() const override { return progress_; }

  std::optional<Rigid> body_T_imu(int sensor) const override
  {
    const std::lock_guard lock(reading_);
    return input_->body_T_imu(sensor);
  }

  std::map<std::string, std::uint64_t> counts() const override
  {
    const std::lock_guard lock(reading_);
    return input_->counts();
  }

  std::vector<std::string> takeWarnings() override
  {
    const std::lock_guard lock(reading_);
    return input_->takeWarnings();
  }

  std::map<std::string, StageTime> stages() const override
  {
    const std::lock_guard lock(reading_);
    return times_.stages();
  }

 private:
  struct Read
  {
    SensorEvent event;
    double progress;
  };

  void read()
  {
    try
    {
      while (waitForRoom())
      {
        std::optional<Read> read = readOne();
        const std::lock_guard lock(queue_);
        if (read)
        {
          scans_ahead_ += std::holds_alternative<Scan>(read->event);
          ahead_.push_back(std::move(*read));
        }
        read_all_ = !read;
        changed_.notify_all();
      }
    }
    catch (...)
    {
      const std::lock_guard lock(queue_);
      error_ = std::current_exception();
      read_all_ = true;
      changed_.notify_all();
    }
  }

  /** False when there is nothing more to read, or nobody to read for. */
  bool waitForRoom()
  {
    constexpr std::size_t kMostEvents = 10'000;  // a rawlog may hold nothing but IMU samples for hours
    std::unique_lock lock(queue_);
    const auto room = [this] { return scans_ahead_ < most_scans_ && ahead_.size() < kMostEvents; };
    changed_.wait(lock, [&] { return stopping_ || read_all_ || room(); });
    return !stopping_ && !read_all_;
  }

  std::optional<Read> readOne()
  {
    const std::lock_guard lock(reading_);
    std::optional<SensorEvent> event = times_.measure("reading", [&] { return input_->next(Duration::zero()); });
    if (!event) return std::nullopt;
    return Read{std::move(*event), input_->progress()};
  }

  std::unique_ptr<SensorInput> input_;
  StageTimes times_;
  mutable std::mutex reading_;  // of the two above

  std::mutex queue_;  // of what follows
  std::condition_variable changed_;
  std::deque<Read> ahead_;
  std::size_t scans_ahead_ = 0, most_scans_;
  bool read_all_ = false, stopping_ = false;
  std::exception_ptr error_;

  bool ended_ = false;  // of the caller's side, as is progress
  double progress_ = 0;
  std::thread thread_;
};
}  // namespace

std::unique_ptr<SensorInput> readAhead(std::unique_ptr<SensorInput> input, std::size_t scans)
{
  return std::make_unique<ReadAhead>(std::move(input), scans);
}
}  // namespace scanloom
