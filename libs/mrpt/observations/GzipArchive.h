/**
 * Writes objects of MRPT to a gzip file, of members that are compressed side by side. Readers take the members of a
 * file as one stream (RFC 1952, 2.2).
 */
#pragma once
#include "input/packets/FileDescriptor.h"

#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <future>
#include <vector>

namespace scanloom
{
class GzipArchive : public mrpt::serialization::CArchive
{
 public:
  /**
   * Level 0 (stored) to 12; level 1 stores parts that would hardly shrink. Throws std::runtime_error with the file's
   * name if it can't be opened.
   */
  GzipArchive(const std::filesystem::path&, int level);
  /** To an open file, whose descriptor the archive closes. @param path for messages. */
  GzipArchive(int descriptor, const std::filesystem::path& path, int level);
  /** Without close() all objects so far are in the file, if they can be written. */
  ~GzipArchive() override;

  /**
   * Passes all objects so far to the operating system: they are readable even if the program is killed. Throws
   * std::runtime_error if they cannot be written.
   */
  void endMember();

  /** Throws std::runtime_error if not everything could be written. */
  void close();

 protected:
  std::size_t write(const void* bytes, std::size_t count) override;
  [[noreturn]] std::size_t read(void* bytes, std::size_t count) override;

 private:
  using Bytes = std::vector<std::uint8_t>;

  void compressMember();
  void writeOldest();
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  int level_;
  FileDescriptor file_;
  Bytes member_;                            // not yet compressed
  std::deque<std::future<Bytes>> members_;  // that threads compress, in the file's order
};

/**
 * A file of one object, as saveToFile() of MRPT's maps and scenes, which write zstd since 2.15: older ones do not read
 * that. Appears when it is complete. Throws std::runtime_error.
 */
void writeGzip(const std::filesystem::path&, const mrpt::serialization::CSerializable&);
}  // namespace scanloom
