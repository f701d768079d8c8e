#include "input/bags/internal/McapBag.h"

#include "input/bags/internal/ChunkedBag.h"
#include "input/bags/internal/MessageReader.h"

#include <zlib.h>

#include <map>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr std::uint64_t kMagicBytes = 8;
constexpr std::uint64_t kRecordHeader = 9;  // u8 opcode, u64 length of what follows
constexpr std::uint64_t kFooter = kRecordHeader + 20;

enum McapRecord : std::uint8_t
{
  kMcapFooter = 2,
  kMcapSchema = 3,
  kMcapChannel = 4,
  kMcapMessage = 5,
  kMcapChunk = 6,
  kMcapDataEnd = 15,
};

/** Fields of records are like those of ROS 1: little endian, one after the other, strings led by their length. */
MessageReader fieldsOf(Bytes record) { return {record, Serialisation::Ros1}; }

Serialisation serialisationNamed(const std::string& name)
{
  if (name == "cdr") return Serialisation::Cdr;
  return name == "ros1" ? Serialisation::Ros1 : Serialisation::Unknown;
}

/** The schemas and channels seen so far. */
class McapTopics
{
 public:
  void addSchema(Bytes record)
  {
    MessageReader fields = fieldsOf(record);
    const auto id = fields.number<std::uint16_t>();
    types_[id] = fields.string();
  }

  void addChannel(Bytes record)
  {
    MessageReader fields = fieldsOf(record);
    const auto id = fields.number<std::uint16_t>(), schema = fields.number<std::uint16_t>();
    const std::string name = fields.string(), serialisation = fields.string();
    const auto type = types_.find(schema);
    places_[id] = topics_.placeOf(
        declaredTopic(name, type == types_.end() ? "" : type->second, serialisationNamed(serialisation)));
  }

  /** Of a channel that was not declared, none. */
  void addMessage(Bytes record, BagChunk& chunk) const
  {
    MessageReader fields = fieldsOf(record);
    const auto place = places_.find(fields.number<std::uint16_t>());
    fields.number<std::uint32_t>();  // a running number
    const Timestamp received = bagStamp(fields.number<std::uint64_t>());
    fields.number<std::uint64_t>();  // when it was published
    if (place != places_.end()) chunk.messages.push_back({place->second, received, fields.rest()});
  }

  void add(std::uint8_t kind, Bytes record, BagChunk& chunk)
  {
    if (kind == kMcapSchema) addSchema(record);
    if (kind == kMcapChannel) addChannel(record);
    if (kind == kMcapMessage) addMessage(record, chunk);
  }

  const std::vector<BagTopic>& topics() const { return topics_.topics(); }

 private:
  std::map<std::uint16_t, std::string> types_;   // by schema
  std::map<std::uint16_t, std::size_t> places_;  // of topics, by channel
  TopicList topics_;
};

/** All records of `bytes`. Throws std::out_of_range if the last one is cut. */
void addRecords(Bytes bytes, McapTopics& topics, BagChunk& chunk)
{
  for (std::size_t at = 0; at < bytes.size();)
  {
    const auto kind = load<std::uint8_t>(bytes, at);
    const auto length = load<std::uint64_t>(bytes, at + 1);
    topics.add(kind, bytes.slice(at + kRecordHeader, length), chunk);
    at += kRecordHeader + length;
  }
}

/** The records of the summary at the file's end; none if there is no summary. */
std::vector<std::uint8_t> summaryOf(const std::filesystem::path& path)
{
  constexpr std::uint64_t kEnd = kFooter + kMagicBytes;
  const std::uint64_t size = std::filesystem::file_size(path);
  if (size < kEnd) return {};
  const std::vector<std::uint8_t> footer = indexBytes(path, size - kEnd, size - kMagicBytes);
  if (footer.empty() || footer[0] != kMcapFooter || load<std::uint64_t>(footer, 1) != kFooter - kRecordHeader)
    return {};
  const auto start = load<std::uint64_t>(footer, kRecordHeader);
  return start == 0 ? std::vector<std::uint8_t>() : indexBytes(path, start, size - kEnd);
}

class McapSource : public RecordSource<McapTopics>
{
 public:
  explicit McapSource(const std::filesystem::path& path) : RecordSource(path, kMagicBytes) {}

  /** From the summary, or by reading the file. */
  void findTopics(const std::filesystem::path& path)
  {
    BagChunk ignored;
    try
    {
      addRecords(summaryOf(path), topics_, ignored);
    }
    catch (const std::out_of_range&)  // a damaged summary
    {
    }
    if (!topics().empty()) return;
    McapSource whole(path);
    readAllForTopics(whole);
  }

  bool read(BagChunk& chunk) override
  {
    chunk.messages.clear();
    if (file_.atEnd()) throw std::runtime_error("the file has no end");
    const std::vector<std::uint8_t> head = file_.read(kRecordHeader);
    const std::uint8_t kind = head[0];
    const auto length = load<std::uint64_t>(head, 1);
    if (kind == kMcapDataEnd || kind == kMcapFooter) return false;
    if (kind == kMcapSchema || kind == kMcapChannel || kind == kMcapMessage)
    {
      chunk.bytes = file_.read(length);
      topics_.add(kind, chunk.bytes, chunk);
    }
    else if (kind == kMcapChunk)
      readChunk(file_.read(length), chunk);
    else
      file_.skip(length);
    return true;
  }

 private:
  void readChunk(const std::vector<std::uint8_t>& record, BagChunk& chunk)
  {
    MessageReader fields = fieldsOf(record);
    fields.number<std::uint64_t>();  // first and
    fields.number<std::uint64_t>();  // last receive time
    const auto size = fields.number<std::uint64_t>();
    const auto crc = fields.number<std::uint32_t>();
    const std::string compression = fields.string();
    const Bytes records = fields.bytes(fields.number<std::uint64_t>());
    fillOrCount(chunk,
                [&]
                {
                  chunk.bytes = compression.empty() ? std::vector<std::uint8_t>(records.begin(), records.end())
                                                    : unpacker_.unpacked(records, compression, size);
                  const auto found = ::crc32_z(0, chunk.bytes.data(), chunk.bytes.size());
                  if (crc != 0 && found != crc) throw std::runtime_error("a wrong checksum");
                  addRecords(chunk.bytes, topics_, chunk);
                });
  }
};
}  // namespace

std::unique_ptr<BagReader> openMcapBag(const std::filesystem::path& path)
{
  auto source = std::make_unique<McapSource>(path);
  source->findTopics(path);
  return std::make_unique<ChunkedBag>(path, std::move(source));
}
}  // namespace scanloom
