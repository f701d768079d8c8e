#include "input/bags/internal/ChunkedBag.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr std::uint64_t kReadAtOnce = 1 << 16;
constexpr std::uint64_t kAnyRecord = 64 << 20,
                        kRatioOfRecord = 6;  // the latter for a file that is compressed as a whole
}  // namespace

BagFile::BagFile(const std::filesystem::path& path)
  : file_(path), largest_record_(kAnyRecord + kRatioOfRecord * std::filesystem::file_size(path))
{
}

std::vector<std::uint8_t> BagFile::read(std::uint64_t count)
{
  if (count > largest_record_)
    throw std::runtime_error(fmt::format("a record that claims {} bytes: at most {} are read", count, largest_record_));
  std::vector<std::uint8_t> bytes;
  while (bytes.size() < count)
  {
    const std::size_t filled = bytes.size();
    bytes.resize(std::min(count, filled + std::max<std::uint64_t>(kReadAtOnce, filled)));
    const std::size_t got = file_.readUpTo(bytes.data() + filled, bytes.size() - filled);
    position_ += got;
    if (got < bytes.size() - filled) throw std::runtime_error("the file is cut within a record");
  }
  return bytes;
}

void BagFile::skip(std::uint64_t count)
{
  std::vector<char> part(std::min(count, kReadAtOnce));
  while (count > 0)
  {
    const std::size_t wanted = std::min<std::uint64_t>(count, part.size());
    const std::size_t got = file_.readUpTo(part.data(), wanted);
    position_ += got;
    if (got < wanted) throw std::runtime_error("the file is cut within a record");
    count -= got;
  }
}

std::vector<std::uint8_t> indexBytes(const std::filesystem::path& path, std::uint64_t begin, std::uint64_t end)
{
  constexpr std::uint64_t kLargestIndex = 1 << 28;
  if (begin >= end || end - begin > kLargestIndex || end > std::filesystem::file_size(path) || isCompressed(path))
    return {};
  std::vector<std::uint8_t> bytes(end - begin);
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::int64_t>(begin));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return file ? bytes : std::vector<std::uint8_t>();
}

ChunkedBag::ChunkedBag(const std::filesystem::path& path, std::unique_ptr<ChunkSource> source)
  : path_(path), file_bytes_(std::filesystem::file_size(path)), source_(std::move(source))
{
}

bool ChunkedBag::next(BagMessage& message)
{
  while (at_ == chunk_.messages.size())
    if (!readChunk()) return false;
  message = chunk_.messages[at_++];
  return true;
}

bool ChunkedBag::readChunk()
{
  at_ = 0;
  chunk_.messages.clear();
  if (ended_) return false;
  try
  {
    ended_ = !source_->read(chunk_);
  }
  catch (const std::exception& damage)  // std::runtime_error, std::out_of_range
  {
    ended_ = true;
    chunk_.messages.clear();
    warnings_.push_back(fmt::format("{}: cut or damaged before byte {} ({}); all before it was read", path_.string(),
                                    source_->file().position(), damage.what()));
  }
  if (ended_ && source_->damagedChunks() > 0)
    warnings_.push_back(
        fmt::format("{}: {} chunks are damaged and left out", path_.string(), source_->damagedChunks()));
  std::stable_sort(chunk_.messages.begin(), chunk_.messages.end(),
                   [](const BagMessage& a, const BagMessage& b) { return a.received < b.received; });
  return !ended_;
}

std::vector<std::string> ChunkedBag::takeWarnings() { return std::exchange(warnings_, {}); }

double ChunkedBag::progress() const
{
  if (ended_ || file_bytes_ == 0) return 1;
  return std::min(1.0, static_cast<double>(source_->file().bytesRead()) / static_cast<double>(file_bytes_));
}

std::size_t TopicList::placeOf(const BagTopic& topic)
{
  const auto [place, is_new] = places_.try_emplace({topic.name, topic.type, topic.serialisation}, topics_.size());
  if (is_new) topics_.push_back(topic);
  return place->second;
}
}  // namespace scanloom
