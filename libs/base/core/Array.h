#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace scanloom
{
/**
 * A vector of numbers, or of structs of numbers, that is written in place: room() returns uninitialised memory past the
 * end, grow() makes it part of the array. std::vector writes zeros first, and with an allocator that does not, decoding
 * still takes 10 to 20 % longer, since resize() is not inlined. Memory is aligned to a cache line.
 */
template <typename T>
class Array
{
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;
  using reference = T&;
  using const_reference = const T&;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;

  Array() = default;
  Array(std::initializer_list<T> values) { assign(values.begin(), values.end()); }
  Array(const Array& other) { assign(other.begin(), other.end()); }
  Array(Array&& other) noexcept
    : begin_(std::exchange(other.begin_, nullptr)),
      end_(std::exchange(other.end_, nullptr)),
      limit_(std::exchange(other.limit_, nullptr))
  {
  }
  Array& operator=(const Array& other)
  {
    if (this != &other) assign(other.begin(), other.end());
    return *this;
  }
  Array& operator=(Array&& other) noexcept
  {
    Array(std::move(other)).swap(*this);
    return *this;
  }
  ~Array() { ::operator delete(begin_, kAlignment); }

  T* begin() { return begin_; }
  T* end() { return end_; }
  const T* begin() const { return begin_; }
  const T* end() const { return end_; }
  T* data() { return begin_; }
  const T* data() const { return begin_; }
  std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
  std::size_t capacity() const { return static_cast<std::size_t>(limit_ - begin_); }
  bool empty() const { return begin_ == end_; }

  T& operator[](std::size_t i) { return begin_[i]; }
  const T& operator[](std::size_t i) const { return begin_[i]; }
  T& front() { return *begin_; }
  const T& front() const { return *begin_; }
  T& back() { return end_[-1]; }
  const T& back() const { return end_[-1]; }

  /** Uninitialised memory for `count` elements behind the last one. grow() adds those that were written. */
  T* room(std::size_t count)
  {
    if (count > static_cast<std::size_t>(limit_ - end_)) reserve(std::max(size() + count, 2 * capacity()));
    return end_;
  }
  /** Adds `count` elements that were written; at most as many as room() was called for. */
  void grow(std::size_t count) { end_ += count; }

  void push_back(T value)  // NOLINT(readability-identifier-naming): as std::vector
  {
    *room(1) = value;
    grow(1);
  }

  void reserve(std::size_t capacity)
  {
    if (capacity <= this->capacity()) return;
    Array larger;
    larger.begin_ = static_cast<T*>(::operator new(capacity * sizeof(T), kAlignment));
    larger.limit_ = larger.begin_ + capacity;
    larger.end_ = larger.begin_ + size();
    if (!empty()) std::memcpy(larger.begin_, begin_, size() * sizeof(T));
    swap(larger);
  }

  /** New elements are 0. */
  void resize(std::size_t size)
  {
    const std::size_t before = this->size();
    if (size > before) std::fill_n(room(size - before), size - before, T{});
    end_ = begin_ + size;
  }

  void clear() { end_ = begin_; }

  template <typename Iterator>
  void assign(Iterator first, Iterator last)
  {
    clear();
    const auto count = static_cast<std::size_t>(std::distance(first, last));
    std::copy(first, last, room(count));
    grow(count);
  }

  void swap(Array& other) noexcept
  {
    std::swap(begin_, other.begin_);
    std::swap(end_, other.end_);
    std::swap(limit_, other.limit_);
  }

  friend bool operator==(const Array& a, const Array& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }
  friend bool operator!=(const Array& a, const Array& b) { return !(a == b); }
  friend bool operator==(const Array& a, const std::vector<T>& b)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  static constexpr std::align_val_t kAlignment{64};

  T* begin_ = nullptr;
  T* end_ = nullptr;
  T* limit_ = nullptr;
};
}  // namespace scanloom
