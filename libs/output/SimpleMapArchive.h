/**
 * A .simplemap on its way into MRPT, which reserves memory for whatever count it reads: a flipped bit in a file of 2 kB
 * can be 60 GB. What the rest of the file cannot hold is refused before MRPT acts on it.
 */
#pragma once
#include "mrpt_bridge/GzipArchive.h"

#include <cstdint>
#include <string>

namespace scanloom
{
/** A class that begins with how many items it holds. */
struct CountedClass
{
  const char* name;
  std::uint64_t least_bytes;  // of an item in the file
};

class SimpleMapArchive : public mrpt::serialization::CArchive
{
 public:
  /** Throws std::runtime_error with the file's name if it cannot be opened, is cut short or its checksum is wrong. */
  explicit SimpleMapArchive(const std::filesystem::path&);

  /** Why it would not read on; empty if it would. MRPT wraps what it catches into its call stack. */
  const std::string& refused() const { return refused_; }

 protected:
  /** All of them, or std::runtime_error. */
  std::size_t read(void* bytes, std::size_t count) override;
  [[noreturn]] std::size_t write(const void* bytes, std::size_t count) override;

 private:
  enum class Next
  {
    Anything,
    Version,
    Id,  // of a CSensoryFrame before its version 2
    Count,
    Text,  // of a CObservationPointCloud: not a count, though it may have 4 letters
  };

  void follow(const char* bytes, std::size_t count);
  void followVersion(char version);
  void requireFits(std::uint64_t items);
  [[noreturn]] void refuse(const std::string& why);

  GzipArchive file_;
  std::uint64_t left_;  // uncompressed bytes
  const CountedClass* class_ = nullptr;
  Next next_ = Next::Anything;
  std::string refused_;
};
}  // namespace scanloom
