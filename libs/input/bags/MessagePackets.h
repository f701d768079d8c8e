/** From messages of topics to the packets in them: the same for bags and for topics that are heard live. */
#pragma once
#include "input/bags/BagReader.h"
#include "input/packets/DatagramReader.h"

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace scanloom
{
/** Whether messages of this type hold packets of lidars, or clouds, which become packets (CloudPacket.h). */
bool holdsPackets(const std::string& type);
bool holdsClouds(const std::string& type);

/**
 * Messages in, in the order of their reception; datagrams out. A datagram has its topic, no address and no port, and
 * was received at the stamp that the driver gave the packet; where it gave none, at the receive time of its message.
 * Drivers put the packets of a turn into one message: they come in the order of stamps as far as those of one turn
 * differ, and so a quarter of a second late.
 */
class MessagePackets
{
 public:
  /** Messages of other topics are only counted. */
  explicit MessagePackets(std::set<std::string> topics) : topics_(std::move(topics)) {}

  void take(const BagTopic&, const BagMessage&);

  /** No more messages will come, or none for long: what waits for earlier packets is given out. */
  void flush() { flushed_ = true; }

  /** Replaces `datagram` by the next one, reusing its memory; false if none is due yet. */
  bool next(Datagram& datagram);

  const CaptureCounters& counters() const { return counters_; }

 private:
  /**
   * When a topic's clouds were received, had none been late: a recorder may hang and then write many at once, and from
   * a file nothing is late. That is the latest point's stamp and the least delay so far.
   */
  class Punctual
  {
   public:
    Timestamp received(Timestamp message_received, Timestamp latest_point);

   private:
    std::optional<Duration> least_;
  };

  /** A message that was received before it is due. */
  struct Ahead
  {
    BagTopic topic;
    Timestamp received;
    std::vector<std::uint8_t> data;
  };

  struct Held
  {
    Datagram datagram;
    std::uint64_t number = 0;  // keeps the order at equal times
  };

  static bool isLater(const Held&, const Held&);
  bool isDue() const;
  void lookAt(const BagTopic&, const BagMessage&);
  bool seesAhead() const;
  void takeAhead();
  void open(const BagTopic&, const BagMessage&);
  void hold(Bytes packet, const std::string& topic, Timestamp received);

  std::set<std::string> topics_;
  std::deque<Ahead> ahead_;  // the first messages of clouds
  std::size_t ahead_bytes_ = 0;
  bool looks_ahead_ = true;
  std::map<std::string, Punctual> punctual_;  // by topic
  std::vector<Held> held_;                    // a heap, the earliest first
  std::size_t held_bytes_ = 0;
  std::uint64_t number_ = 0;
  Timestamp newest_ = Timestamp{};
  bool flushed_ = false;
  CaptureCounters counters_;
};
}  // namespace scanloom
