/**
 * Writes objects of MRPT to a gzip file. MRPT's own CFileGZOutputStream does not report a full disk: gzclose's result
 * is ignored.
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
  /** Level 0 (stored) to 9. Throws std::runtime_error with the file's name if it can't be opened. */
  static GzipArchive writing(const std::filesystem::path&, int level);
  /** To an open file, whose descriptor the archive closes. @param path for messages. */
  static GzipArchive writing(int descriptor, const std::filesystem::path& path, int level);
  GzipArchive(GzipArchive&&) noexcept;
  GzipArchive& operator=(GzipArchive&&) = delete;
  ~GzipArchive() override;

  /**
   * Ends the gzip member and passes it to the operating system: what was written so far is readable even if the program
   * is killed. Readers take the members of a file as one stream. Throws std::runtime_error if it cannot be written.
   */
  void endMember();

  /** Throws std::runtime_error if not everything could be written. */
  void close();

 protected:
  std::size_t write(const void* bytes, std::size_t count) override;
  [[noreturn]] std::size_t read(void* bytes, std::size_t count) override;

 private:
  GzipArchive(const std::filesystem::path&, gzFile opened);
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  gzFile file_;
};
}  // namespace scanloom
