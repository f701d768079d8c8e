#pragma once
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace scanloom
{
/**
 * At most twelve items at equal intervals from a sequence of unknown length: when there are more, every other one is
 * dropped and the interval doubled. The n-th item of the sequence has the number n; numbers do not go back.
 */
template <typename Item>
class EvenSelection
{
 public:
  /** The item with this number, default-made at the first call for it; null if the number is not selected. */
  Item* at(std::int64_t number)
  {
    // Several times if numbers jumped and all items lie on the doubled interval, too.
    while (number % interval_ == 0 && items_.size() == kMost && items_.count(number) == 0) halve();
    return number % interval_ == 0 ? &items_[number] : nullptr;
  }

  /** In the order of their numbers. */
  std::vector<Item> taken() &&
  {
    std::vector<Item> items;
    for (auto& [number, item] : items_) items.push_back(std::move(item));
    return items;
  }

 private:
  static constexpr std::size_t kMost = 12;

  void halve()
  {
    interval_ *= 2;
    for (auto item = items_.begin(); item != items_.end();)
      item = item->first % interval_ == 0 ? std::next(item) : items_.erase(item);
  }

  std::int64_t interval_ = 1;
  std::map<std::int64_t, Item> items_;
};
}  // namespace scanloom
