#include "input/bags/internal/SqliteDatabase.h"

#include "base/formats/CompressedFile.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace scanloom
{
namespace
{
/** No row of a table holds more bytes than its file; the queries themselves need some hundred. */
int mostBytesOfARow(std::uint64_t file)
{
  constexpr std::uint64_t kLeast = 1 << 16, kMost = 1 << 30;
  return static_cast<int>(std::clamp(file, kLeast, kMost));
}

/** Its file is removed with it. */
class TemporaryCopy
{
 public:
  explicit TemporaryCopy(const std::filesystem::path& packed)
  {
    std::string name = (std::filesystem::temp_directory_path() / "scanloom-bag-XXXXXX").string();
    const int descriptor = ::mkstemp(name.data());
    if (descriptor < 0) throw std::runtime_error(fmt::format("{}: can't be created, to unpack a bag", name));
    ::close(descriptor);
    path = name;
    try
    {
      unpack(packed);
    }
    catch (...)
    {
      std::filesystem::remove(path);
      throw;
    }
  }
  ~TemporaryCopy()
  {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  TemporaryCopy(const TemporaryCopy&) = delete;
  TemporaryCopy& operator=(const TemporaryCopy&) = delete;

  std::filesystem::path path;

 private:
  void unpack(const std::filesystem::path& packed)
  {
    CompressedFile from(packed);
    std::ofstream to(path, std::ios::binary);
    std::vector<char> part(1 << 20);
    for (std::size_t got = part.size(); got == part.size();)
    {
      got = from.readUpTo(part.data(), part.size());
      to.write(part.data(), static_cast<std::streamsize>(got));
    }
    to.close();
    if (!to)
      throw std::runtime_error(fmt::format("{}: disk full while {} was unpacked", path.string(), packed.string()));
  }
};

/** Pages are counted in the header of the file, big endian. */
bool isShorterThanItSays(const std::filesystem::path& path, std::uint64_t bytes)
{
  std::array<unsigned char, 32> header{};
  std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(header.data()), header.size());
  std::uint64_t page = (std::uint64_t{header[16]} << 8U) | header[17];
  if (page == 1) page = 65536;
  std::uint64_t pages = 0;
  for (std::size_t i = 28; i < 32; ++i) pages = (pages << 8U) | header[i];
  return pages * page > bytes;
}

/** Bytes of the write-ahead log beside it, which holds the latest messages of a recorder that lost power. */
std::uint64_t journalBytes(const std::filesystem::path& path)
{
  std::error_code none;
  const auto bytes = std::filesystem::file_size(path.string() + "-wal", none);
  return none ? 0 : bytes;
}

/** With '?' and '%' as an URI wants them. With a journal the file is not immutable. */
std::string uriOf(const std::filesystem::path& path)
{
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string())
    uri += c == '?' || c == '%' || c == '#' ? fmt::format("%{:02x}", c) : std::string(1, c);
  return uri + (journalBytes(path) == 0 ? "?immutable=1" : "");
}
}  // namespace

SqliteDatabase::Index::Index(std::filesystem::path p) : path(std::move(p)), was_there(std::filesystem::exists(path)) {}

SqliteDatabase::Index::~Index()
{
  std::error_code ignored;
  if (!was_there) std::filesystem::remove(path, ignored);
}

void SqliteDatabase::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }
void SqliteDatabase::Finish::operator()(sqlite3_stmt* rows) const { sqlite3_finalize(rows); }

SqliteDatabase::SqliteDatabase(const std::filesystem::path& path) : path_(path)
{
  std::unique_ptr<TemporaryCopy> copy;
  if (isCompressed(path)) copy = std::make_unique<TemporaryCopy>(path);
  const std::filesystem::path& plain = copy ? copy->path : path;
  bytes_ = std::filesystem::file_size(plain);
  is_cut_ = isShorterThanItSays(plain, bytes_);
  bytes_ += journalBytes(plain);
  if (journalBytes(plain) > 0) index_.emplace(plain.string() + "-shm");

  sqlite3* opened = nullptr;
  const int status = sqlite3_open_v2(uriOf(plain).c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  database_.reset(opened);
  if (status != SQLITE_OK) throw std::runtime_error(fmt::format("{}: can't be opened: {}", path.string(), error()));
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, mostBytesOfARow(bytes_));
  // Nothing that a schema could bring along is run. With a writable schema, SQLite opens a file that was cut.
  for (const char* sql : {"PRAGMA trusted_schema = OFF", "PRAGMA cell_size_check = ON", "PRAGMA cache_size = -4096"})
    sqlite3_exec(opened, sql, nullptr, nullptr, nullptr);
  if (is_cut_) sqlite3_exec(opened, "PRAGMA writable_schema = ON", nullptr, nullptr, nullptr);
}

SqliteDatabase::Rows SqliteDatabase::askIfPossible(const std::string& sql) const
{
  sqlite3_stmt* rows = nullptr;
  sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &rows, nullptr);
  return Rows(rows);
}

SqliteDatabase::Rows SqliteDatabase::ask(const std::string& sql) const
{
  if (Rows rows = askIfPossible(sql)) return rows;
  throw std::runtime_error(fmt::format("{}: a SQLite file, but no bag of ROS 2: {}", path_.string(), error()));
}

std::string SqliteDatabase::error() const { return sqlite3_errmsg(database_.get()); }
}  // namespace scanloom
