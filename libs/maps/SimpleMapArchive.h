/**
 * Reads a .simplemap for MRPT and refuses counts of items that cannot fit into the rest of the file. MRPT itself
 * reserves memory for any count that it reads: a flipped bit in a file of 2 kB can ask for 60 GB.
 */
#pragma once
#include "mrpt_bridge/GzipArchive.h"

#include <cstdint>
#include <string>

namespace scanloom
{
/** A class whose first data are the number of its items. */
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

  /** Why reading was refused; empty if it was not. (MRPT adds a call stack to the exception's text.) */
  const std::string& refused() const { return refused_; }

 protected:
  /** Reads all `count` bytes, or throws std::runtime_error. */
  std::size_t read(void* bytes, std::size_t count) override;
  [[noreturn]] std::size_t write(const void* bytes, std::size_t count) override;

 private:
  enum class Next
  {
    Anything,
    Version,
    Id,  // of a CSensoryFrame before its version 2
    Count,
    Text,  // of a CObservationPointCloud: no count, although it may have 4 letters
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
