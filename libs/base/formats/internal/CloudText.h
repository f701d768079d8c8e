/** Reads the text of PLY and PCD files. */
#pragma once
#include "base/core/Bytes.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace scanloom
{
/** A file in memory, read from its start: first the header's lines, then numbers in text, or rest() in binary. */
class CloudText
{
 public:
  explicit CloudText(Bytes file) : rest_(reinterpret_cast<const char*>(file.data()), file.size()) {}

  /** Without its line break; nothing at the end of the file. */
  std::optional<std::string> line()
  {
    if (rest_.empty()) return std::nullopt;
    const auto end = rest_.find('\n');
    std::string line(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  /** The next word as a number, also nan or inf. Throws std::invalid_argument if it is none or the file ends. */
  double number()
  {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
    if (rest_.empty()) throw std::invalid_argument("it ends before its last point");
    std::string_view word = rest_.substr(0, rest_.find_first_of(kBlanks));
    rest_.remove_prefix(word.size());
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      throw std::invalid_argument("'" + std::string(word.substr(0, 20)) + "' is not a number");
    return value;
  }

  Bytes rest() const { return {reinterpret_cast<const std::uint8_t*>(rest_.data()), rest_.size()}; }

 private:
  static constexpr std::string_view kBlanks = " \t\r\n";

  std::string_view rest_;
};
}  // namespace scanloom
