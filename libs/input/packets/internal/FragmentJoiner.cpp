#include "input/packets/internal/FragmentJoiner.h"

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr std::size_t kLargestDatagram = 65535;
}

bool FragmentJoiner::add(Timestamp received, const IpContent& fragment, std::vector<std::uint8_t>& datagram)
{
  const Piece piece{fragment.offset, fragment.offset + fragment.payload.size(), !fragment.more_fragments};
  if (piece.begin == piece.end || piece.end > kLargestDatagram || (!piece.last && piece.end % 8 != 0))
    throw std::out_of_range("IP fragment: impossible length");
  forgetOldOnes(received);

  const Key key{fragment.source, fragment.destination, fragment.id, fragment.protocol};
  auto found = under_construction_.find(key);
  const Fit how = found == under_construction_.end() ? Fit::New : fit(found->second, piece, fragment.payload);
  if (how == Fit::Repeated) return false;
  if (how == Fit::Contradictory) found = (lose(found), under_construction_.end());
  if (found == under_construction_.end())
  {
    makeRoom();
    found = under_construction_.try_emplace(key).first;
    found->second.begun = received;
  }

  Construction& construction = found->second;
  insert(construction, piece, fragment.payload);
  if (construction.size != construction.received) return false;
  datagram.swap(construction.bytes);
  under_construction_.erase(found);
  completed_[key] = received;
  completed_in_order_.emplace_back(received, key);
  ++joined_count_;
  return true;
}

void FragmentJoiner::finish()
{
  for (auto it = under_construction_.begin(); it != under_construction_.end();) it = lose(it);
}

FragmentJoiner::Fit FragmentJoiner::fit(const Construction& construction, const Piece& piece, Bytes payload)
{
  if (construction.size && (piece.end > *construction.size || (piece.last && piece.end != *construction.size)))
    return Fit::Contradictory;
  for (const Piece& other : construction.pieces)
  {
    if (piece.last && other.end > piece.end) return Fit::Contradictory;
    if (piece.end <= other.begin || other.end <= piece.begin) continue;
    const bool same = piece.begin == other.begin && piece.end == other.end && piece.last == other.last &&
                      std::equal(payload.begin(), payload.end(), construction.bytes.begin() + piece.begin);
    return same ? Fit::Repeated : Fit::Contradictory;
  }
  return Fit::New;
}

void FragmentJoiner::insert(Construction& construction, const Piece& piece, Bytes payload)
{
  if (construction.bytes.size() < piece.end) construction.bytes.resize(piece.end);
  std::copy(payload.begin(), payload.end(), construction.bytes.begin() + piece.begin);
  construction.pieces.push_back(piece);
  construction.received += payload.size();
  if (piece.last) construction.size = piece.end;
}

/** Also true after a step of the recording computer's clock, in either direction. */
bool FragmentJoiner::isOld(Timestamp then, Timestamp now) const
{
  return now - then > options_.expiry || then - now > options_.expiry;
}

void FragmentJoiner::forgetOldOnes(Timestamp now)
{
  for (auto it = under_construction_.begin(); it != under_construction_.end();)
    it = isOld(it->second.begun, now) ? lose(it) : std::next(it);

  while (!completed_in_order_.empty() && isOld(completed_in_order_.front().first, now))
  {
    const auto [time, key] = completed_in_order_.front();
    completed_in_order_.pop_front();
    const auto found = completed_.find(key);
    if (found != completed_.end() && found->second == time) completed_.erase(found);
  }
}

void FragmentJoiner::makeRoom()
{
  if (under_construction_.size() < options_.datagrams) return;
  lose(std::min_element(under_construction_.begin(), under_construction_.end(),
                        [](const auto& a, const auto& b) { return a.second.begun < b.second.begun; }));
}

std::map<FragmentJoiner::Key, FragmentJoiner::Construction>::iterator FragmentJoiner::lose(
    std::map<Key, Construction>::iterator it)
{
  const auto completed = completed_.find(it->first);
  const bool is_echo = completed != completed_.end() && completed->second <= it->second.begun;
  if (!is_echo) ++lost_count_;
  return under_construction_.erase(it);
}
}  // namespace scanloom
