#include "input/bags/internal/Ros1Bag.h"

#include "input/bags/internal/ChunkedBag.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace scanloom
{
namespace
{
constexpr std::uint64_t kRos1Magic = 13;  // "#ROSBAG V2.0\n"

enum Ros1Record : std::uint8_t
{
  kRos1Message = 2,
  kRos1BagHeader = 3,
  kRos1Chunk = 5,
  kRos1Connection = 7,
};

/** A record's header: "name=value" fields, each led by its length (u32). */
class Ros1Header
{
 public:
  /** Throws std::out_of_range for a field past the end. */
  explicit Ros1Header(Bytes bytes)
  {
    for (std::size_t at = 0; at < bytes.size();)
    {
      const Bytes field = bytes.slice(at + 4, load<std::uint32_t>(bytes, at));
      at += 4 + field.size();
      const std::string_view text(reinterpret_cast<const char*>(field.data()), field.size());
      const std::size_t equals = text.find('=');
      if (equals == std::string_view::npos) throw std::out_of_range("a field without '='");
      fields_[text.substr(0, equals)] = field.slice(equals + 1, field.size() - equals - 1);
    }
  }

  /** Throws std::out_of_range if there is none. */
  template <typename Number>
  Number number(std::string_view name) const
  {
    return load<Number>(field(name), 0);
  }
  std::string text(std::string_view name) const
  {
    const Bytes value = field(name);
    return {value.begin(), value.end()};
  }

 private:
  Bytes field(std::string_view name) const
  {
    if (const auto found = fields_.find(name); found != fields_.end()) return found->second;
    throw std::out_of_range(fmt::format("a record without '{}'", name));
  }

  std::map<std::string_view, Bytes> fields_;
};

/** What the connections say that were seen so far. */
class Ros1Topics
{
 public:
  /** The connection's own header is the record's data. */
  void addConnection(const Ros1Header& record, Bytes data)
  {
    places_[record.number<std::uint32_t>("conn")] =
        topics_.placeOf(declaredTopic(record.text("topic"), Ros1Header(data).text("type"), Serialisation::Ros1));
  }

  /** Of a connection that was not declared, none. */
  void addMessage(const Ros1Header& record, Bytes data, BagChunk& chunk) const
  {
    const auto place = places_.find(record.number<std::uint32_t>("conn"));
    const auto time = record.number<std::uint64_t>("time");  // u32 seconds, u32 nanoseconds
    const std::uint64_t received = (time & 0xFFFFFFFFU) * 1'000'000'000 + (time >> 32U);
    if (place != places_.end()) chunk.messages.push_back({place->second, bagStamp(received), data});
  }

  void add(const Ros1Header& header, Bytes data, BagChunk& chunk)
  {
    const auto kind = header.number<std::uint8_t>("op");
    if (kind == kRos1Connection) addConnection(header, data);
    if (kind == kRos1Message) addMessage(header, data, chunk);
  }

  const std::vector<BagTopic>& topics() const { return topics_.topics(); }

 private:
  std::map<std::uint32_t, std::size_t> places_;  // of topics, by connection
  TopicList topics_;
};

/** Throws std::out_of_range if the last record is cut. */
void addRos1Records(Bytes bytes, Ros1Topics& topics, BagChunk& chunk)
{
  for (std::size_t at = 0; at < bytes.size();)
  {
    const Bytes header = bytes.slice(at + 4, load<std::uint32_t>(bytes, at));
    at += 4 + header.size();
    const Bytes data = bytes.slice(at + 4, load<std::uint32_t>(bytes, at));
    at += 4 + data.size();
    topics.add(Ros1Header(header), data, chunk);
  }
}

class Ros1Source : public RecordSource<Ros1Topics>
{
 public:
  explicit Ros1Source(const std::filesystem::path& path) : RecordSource(path, kRos1Magic) {}

  /** From the index, or by reading the file. */
  void findTopics(const std::filesystem::path& path)
  {
    BagChunk ignored;
    try
    {
      Ros1Source beginning(path);
      beginning.read(ignored);
      if (beginning.index_at_ > 0)
        addRos1Records(indexBytes(path, beginning.index_at_, std::filesystem::file_size(path)), topics_, ignored);
    }
    catch (const std::exception&)  // a damaged index
    {
    }
    if (!topics().empty()) return;
    Ros1Source whole(path);
    readAllForTopics(whole);
  }

  bool read(BagChunk& chunk) override
  {
    chunk.messages.clear();
    if (file_.atEnd()) return ended();
    header_bytes_ = file_.read(length());
    const Ros1Header header(header_bytes_);
    const auto kind = header.number<std::uint8_t>("op");
    const std::uint64_t data_bytes = length();
    if (kind == kRos1Connection || kind == kRos1Message)
    {
      chunk.bytes = file_.read(data_bytes);
      topics_.add(header, chunk.bytes, chunk);
    }
    else if (kind == kRos1Chunk)
    {
      ++chunks_;
      readChunk(header, file_.read(data_bytes), chunk);
    }
    else
    {
      if (kind == kRos1BagHeader)
      {
        index_at_ = header.number<std::uint64_t>("index_pos");
        chunks_expected_ = header.number<std::uint32_t>("chunk_count");
      }
      file_.skip(data_bytes);
    }
    return true;
  }

 private:
  std::uint64_t length() { return load<std::uint32_t>(file_.read(4), 0); }

  /** A bag that was not closed has no index. */
  bool ended() const
  {
    if (index_at_ == 0) throw std::runtime_error("the bag was not closed: it has no index; 'rosbag reindex' mends it");
    if (chunks_ < chunks_expected_)
      throw std::runtime_error(fmt::format("{} of {} chunks are there", chunks_, chunks_expected_));
    return false;
  }

  void readChunk(const Ros1Header& header, std::vector<std::uint8_t> data, BagChunk& chunk)
  {
    fillOrCount(chunk,
                [&]
                {
                  const std::string compression = header.text("compression");
                  chunk.bytes = compression == "none"
                                    ? std::move(data)
                                    : unpacker_.unpacked(data, compression, header.number<std::uint32_t>("size"));
                  addRos1Records(chunk.bytes, topics_, chunk);
                });
  }

  std::vector<std::uint8_t> header_bytes_;
  std::uint64_t index_at_ = 0, chunks_expected_ = 0, chunks_ = 0;
};
}  // namespace

std::unique_ptr<BagReader> openRos1Bag(const std::filesystem::path& path)
{
  auto source = std::make_unique<Ros1Source>(path);
  source->findTopics(path);
  return std::make_unique<ChunkedBag>(path, std::move(source));
}
}  // namespace scanloom
