#pragma once
#include "base/core/Time.h"
#include "input/packets/internal/IpLayer.h"

#include <deque>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace scanloom
{
struct FragmentJoinerOptions
{
  /** Much longer than fragments are reordered, and much shorter than a source needs for 65536 datagrams, after which
   * ids repeat. */
  Duration expiry = 500ms;
  std::size_t datagrams = 256;  // incomplete at the same time; if there are more, the oldest is dropped
};

/**
 * Joins the fragments of IP datagrams, in any order, several datagrams at a time. A datagram with a missing fragment
 * expires on record time, so that it is never completed with bytes of a later one of the same id. A fragment that
 * overlaps others with different bytes begins a new datagram (RFC 5722 refuses overlaps).
 */
class FragmentJoiner
{
 public:
  explicit FragmentJoiner(FragmentJoinerOptions options = {}) : options_(options) {}

  /**
   * True if this fragment completes its datagram; then `datagram` is replaced by the content. Throws std::out_of_range
   * for a fragment of an impossible length (not a multiple of 8, past 65535 bytes).
   */
  bool add(Timestamp received, const IpContent& fragment, std::vector<std::uint8_t>& datagram);

  /** End of input: incomplete datagrams count as lost. */
  void finish();

  std::uint64_t joined() const { return joined_count_; }

  /** Datagrams with a missing fragment. Approximate if too many are incomplete or an id is reused within the expiry. */
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
    std::optional<std::size_t> size;  // known once the last fragment has arrived
  };
  enum class Fit
  {
    New,
    Repeated,
    Contradictory
  };

  static Fit fit(const Construction&, const Piece&, Bytes payload);
  static void insert(Construction&, const Piece&, Bytes payload);
  bool isOld(Timestamp then, Timestamp now) const;
  void forgetOldOnes(Timestamp now);
  void makeRoom();
  std::map<Key, Construction>::iterator lose(std::map<Key, Construction>::iterator);

  FragmentJoinerOptions options_;
  std::map<Key, Construction> under_construction_;
  std::map<Key, Timestamp> completed_;  // recently completed ones: a repeated fragment of them is not a lost datagram
  std::deque<std::pair<Timestamp, Key>> completed_in_order_;
  std::uint64_t joined_count_ = 0;
  std::uint64_t lost_count_ = 0;
};
}  // namespace scanloom
