#include "input/packets/MergedCaptures.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace scanloom
{
MergedCaptures::MergedCaptures(std::vector<std::unique_ptr<DatagramReader>> readers)
{
  if (readers.empty()) throw std::invalid_argument("no capture file given");
  for (auto& reader : readers) inputs_.push_back({std::move(reader), {}, false});
  for (Input& input : inputs_) readOn(input);
}

void MergedCaptures::readOn(Input& input) { input.has_front = input.reader->next(input.front); }

bool MergedCaptures::next(Datagram& datagram)
{
  if (taken_) readOn(inputs_[*taken_]);
  taken_.reset();

  const auto earlier = [](const Input& a, const Input& b)
  { return a.has_front && (!b.has_front || a.front.received < b.front.received); };
  const auto oldest = std::min_element(inputs_.begin(), inputs_.end(), earlier);
  if (!oldest->has_front) return false;

  taken_ = static_cast<std::size_t>(oldest - inputs_.begin());
  std::swap(datagram, oldest->front);
  return true;
}

CaptureCounters MergedCaptures::counters() const
{
  return std::accumulate(inputs_.begin(), inputs_.end(), CaptureCounters{},
                         [](const CaptureCounters& sum, const Input& input) { return sum + input.reader->counters(); });
}

double MergedCaptures::progress() const
{
  const double sum = std::accumulate(inputs_.begin(), inputs_.end(), 0.0,
                                     [](double s, const Input& input) { return s + input.reader->progress(); });
  return sum / static_cast<double>(inputs_.size());
}
}  // namespace scanloom
