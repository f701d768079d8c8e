/** A SQLite file that is only read, and not trusted. */
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace scanloom
{
class SqliteDatabase
{
 public:
  /** A file in gzip or zstd is unpacked to a temporary one first. Throws std::runtime_error if it can't be opened. */
  explicit SqliteDatabase(const std::filesystem::path&);

  struct Finish
  {
    void operator()(sqlite3_stmt*) const;
  };
  using Rows = std::unique_ptr<sqlite3_stmt, Finish>;

  /** Throws std::runtime_error with the file's name if the question can't be asked. */
  Rows ask(const std::string& sql) const;

  /** Null where the question can't be asked. */
  Rows askIfPossible(const std::string& sql) const;

  /** The latest error, as SQLite puts it. */
  std::string error() const;

  /** Whether the file is shorter than its header says. */
  bool isCut() const { return is_cut_; }

  /** Of the file, unpacked, and its write-ahead log. */
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Close
  {
    void operator()(sqlite3*) const;
  };

  /** The index of a write-ahead log, which SQLite leaves beside a file that it only reads. */
  struct Index
  {
    explicit Index(std::filesystem::path);
    ~Index();
    Index(const Index&) = delete;
    Index& operator=(const Index&) = delete;

    std::filesystem::path path;
    bool was_there;
  };

  std::filesystem::path path_;
  std::uint64_t bytes_ = 0;
  bool is_cut_ = false;
  std::optional<Index> index_;  // removed after the database is closed
  std::unique_ptr<sqlite3, Close> database_;
};
}  // namespace scanloom
