#include "mutate.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace scanloom
{
namespace
{
using Random = std::mt19937_64;

/** 0 to below - 1. The distributions of the standard library differ between compilers. */
std::size_t draw(std::size_t below, Random& random) { return below == 0 ? 0 : random() % below; }

/** Often near the beginning, where headers are. */
std::size_t place(const std::string& content, Random& random)
{
  constexpr std::size_t kHeader = 600;
  return draw(draw(3, random) == 0 ? std::min(kHeader, content.size()) : content.size(), random);
}

template <typename Number>
std::string bytesOf(Number number)
{
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

std::string specialNumber(Random& random)
{
  const std::vector<std::string> special{bytesOf(std::uint8_t{0xFF}),
                                         bytesOf(std::uint16_t{0xFFFF}),
                                         bytesOf(std::uint16_t{0}),
                                         bytesOf(std::uint32_t{0}),
                                         bytesOf(std::uint32_t{1}),
                                         bytesOf(std::uint32_t{0x7FFFFFFF}),
                                         bytesOf(std::uint32_t{0x80000000}),
                                         bytesOf(std::uint32_t{0xFFFFFFFF}),
                                         bytesOf(std::uint32_t{0x00FFFFFF}),
                                         bytesOf(std::numeric_limits<float>::quiet_NaN()),
                                         bytesOf(std::numeric_limits<float>::infinity()),
                                         bytesOf(1e30F),
                                         bytesOf(-1e5F),
                                         bytesOf(std::numeric_limits<double>::quiet_NaN()),
                                         bytesOf(1e300),
                                         bytesOf(std::numeric_limits<std::int64_t>::max()),
                                         bytesOf(std::numeric_limits<std::int64_t>::min())};
  return special[draw(special.size(), random)];
}

void changeBytes(std::string& content, Random& random)
{
  const std::size_t at = place(content, random);
  const std::size_t length = std::min(content.size() - at, std::size_t{1} << draw(12, random));
  switch (draw(9, random))
  {
    case 0:
    case 1:
      content[at] = static_cast<char>(content[at] ^ 1 << draw(8, random));
      break;
    case 2:
      content[at] = static_cast<char>(random());
      break;
    case 3:
    case 4:
    {
      const std::string number = specialNumber(random);
      content.replace(at, number.size(), number);
      break;
    }
    case 5:
      content.erase(at, length);
      break;
    case 6:
      content.insert(at, content.substr(at, length));
      break;
    case 7:
      std::fill_n(content.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
      break;
    default:
      content.resize(at);
  }
}

constexpr const char* kDigits = "0123456789+-.eE";

void changeNumber(std::string& content, Random& random)
{
  constexpr std::array kSpecial{
      "nan",        "inf", "-inf", "0",   "-1", "1e308", "-1e308", "1e-308", "99999999999999999999",
      "2147483648", "1e9", "-0.5", "1e5", "",   "0x10",  "1,5",    "zero"};
  const std::size_t from = content.find_first_of("0123456789", place(content, random));
  if (from == std::string::npos) return;
  if (draw(3, random) == 0)
  {
    content[from] = static_cast<char>('0' + draw(10, random));  // a stamp of another month or year, a column more
    return;
  }
  const std::size_t begin = content.find_last_not_of(kDigits, from) + 1;  // npos + 1 is 0
  const std::size_t end = std::min(content.find_first_not_of(kDigits, from), content.size());
  content.replace(begin, end - begin, kSpecial[draw(kSpecial.size(), random)]);
}

void changeLines(std::string& content, Random& random)
{
  const auto lineAt = [&](std::size_t at)
  {
    const std::size_t begin = at == 0 ? 0 : content.rfind('\n', at - 1) + 1;
    return std::pair(begin, std::min(content.find('\n', at), content.size() - 1) + 1 - begin);
  };
  const auto [begin, length] = lineAt(place(content, random));
  const std::string line = content.substr(begin, length);
  if (draw(3, random) != 0) content.erase(begin, length);
  if (draw(2, random) == 0) content.insert(lineAt(place(content, random)).first, line);
}

void changeText(std::string& content, Random& random)
{
  const std::size_t kind = draw(8, random);
  if (kind < 5)
    changeNumber(content, random);
  else if (kind < 7)
    changeLines(content, random);
  else
    changeBytes(content, random);
}

/** zlib's own functions, with the window size that stands for a gzip header. */
constexpr int kGzip = 15 + 16, kGzipOrZlib = 15 + 32;

void pump(z_stream& stream, int (*step)(z_stream*, int), std::string& output)
{
  std::vector<char> chunk(1 << 18);
  for (int result = Z_OK; result == Z_OK;)
  {
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    result = step(&stream, Z_FINISH);
    if (result == Z_BUF_ERROR && stream.avail_out < chunk.size()) result = Z_OK;
    output.append(chunk.data(), chunk.size() - stream.avail_out);
  }
}

void feed(z_stream& stream, const std::string& input)
{
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(input.data()));
  stream.avail_in = static_cast<uInt>(input.size());
}
}  // namespace

std::string packed(const std::string& content)
{
  z_stream stream{};
  if (deflateInit2(&stream, 1, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::runtime_error("deflate");
  feed(stream, content);
  std::string gzip;
  pump(stream, &deflate, gzip);
  deflateEnd(&stream);
  return gzip;
}

std::string unpacked(const std::string& gzip)
{
  z_stream stream{};
  if (inflateInit2(&stream, kGzipOrZlib) != Z_OK) throw std::runtime_error("inflate");
  feed(stream, gzip);
  std::string content;
  pump(stream, &inflate, content);
  inflateEnd(&stream);
  if (content.empty()) throw std::runtime_error("is no gzip file");
  return content;
}

std::string mutated(const std::string& content, Content kind, std::mt19937_64& random)
{
  if (kind == Content::Packed)
    return draw(8, random) == 0 ? mutated(content, Content::Binary, random)
                                : packed(mutated(unpacked(content), Content::Binary, random));
  std::string changed = content;
  const std::size_t least = 1 + draw(4, random);
  for (std::size_t n = 0; (n < least || changed == content) && !changed.empty(); ++n)
    (kind == Content::Text ? changeText : changeBytes)(changed, random);
  return changed;
}
}  // namespace scanloom
