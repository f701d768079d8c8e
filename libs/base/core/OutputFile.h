/** Files that get their name only when they are complete. */
#pragma once
#include "base/core/NewFile.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <iosfwd>
#include <list>
#include <vector>

namespace scanloom
{
/** What becomes of a file that is not committed. */
enum class Uncommitted
{
  IsRemoved,
  Stays,  // as `<file>.part`: its beginning is worth keeping if the program dies after hours
};

/**
 * A new file under another name in the same folder, with the same extension unless it is to stay (some writers choose
 * their format by it). commit() gives it its name. It is written by stream(), or by others at temporary().
 */
class OutputFile
{
 public:
  /**
   * Creates the file. What has the name `<file>.part` already, from a run that died, is first given another name,
   * `<file>.part.1`. Throws std::runtime_error with path and reason if the folder is missing or cannot be written, and
   * if another program is writing `<file>.part`.
   */
  explicit OutputFile(std::filesystem::path file, Uncommitted = Uncommitted::IsRemoved);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /** The name that it gets. */
  const std::filesystem::path& name() const { return file_; }

  const std::filesystem::path& temporary() const { return temporary_; }

  /** Where the `.part` of an earlier run is now; empty: there was none. */
  const std::filesystem::path& earlier() const { return earlier_; }

  /** A descriptor to write to, which the caller closes; of a file that stays. */
  int descriptor() const;

  /** Opened by the first call. */
  std::ostream& stream();

  /** Throws std::runtime_error if not all bytes of the stream could be written: a full disk is noticed at once. */
  void flush();

  /**
   * Replaces an existing file of the name; a partial file is put beside it instead, `map.partial.bt`. Other writers
   * than the stream must have closed the file. @return the name that the file has now. Throws std::runtime_error.
   */
  std::filesystem::path commit(Completeness = Completeness::Whole);

  /** Puts the file beside the one of its name, whether there is one or not. */
  std::filesystem::path commitBeside();

  /** Reads the first file and writes the second. */
  using Convert = std::function<void(const std::filesystem::path& written, const std::filesystem::path& converted)>;

  /** As commit(), but what `convert` makes of the file gets the name. Throws what `convert` throws, too. */
  void commitConverted(const Convert& convert);

  /** The same for a text that could not be written to its end: with the whole lines that it has. */
  void commitLines();

 private:
  std::filesystem::path commitAs(const std::filesystem::path& name);
  void closeStream();
  void requireWritten() const;

  std::filesystem::path file_, temporary_, earlier_;
  int locked_ = -1;  // the open file that stays: other programs see that it is being written
  std::ofstream stream_;
  bool removed_at_end_;
};

/** Files of one run get their names together: if one partial file would replace another, all of them are put beside. */
std::vector<std::filesystem::path> commitTogether(std::list<OutputFile>&, Completeness);

/** Writes a whole file by `write`. Throws std::runtime_error if the disk is full, and what `write` throws. */
void writeAtomically(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/** To be called before the work begins. Throws UsageError that names all files that exist, unless `overwrite`. */
void refuseExisting(const std::vector<std::filesystem::path>& files, bool overwrite);

/** To be called before any file is opened. Throws UsageError if an output is, by whatever name, one of the inputs. */
void refuseInputsAsOutputs(const std::vector<std::filesystem::path>& inputs,
                           const std::vector<std::filesystem::path>& outputs);
}  // namespace scanloom
