/**
 * A gzip file as MRPT's archive. mrpt::io::CFileGZ*Stream would do but for what they keep to themselves: a damaged or
 * cut file (gzread's -1 becomes a length of 2^64 - 1) and a full disk (gzclose's result is dropped).
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
  /** Reads it to the end. Throws std::runtime_error if it can't be opened, is cut short or damaged. */
  static std::uint64_t uncompressedBytes(const std::filesystem::path&);

  GzipArchive(GzipArchive&&) noexcept;
  GzipArchive& operator=(GzipArchive&&) = delete;
  ~GzipArchive() override;

  /** Whether the file ends here, in good order; throws std::runtime_error if it ends because it was cut or damaged. */
  bool atEnd();

  /** Of the file as it lies on the disk, for a progress bar: runs ahead of the objects by a buffer. */
  std::uint64_t bytesRead() const;

  /**
   * What was written so far is handed to the operating system as a whole gzip member: readable whatever becomes of this
   * program. Readers take the members of a file for one stream. Throws std::runtime_error if the disk says no.
   */
  void endMember();

  /** Throws std::runtime_error if not everything got onto the disk. */
  void close();

 protected:
  std::size_t write(const void* bytes, std::size_t count) override;
  /** All of them, or std::runtime_error. */
  std::size_t read(void* bytes, std::size_t count) override;

 private:
  GzipArchive(const std::filesystem::path&, const std::string& mode);
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  gzFile file_;
};
}  // namespace scanloom
