/**
 * Any bytes as a SQLite file. The first byte chooses between the rest behind the magic number, and a sound small bag
 * some of whose bytes the rest replaces: pairs of place and value. fuzz options: -max_len=512
 */
#include <sqlite3.h>

#include <fstream>
#include <iterator>

#include "readBag.h"

using namespace scanloom;

namespace
{
std::vector<std::uint8_t> soundBag()
{
  const FuzzFolder folder;
  const std::filesystem::path path = static_cast<const std::filesystem::path&>(folder) / "bag";
  sqlite3* database = nullptr;
  require(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
  for (const char* sql :
       {"PRAGMA page_size = 512",
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)",
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)",
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC)",
        "INSERT INTO topics VALUES(1, '/a', 't/msg/T', 'cdr')", "INSERT INTO messages VALUES(1, 1, 5, zeroblob(700))",
        "INSERT INTO messages VALUES(2, 1, 4, x'010203')", "INSERT INTO messages VALUES(3, 2, 4, x'010203')"})
    require(sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  if (data[0] % 2 == 0)
  {
    std::vector<std::uint8_t> file;
    append(file, std::string("SQLite format 3\0", 16));
    append(file, rest);
    readBag(file);
    return 0;
  }
  static const std::vector<std::uint8_t> kSound = soundBag();
  std::vector<std::uint8_t> file = kSound;
  for (std::size_t i = 0; i + 3 <= rest.size(); i += 3)
    file[16 + load<std::uint16_t>(rest, i) % (file.size() - 16)] = rest[i + 2];
  readBag(file);
  return 0;
}
