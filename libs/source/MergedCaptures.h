#pragma once
#include "source/CaptureReader.h"

namespace scanloom
{
/** Several captures as one stream in the order of record time; datagrams of equal time come in the order of the files.
 */
class MergedCaptures
{
 public:
  /** One file or more. Throws as CaptureReader does, and std::invalid_argument for none. */
  explicit MergedCaptures(const std::vector<std::filesystem::path>&);

  /** Replaces `datagram` by the next one, false at the end of all files; throws as CaptureReader::next. */
  bool next(Datagram& datagram);

  CaptureCounters counters() const;

  /** Share of all files' bytes that were read, 0 to 1; as exact as the files are of one size. */
  double progress() const;

 private:
  struct Input
  {
    CaptureReader reader;
    Datagram front;
    bool has_front = false;
  };
  static void readOn(Input&);

  std::vector<Input> inputs_;
  std::optional<std::size_t>
      taken_;  // its front went out: it is read on when the next is asked for, so that damage costs no datagram
};
}  // namespace scanloom
