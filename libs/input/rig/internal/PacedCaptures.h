#pragma once
#include "input/packets/MergedCaptures.h"
#include "input/rig/Rig.h"

#include <deque>

namespace scanloom
{
/**
 * How many times as fast as the lidars' stamps the datagrams' times of reception run: 1, or the power of 1000 that a
 * wrong unit makes (ns written where us belong: 1000). By the median over neighbouring packets of a lidar.
 */
double receivePace(const std::vector<RoutedLidar>&, const std::deque<Datagram>&);

/** A rig's captures and bags as one stream of datagrams, whose times of reception are in the unit of its sensors. */
class PacedCaptures
{
 public:
  /** Throws what MergedCaptures throws. */
  explicit PacedCaptures(const Rig&);

  /** Replaces `datagram` by the next one; false at the end of all files. */
  bool next(Datagram& datagram);

  CaptureCounters counters() const { return captures_.counters(); }
  double progress() const { return captures_.progress(); }

  /** What was concluded about the rig's files and their times, and where they are damaged, since the last call. */
  std::vector<std::string> takeWarnings();

 private:
  void noteLongPause(Timestamp received);

  MergedCaptures captures_;
  bool of_several_;
  Timestamp last_;              // time of reception of the last datagram given
  std::deque<Datagram> first_;  // that were read to tell the pace, until they are given
  double pace_ = 1;             // of times of reception
  Timestamp begin_;             // the first of these times
  std::vector<std::string> notes_;
  bool cut_is_reported_ = false;
  std::size_t damages_reported_ = 0;
};
}  // namespace scanloom
