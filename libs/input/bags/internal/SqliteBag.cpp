#include "input/bags/internal/SqliteBag.h"

#include "input/bags/internal/SqliteDatabase.h"
#include "input/bags/internal/unpacked.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
std::string textOf(sqlite3_stmt* row, int column)
{
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(row, column))) : std::string();
}

class SqliteBag : public BagReader
{
 public:
  explicit SqliteBag(const std::filesystem::path& path) : path_(path), database_(path), unpacker_(database_.bytes())
  {
    for (const char* table : {"topics", "messages"}) requirePlainTable(table);
    readTopics();
    rows_ = database_.ask(question());
    if (database_.isCut()) warnings_.push_back(fmt::format("{}: the file is cut", path_.string()));
  }

  const std::vector<BagTopic>& topics() const override { return topics_; }

  bool next(BagMessage& message) override
  {
    while (rows_)
    {
      const int status = sqlite3_step(rows_.get());
      if (status != SQLITE_ROW)
      {
        end(status == SQLITE_DONE ? "" : database_.error());
        return false;
      }
      // A damaged tree of pages may lead in circles.
      constexpr std::uint64_t kLeastBytesOfARow = 4;
      bytes_read_ += static_cast<std::uint64_t>(sqlite3_column_bytes(rows_.get(), 2)) + kLeastBytesOfARow;
      if (bytes_read_ > 2 * database_.bytes())
      {
        end("its pages refer to each other in a circle");
        return false;
      }
      if (take(message)) return true;
    }
    return false;
  }

  std::vector<std::string> takeWarnings() override { return std::exchange(warnings_, {}); }

  double progress() const override
  {
    if (!rows_) return 1;
    return std::min(1.0, static_cast<double>(bytes_read_) / static_cast<double>(database_.bytes()));
  }

 private:
  /**
   * Throws std::runtime_error for a view, a virtual table or one with generated columns: what they give is computed by
   * expressions of the file, without a bound.
   */
  void requirePlainTable(const std::string& name) const
  {
    const auto found =
        database_.ask(fmt::format("SELECT 1 FROM pragma_table_list('{0}') WHERE type <> 'table' "
                                  "UNION ALL SELECT 1 FROM pragma_table_xinfo('{0}') WHERE hidden > 0",
                                  name));
    if (sqlite3_step(found.get()) == SQLITE_ROW)
      throw std::runtime_error(
          fmt::format("{}: '{}' is no plain table, so this is no bag of ROS 2", path_.string(), name));
  }

  void readTopics()
  {
    const SqliteDatabase::Rows rows = database_.ask("SELECT id, name, type, serialization_format FROM topics");
    int status = SQLITE_ROW;
    while ((status = sqlite3_step(rows.get())) == SQLITE_ROW)
    {
      const std::string format = textOf(rows.get(), 3);
      const bool is_cdr = format == "cdr" || format.empty();  // converters leave it out
      const Serialisation serialisation = is_cdr ? Serialisation::Cdr : Serialisation::Unknown;
      if (places_.emplace(sqlite3_column_int64(rows.get(), 0), topics_.size()).second)
        topics_.push_back(declaredTopic(textOf(rows.get(), 1), textOf(rows.get(), 2), serialisation));
    }
    if (status != SQLITE_DONE)
      warnings_.push_back(fmt::format("{}: its list of topics is damaged ({})", path_.string(), database_.error()));
  }

  /**
   * In order of time by its index; without one, sorting would copy the whole bag: then as they were written, which is
   * nearly in order of time. A cut file has lost its index.
   */
  std::string question() const
  {
    constexpr const char* kMessages = "SELECT topic_id, timestamp, data FROM messages ";
    const bool is_indexed =
        !database_.isCut() && database_.askIfPossible("SELECT 1 FROM messages INDEXED BY timestamp_idx LIMIT 1");
    return kMessages + std::string(is_indexed ? "INDEXED BY timestamp_idx ORDER BY timestamp" : "ORDER BY rowid");
  }

  /** False for a row of no topic. */
  bool take(BagMessage& message)
  {
    const auto place = places_.find(sqlite3_column_int64(rows_.get(), 0));
    const Bytes data(static_cast<const std::uint8_t*>(sqlite3_column_blob(rows_.get(), 2)),
                     static_cast<std::size_t>(sqlite3_column_bytes(rows_.get(), 2)));
    if (place == places_.end()) return false;
    message.topic = place->second;
    message.received = bagStamp(std::int64_t{sqlite3_column_int64(rows_.get(), 1)});
    message.data = data;
    if (isZstd(data)) message.data = unpackedData(data);
    return true;
  }

  Bytes unpackedData(Bytes data)
  {
    try
    {
      unpacked_ = unpacker_.unpackedMessage(data);
    }
    catch (const std::runtime_error&)  // a message that nobody can read: it is counted where it is needed
    {
      unpacked_.clear();
    }
    return unpacked_;
  }

  void end(const std::string& damage)
  {
    rows_.reset();
    if (!damage.empty())
      warnings_.push_back(
          fmt::format("{}: damaged after {} bytes of messages ({}); 'sqlite3 FILE .recover' may find more",
                      path_.string(), bytes_read_, damage));
  }

  std::filesystem::path path_;
  SqliteDatabase database_;
  std::vector<BagTopic> topics_;
  std::map<std::int64_t, std::size_t> places_;  // of topics, by their id
  SqliteDatabase::Rows rows_;                   // null after the last
  Unpacker unpacker_;
  std::vector<std::uint8_t> unpacked_;
  std::uint64_t bytes_read_ = 0;
  std::vector<std::string> warnings_;
};
}  // namespace

std::unique_ptr<BagReader> openSqliteBag(const std::filesystem::path& path)
{
  return std::make_unique<SqliteBag>(path);
}
}  // namespace scanloom
