/** New files whose names may be taken: nothing that has a name is overwritten, and no link is followed. */
#pragma once
#include <filesystem>
#include <functional>

namespace scanloom
{
/** The output of a run that came to its end, or of one that was stopped before. */
enum class Completeness
{
  Whole,
  Partial,
};

/** Whether something has this name, also a link that leads nowhere. */
bool isTaken(const std::filesystem::path&);

/** The first of numbered(1), numbered(2), ... that nothing has. */
std::filesystem::path freeName(const std::function<std::filesystem::path(int)>& numbered);

/** `map.partial.bt` for `map.bt` and "partial"; `map.partial-2.bt` if that is taken. */
std::filesystem::path freeNameBeside(const std::filesystem::path& file, const std::string& mark);

/** Creates the file, open for writing. @return its descriptor; -1 with errno, which is EEXIST if the name is taken. */
int createNew(const std::filesystem::path&);

/** Passes the file to the disk: a power cut after a rename could else leave an empty file. Throws std::system_error. */
void flushToDisk(const std::filesystem::path&);

/** Where a partial file is put that may not replace `file`: `map.partial.bt`. */
std::filesystem::path partialNameBeside(const std::filesystem::path& file);
}  // namespace scanloom
