/**
 * Any bytes as a SQLite file. The first byte chooses between the rest behind the magic number; a sound small bag some
 * of whose bytes the rest replaces, by pairs of place and value; and the folder of a recorder that lost power, whose
 * rows are in the write-ahead log, replaced alike in the bag or in the log. fuzz options: -max_len=512
 */
#include <sqlite3.h>

#include <fstream>
#include <iterator>

#include "readBag.h"

using namespace scanloom;

namespace
{
using Content = std::vector<std::uint8_t>;

Content contentOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct BagFiles
{
  Content bag, log;
};

/** `journal`: "DELETE" or "WAL", SQLite's names; files as they are before the database is closed. */
BagFiles soundBag(const std::string& journal)
{
  const FuzzFolder folder;
  const std::filesystem::path path = static_cast<const std::filesystem::path&>(folder) / "bag";
  sqlite3* database = nullptr;
  require(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
  for (const std::string& sql : std::vector<std::string>{
           "PRAGMA page_size = 512", "PRAGMA journal_mode = " + journal, "PRAGMA wal_autocheckpoint = 0",
           "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)",
           "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)",
           "CREATE INDEX timestamp_idx ON messages (timestamp ASC)",
           "INSERT INTO topics VALUES(1, '/a', 't/msg/T', 'cdr')", "PRAGMA wal_checkpoint(TRUNCATE)",
           "INSERT INTO messages VALUES(1, 1, 5, zeroblob(700))", "INSERT INTO messages VALUES(2, 1, 4, x'010203')",
           "INSERT INTO messages VALUES(3, 2, 4, x'010203')"})
    require(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  const BagFiles files{contentOf(path), contentOf(path.string() + "-wal")};
  sqlite3_close(database);
  return files;
}

/** By triples of place, two bytes, and value; the first `kept` bytes stay. */
Content withChanges(Content file, Bytes changes, std::size_t kept)
{
  for (std::size_t i = 0; i + 3 <= changes.size(); i += 3)
    file[kept + load<std::uint16_t>(changes, i) % (file.size() - kept)] = changes[i + 2];
  return file;
}

/** The log has to lie beside its bag, so these are files. */
void readWithLog(const BagFiles& files)
{
  static const FuzzFolder folder;
  const std::filesystem::path path = static_cast<const std::filesystem::path&>(folder) / "bag.db3";
  const auto write = [](const std::filesystem::path& to, const Content& bytes)
  {
    std::ofstream(to, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  write(path, files.bag);
  write(path.string() + "-wal", files.log);
  readBagAt(path);
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  constexpr std::size_t kMagic = 16;
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  static const BagFiles kSound = soundBag("DELETE"), kLogged = soundBag("WAL");
  switch (data[0] % 4)
  {
    case 0:
    {
      Content file;
      append(file, std::string("SQLite format 3\0", kMagic));
      append(file, rest);
      readBag(file);
      break;
    }
    case 1:
      readBag(withChanges(kSound.bag, rest, kMagic));
      break;
    case 2:
      readWithLog({kLogged.bag, withChanges(kLogged.log, rest, 0)});
      break;
    default:
      readWithLog({withChanges(kLogged.bag, rest, kMagic), kLogged.log});
  }
  return 0;
}
