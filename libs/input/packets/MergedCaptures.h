#pragma once
#include "input/packets/DatagramReader.h"

#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/** Several recordings as one stream, ordered by record time; at equal times by the order of the files. */
class MergedCaptures
{
 public:
  /** Throws std::invalid_argument if there is none. */
  explicit MergedCaptures(std::vector<std::unique_ptr<DatagramReader>>);

  /** Replaces `datagram` by the next one; false at the end of all files. A damaged file ends, the others go on. */
  bool next(Datagram& datagram);

  CaptureCounters counters() const;

  /** Mean over the files of the share that was read, 0 to 1. */
  double progress() const;

 private:
  struct Input
  {
    std::unique_ptr<DatagramReader> reader;
    Datagram front;
    bool has_front = false;
  };
  static void readOn(Input&);

  std::vector<Input> inputs_;
  std::optional<std::size_t> taken_;  // input to read from at the next call
};
}  // namespace scanloom
