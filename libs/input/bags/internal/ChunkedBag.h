/** What MCAP and the bags of ROS 1 have in common: messages in chunks, read from the front to the back of one file. */
#pragma once
#include "base/formats/CompressedFile.h"
#include "input/bags/BagReader.h"
#include "input/bags/internal/unpacked.h"

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>

namespace scanloom
{
/** Some messages and the memory that they are views of. */
struct BagChunk
{
  std::vector<std::uint8_t> bytes;
  std::vector<BagMessage> messages;
};

/** The file behind a container, front to back. */
class BagFile
{
 public:
  explicit BagFile(const std::filesystem::path&);

  /** Memory grows with what the file has, not with `count`. Throws std::runtime_error if it ends before, or for more
   * than 64 MiB and 6 times the file. */
  std::vector<std::uint8_t> read(std::uint64_t count);

  /** Throws as read(). */
  void skip(std::uint64_t count);

  bool atEnd() { return file_.atEnd(); }
  std::uint64_t position() const { return position_; }
  std::uint64_t bytesRead() const { return file_.bytesRead(); }

 private:
  CompressedFile file_;
  std::uint64_t largest_record_;
  std::uint64_t position_ = 0;  // unpacked
};

/** The bytes of a plain file from `begin` up to `end`, an index; none if there are none, or more than 2^28. */
std::vector<std::uint8_t> indexBytes(const std::filesystem::path&, std::uint64_t begin, std::uint64_t end);

/** A container's format. */
class ChunkSource
{
 public:
  virtual ~ChunkSource() = default;

  virtual const std::vector<BagTopic>& topics() const = 0;

  /**
   * Replaces `chunk` by the next one, which may be empty; false at the end. Throws std::runtime_error or
   * std::out_of_range where the file can't be read on.
   */
  virtual bool read(BagChunk& chunk) = 0;

  /** Of the file that is read. */
  virtual const BagFile& file() const = 0;

  /** Chunks that were left out because their content is damaged. */
  virtual std::uint64_t damagedChunks() const = 0;
};

/** A container whose `Topics` are met as its records are read. */
template <typename Topics>
class RecordSource : public ChunkSource
{
 public:
  RecordSource(const std::filesystem::path& path, std::uint64_t magic_bytes)
    : file_(path), unpacker_(std::filesystem::file_size(path))
  {
    file_.skip(magic_bytes);
  }

  const std::vector<BagTopic>& topics() const override { return topics_.topics(); }
  const BagFile& file() const override { return file_; }
  std::uint64_t damagedChunks() const override { return damaged_; }

 protected:
  /** For a file whose index names no topics. What is damaged in it is said when its messages are read. */
  void readAllForTopics(RecordSource& whole)
  {
    try
    {
      for (BagChunk ignored; whole.read(ignored);)
      {
      }
    }
    catch (const std::exception&)  // all topics before it are known
    {
    }
    topics_ = whole.topics_;
  }

  /** Calls fill(), which makes `chunk` of its record: one that is damaged is left out and counted. */
  template <typename Fill>
  void fillOrCount(BagChunk& chunk, Fill&& fill)
  {
    try
    {
      fill();
    }
    catch (const UnpacksToTooMuch&)
    {
      throw;
    }
    catch (const std::exception&)
    {
      chunk.messages.clear();
      ++damaged_;
    }
  }

  BagFile file_;
  Unpacker unpacker_;
  Topics topics_;

 private:
  std::uint64_t damaged_ = 0;
};

/** Messages of a chunk in the order of receive times, chunks in that of the file. */
class ChunkedBag : public BagReader
{
 public:
  ChunkedBag(const std::filesystem::path&, std::unique_ptr<ChunkSource>);

  const std::vector<BagTopic>& topics() const override { return source_->topics(); }
  bool next(BagMessage&) override;
  std::vector<std::string> takeWarnings() override;
  double progress() const override;

 private:
  bool readChunk();

  std::filesystem::path path_;
  std::uint64_t file_bytes_;
  std::unique_ptr<ChunkSource> source_;
  BagChunk chunk_;
  std::size_t at_ = 0;  // in chunk_
  bool ended_ = false;
  std::vector<std::string> warnings_;
};

/** Topics in the order in which they were met, each once. */
class TopicList
{
 public:
  /** Its place; it is added if it is new. */
  std::size_t placeOf(const BagTopic&);

  const std::vector<BagTopic>& topics() const { return topics_; }

 private:
  std::vector<BagTopic> topics_;
  std::map<std::tuple<std::string, std::string, Serialisation>, std::size_t> places_;  // by name, type, serialisation
};
}  // namespace scanloom
