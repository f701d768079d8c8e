/**
 * A gzip file as MRPT's archive. MRPT's own CFileGZInputStream and CFileGZOutputStream do not report a damaged or cut
 * file (gzread's -1 becomes a length of 2^64 - 1) nor a full disk (gzclose's result is ignored).
 */
#pragma once
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <filesystem>

namespace scanloom
{
class GzipArchive : public mrpt::serialization::CArchive
{
 public:
  /** Also reads plain files. Throws std::runtime_error with the file's name if it can't be opened. */
  static GzipArchive reading(const std::filesystem::path&);
  /** Level 0 (stored) to 9. */
  static GzipArchive writing(const std::filesystem::path&, int level);
  /** To an open file, whose descriptor the archive closes. @param path for messages. */
  static GzipArchive writing(int descriptor, const std::filesystem::path& path, int level);
  /** Reads the file to its end. Throws std::runtime_error if it can't be opened, is cut short or damaged. */
  static std::uint64_t uncompressedBytes(const std::filesystem::path&);

  GzipArchive(GzipArchive&&) noexcept;
  GzipArchive& operator=(GzipArchive&&) = delete;
  ~GzipArchive() override;

  /** Whether the file ends here. Throws std::runtime_error if it ends because it is cut or damaged. */
  bool atEnd();

  /** Reads `count` bytes, or fewer if the file ends before. Throws std::runtime_error if its data are damaged. */
  std::size_t readUpTo(void* bytes, std::size_t count);

  /** Compressed bytes, for a progress bar; ahead of the objects by up to one buffer. */
  std::uint64_t bytesRead() const;

  /**
   * Ends the gzip member and passes it to the operating system: what was written so far is readable even if the program
   * is killed. Readers take the members of a file as one stream. Throws std::runtime_error if it cannot be written.
   */
  void endMember();

  /** Throws std::runtime_error if not everything could be written. */
  void close();

 protected:
  std::size_t write(const void* bytes, std::size_t count) override;
  /** Reads all `count` bytes, or throws std::runtime_error. */
  std::size_t read(void* bytes, std::size_t count) override;

 private:
  GzipArchive(const std::filesystem::path&, gzFile opened);
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  gzFile file_;
};
}  // namespace scanloom
