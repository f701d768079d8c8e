#pragma once
#include <signal.h>
#include <sys/resource.h>

namespace scanloom
{
/** No file of this process may be longer, as on a full disk. */
class FullDisk
{
 public:
  explicit FullDisk(rlim_t bytes) : previous_(signal(SIGXFSZ, SIG_IGN))
  {
    getrlimit(RLIMIT_FSIZE, &limits_);
    const rlimit few{bytes, limits_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &few);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk()
  {
    setrlimit(RLIMIT_FSIZE, &limits_);
    signal(SIGXFSZ, previous_);
  }

 private:
  void (*previous_)(int);
  rlimit limits_{};
};
}  // namespace scanloom
