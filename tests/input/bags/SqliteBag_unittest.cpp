/** SQLite files that were made to harm: each is refused, or read up to the damage, which is told. */
#include "input/bags/internal/SqliteBag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "input/bags/BagReader.h"
#include "support/HandmadeBag.h"
#include "support/TemporaryFolder.h"

namespace scanloom::sqlite_bag_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

constexpr const char* kTopics =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);"
    "INSERT INTO topics VALUES(1, '/imu', 'sensor_msgs/msg/Imu', 'cdr');";

void writeDatabase(const std::filesystem::path& path, const std::string& sql)
{
  sqlite3* database = nullptr;
  sqlite3_open(path.c_str(), &database);
  char* error = nullptr;
  sqlite3_exec(database, ("PRAGMA page_size = 512;" + sql).c_str(), nullptr, nullptr, &error);
  sqlite3_close(database);
  if (error) throw std::runtime_error(error);
}

/** Lets every branch of the only tree that has branches point to its first leaf (sqlite.org/fileformat2.html, 1.6). */
void bendIntoACircle(const std::filesystem::path& path)
{
  constexpr std::size_t kPage = 512, kHeader = 12;
  constexpr char kBranches = 5;  // the first byte of an interior page of a table
  std::string bytes = contentOf(path);
  for (std::size_t page = kPage; page < bytes.size(); page += kPage)
  {
    if (bytes[page] != kBranches) continue;
    const auto u16 = [&](std::size_t at)
    {
      return static_cast<std::size_t>(static_cast<std::uint8_t>(bytes[at]) << 8U |
                                      static_cast<std::uint8_t>(bytes[at + 1]));
    };
    const auto childAt = [&](std::size_t cell) { return page + u16(page + kHeader + 2 * cell); };
    const std::string first = bytes.substr(childAt(0), 4);
    for (std::size_t cell = 1; cell < u16(page + 3); ++cell) bytes.replace(childAt(cell), 4, first);
    bytes.replace(page + 8, 4, first);
  }
  writeFile(path, bytes);
}

TEST(SqliteBag, endsWherePagesReferToEachOtherInACircleAndSaysSo)
{
  const TemporaryFolder folder;
  std::string rows = "INSERT INTO messages VALUES(1, 1, 1, randomblob(20000));";
  for (int i = 2; i < 100; ++i)
    rows += "INSERT INTO messages VALUES(" + std::to_string(i) + ", 1, " + std::to_string(i) + ", randomblob(100));";
  writeDatabase(folder / "bag.db3", std::string(kTopics) +
                                        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp "
                                        "INTEGER, data BLOB);" +
                                        rows);
  bendIntoACircle(folder / "bag.db3");

  const auto bag = openSqliteBag(folder / "bag.db3");
  std::size_t read = 0;
  for (BagMessage message; bag->next(message);) read += message.data.size();

  EXPECT_LE(read, 2 * std::filesystem::file_size(folder / "bag.db3"));
  EXPECT_THAT(bag->takeWarnings(), ElementsAre(HasSubstr("refer to each other in a circle")));
  BagMessage after;
  EXPECT_FALSE(bag->next(after));
}

TEST(SqliteBag, refusesWhatAFileWouldCompute)
{
  const TemporaryFolder folder;
  const std::vector<std::string> schemas{
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB AS "
      "(zeroblob(100000000)));INSERT INTO messages VALUES(1, 1, 1);",
      "CREATE VIEW messages AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT 1 AS topic_id, i "
      "AS timestamp, x'00' AS data FROM n;",
      "CREATE VIEW Messages AS SELECT 1 AS topic_id, 1 AS timestamp, x'00' AS data;",
      "CREATE VIRTUAL TABLE messages USING fts5(topic_id, timestamp, data);"};
  for (const std::string& schema : schemas)
  {
    std::filesystem::remove(folder / "bag.db3");
    writeDatabase(folder / "bag.db3", kTopics + schema);
    EXPECT_THAT([&] { openSqliteBag(folder / "bag.db3"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("'messages' is no plain table")));
  }
}

/** A recorder that lost power: most messages are in the log beside the file. */
TEST(SqliteBag, readsTheWriteAheadLogAndLeavesNothingBeside)
{
  const TemporaryFolder folder;
  sqlite3* recorder = nullptr;
  sqlite3_open((folder / "live.db3").c_str(), &recorder);
  const std::string messages =
      std::string("PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0;") + kTopics +
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);"
      "PRAGMA wal_checkpoint(TRUNCATE);"
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 300) "
      "INSERT INTO messages SELECT i, 1, i, zeroblob(1000) FROM n;";
  ASSERT_EQ(sqlite3_exec(recorder, messages.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  std::filesystem::create_directory(folder / "bag");
  std::filesystem::copy(folder / "live.db3", folder / "bag/live.db3");
  std::filesystem::copy(folder / "live.db3-wal", folder / "bag/live.db3-wal");
  sqlite3_close(recorder);
  {
    const auto bag = openSqliteBag(folder / "bag/live.db3");
    BagMessage message;
    int count = 0;
    while (bag->next(message)) ++count;
    EXPECT_EQ(count, 300);
    EXPECT_THAT(bag->takeWarnings(), IsEmpty());
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "bag/live.db3-shm"));
}

TEST(SqliteBag, readsASoundFileWithoutAWarning)
{
  const TemporaryFolder folder;
  writeDb3(folder / "bag.db3", {{"/imu", "sensor_msgs/msg/Imu", 1, "abcd"}});
  const auto bag = openSqliteBag(folder / "bag.db3");
  BagMessage message;
  ASSERT_TRUE(bag->next(message));
  EXPECT_EQ(message.data.size(), 4U);
  EXPECT_FALSE(bag->next(message));
  EXPECT_THAT(bag->takeWarnings(), IsEmpty());
}
}  // namespace
}  // namespace scanloom::sqlite_bag_unittest
