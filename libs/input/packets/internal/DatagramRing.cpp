#include "input/packets/internal/DatagramRing.h"

#include <stdexcept>

namespace scanloom
{
void DatagramRing::Lane::push(std::uint32_t number)
{
  const std::size_t written = written_.load(std::memory_order_relaxed);
  numbers_[written % numbers_.size()] = number;
  written_.store(written + 1, std::memory_order_release);
}

std::uint32_t DatagramRing::Lane::front() const
{
  return numbers_[read_.load(std::memory_order_relaxed) % numbers_.size()];
}

std::size_t DatagramRing::Lane::size() const
{
  // `read_` first: it never overtakes `written_`.
  const std::size_t read = read_.load(std::memory_order_acquire);
  return written_.load(std::memory_order_acquire) - read;
}

DatagramRing::DatagramRing(std::size_t slots, std::size_t slot_bytes)
  : slot_bytes_(slot_bytes),
    bytes_(new std::uint8_t[slots * slot_bytes]),  // NOLINT(modernize-make-unique): it writes zeros
    slots_(slots),
    filled_(slots),
    freed_(slots)
{
  if (slots == 0 || slot_bytes == 0) throw std::invalid_argument("DatagramRing: no slots, or slots of no bytes");
  for (std::size_t i = 0; i < slots; ++i)
  {
    slots_[i].bytes = bytes_.get() + i * slot_bytes;
    empty_.push_back(static_cast<std::uint32_t>(slots - 1 - i));
  }
}

DatagramRing::Slot* DatagramRing::takeEmpty()
{
  for (; !freed_.empty(); freed_.pop()) empty_.push_back(freed_.front());
  if (empty_.empty()) return nullptr;
  Slot* slot = &slots_[empty_.back()];
  empty_.pop_back();
  return slot;
}

void DatagramRing::push(Slot* slot) { filled_.push(static_cast<std::uint32_t>(slot - slots_.data())); }

const DatagramRing::Slot* DatagramRing::front() const { return filled_.empty() ? nullptr : &slots_[filled_.front()]; }

void DatagramRing::pop()
{
  const std::uint32_t read = filled_.front();
  filled_.pop();
  freed_.push(read);
}
}  // namespace scanloom
