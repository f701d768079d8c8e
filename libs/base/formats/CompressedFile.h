#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

namespace scanloom
{
/**
 * Reads a file that is plain, gzip or zstd, as its first bytes say; several members or frames are one stream.
 * One that unpacks to more than 64 MiB and 64 times its size counts as damaged from there on: clouds shrink to a third,
 * text of round numbers to a twentieth, zeros to a thousandth and less.
 */
class CompressedFile
{
 public:
  /** Throws std::runtime_error with the file's name if it cannot be opened, or is a pipe or a device. */
  explicit CompressedFile(const std::filesystem::path&);
  ~CompressedFile();

  /** Reads `count` bytes, or fewer if the file ends before. Throws std::runtime_error if its data are damaged. */
  std::size_t readUpTo(void* bytes, std::size_t count);

  /** Reads `count` bytes. Throws std::runtime_error if the file ends before. */
  void read(void* bytes, std::size_t count);

  /** Whether the file ends here. Throws std::runtime_error if it ends because it is cut or damaged. */
  bool atEnd();

  /** Compressed bytes, for a progress bar; ahead of what was read by up to one buffer. */
  std::uint64_t bytesRead() const;

 private:
  class Source;
  class Plain;
  class Gzip;
  class Zstd;
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;
  std::unique_ptr<Source> source_;
  std::uint64_t unpacked_ = 0;
  std::optional<char> next_;  // read by atEnd()
};

/** Whether the first bytes are those of gzip or zstd; false for a file that can't be read. */
bool isCompressed(const std::filesystem::path&);

/** Reads the file to its end, and throws as CompressedFile does. */
std::uint64_t uncompressedBytes(const std::filesystem::path&);
}  // namespace scanloom
