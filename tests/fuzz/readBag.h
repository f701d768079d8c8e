#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "MemoryFile.h"
#include "base/core/Bytes.h"
#include "input/bags/BagReader.h"
#include "require.h"

namespace scanloom
{
/** Must end with messages of known topics whose bytes can be read, or with a std::runtime_error when it is opened. */
inline void readBagAt(const std::filesystem::path& path)
{
  std::unique_ptr<BagReader> bag;
  try
  {
    bag = BagReader::open(path);
  }
  catch (const std::runtime_error&)
  {
    return;
  }
  unsigned sum = 0;
  for (BagMessage message; bag->next(message);)
  {
    require(message.topic < bag->topics().size());
    require(message.received >= Timestamp{});
    for (const std::uint8_t byte : message.data) sum += byte;
  }
  require(bag->progress() >= 0 && bag->progress() <= 1);
  require(bag->takeWarnings().size() < 10 && sum < ~0U);
}

inline void readBag(const std::vector<std::uint8_t>& content)
{
  static const MemoryFile file;
  readBagAt(file.holding(content));
}

inline void append(std::vector<std::uint8_t>& to, const std::string& text)
{
  to.insert(to.end(), text.begin(), text.end());
}
inline void append(std::vector<std::uint8_t>& to, Bytes bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); }

template <typename Number>
void appendNumber(std::vector<std::uint8_t>& to, Number value)
{
  const std::size_t at = to.size();
  to.resize(at + sizeof value);
  store(to, at, value);
}
}  // namespace scanloom
