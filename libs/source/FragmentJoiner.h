#pragma once
#include "core/Time.h"
#include "source/IpLayer.h"

#include <deque>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace scanloom
{
struct FragmentJoinerOptions
{
  /** Ids count 65536 datagrams per source: half a second is far from a turn of that counter, and far above any
   * reordering. */
  Duration expiry = 500ms;
  std::size_t datagrams = 256;  // under construction at once; the oldest gives way
};

/**
 * Puts IP datagrams together from their fragments, in any order, several datagrams at a time.
 * A datagram with a missing fragment expires on record time, so that it is never completed with bytes of a later one
 * that bears the same id; a fragment that overlaps others with different bytes begins a new datagram (RFC 5722 refuses,
 * too).
 */
class FragmentJoiner
{
 public:
  explicit FragmentJoiner(FragmentJoinerOptions options = {}) : options_(options) {}

  /**
   * True if this fragment was the missing one: `datagram` is then replaced by the whole content.
   * Throws std::out_of_range for a fragment that no datagram can have (odd length, past 65535 bytes).
   */
  bool add(Timestamp received, const IpContent& fragment, std::vector<std::uint8_t>& datagram);

  /** End of input: what is still under construction is lost. */
  void finish();

  std::uint64_t joined() const { return joined_count_; }

  /** Datagrams of which a fragment never came; under overload or where an id is reused within the expiry, a close
   * estimate. */
  std::uint64_t lost() const { return lost_count_; }

 private:
  using Key = std::tuple<IpAddress, IpAddress, std::uint32_t, std::uint8_t>;

  struct Piece
  {
    std::size_t begin = 0, end = 0;
    bool last = false;
  };
  struct Construction
  {
    Timestamp begun;
    std::vector<Piece> pieces;
    std::vector<std::uint8_t> bytes;
    std::size_t received = 0;
    std::optional<std::size_t> size;  // known since the last fragment came
  };
  enum class Fit
  {
    New,
    Repeated,
    Contradiction
  };

  static Fit fit(const Construction&, const Piece&, Bytes payload);
  static void insert(Construction&, const Piece&, Bytes payload);
  bool isOld(Timestamp then, Timestamp now) const;
  void forgetOldOnes(Timestamp now);
  void makeRoom();
  std::map<Key, Construction>::iterator lose(std::map<Key, Construction>::iterator);

  FragmentJoinerOptions options_;
  std::map<Key, Construction> under_construction_;
  std::map<Key, Timestamp> completed_;  // recently: a repeated fragment of theirs is no lost datagram
  std::deque<std::pair<Timestamp, Key>> completed_in_order_;
  std::uint64_t joined_count_ = 0;
  std::uint64_t lost_count_ = 0;
};
}  // namespace scanloom
