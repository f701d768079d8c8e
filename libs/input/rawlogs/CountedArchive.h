/**
 * Reads objects of a plain, gzip or zstd file for MRPT and refuses counts of items that cannot fit into the rest of the
 * file. MRPT itself reserves memory for any count that it reads: a flipped bit in a file of 2 kB can ask for 60 GB.
 * Counts are known in the classes of kCountedClasses; objects of other classes are read as MRPT reads them. Also
 * refuses actions that MRPT would crash on: of another class, without a pose, or of billions of particles.
 */
#pragma once
#include "base/formats/CompressedFile.h"

#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
/**
 * A class that stores numbers of items. Its first number of four bytes is a count, which `arrays` reads of items
 * follow; `more` such numbers behind them are counts, too, each with one read of items.
 */
struct CountedClass
{
  const char* name;
  std::uint64_t least_bytes;  // of an item in the file; 0: a part of other classes, without counts
  int arrays = 0, more = 0;
  unsigned least_version = 0;      // older ones have their counts elsewhere
  std::uint64_t second_bytes = 0;  // of an item of the second count, if those are larger than a float
};

/**
 * One half of the members is the file: what is unpacked ahead, and how large the object has become. The other half is
 * the place in the nested objects of MRPT: the class that is being read, and what its next number means.
 */
class CountedArchive : public mrpt::serialization::CArchive
{
 public:
  /** Throws std::runtime_error with the file's name if it cannot be opened. */
  explicit CountedArchive(const std::filesystem::path&);

  /** To be called between objects. Throws as CompressedFile::atEnd(). */
  bool atEnd();

  /** Compressed bytes, for a progress bar; ahead of the objects. */
  std::uint64_t bytesRead() const { return file_.bytesRead(); }

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
    Movement,
    NoLists,  // a number of lists, of which there must be none
    Fields,   // a number of fields of a CGenericPointsMap, or its options
    Items,    // of array after array: no count, although they may be 4 bytes
    Images,   // of a CObservationRotatingScan, and names
  };

  void follow(const char* bytes, std::size_t count);
  void followObjects(const char* bytes, std::size_t count);
  void begin(const CountedClass&);
  void beginVelocity();
  void followVersion(unsigned version);
  void followCount(std::uint32_t items);
  void followFields(const char* bytes, std::size_t count);
  void followLists(const char* bytes, std::size_t count);
  void followMovement(const char* bytes, std::size_t count);
  void followImages(const char* bytes, std::size_t count);
  int countsPerField() const;
  Next afterItems();
  void requireToFollow(std::uint64_t items, const char* what, std::uint64_t least_bytes = 1);
  bool follows(std::uint64_t bytes);
  [[noreturn]] void refuseLargeObject();
  [[noreturn]] void refuse(const std::string& why);

  CompressedFile file_;
  std::uint64_t largest_object_;  // uncompressed bytes
  std::uint64_t object_ = 0;      // bytes of the object that is being read
  std::vector<char> ahead_;       // unpacked to see whether so many bytes follow
  std::size_t ahead_taken_ = 0;   // bytes of ahead_ that were read
  std::string refused_;

  const CountedClass* class_ = nullptr;
  Next next_ = Next::Anything;
  int arrays_ = 0, more_ = 0;           // that are still to come
  std::vector<std::string> within_;     // names of the objects that are being read, the outermost first
  std::size_t name_length_ = 0;         // of a name that may come next
  std::vector<std::uint32_t> numbers_;  // of a CActionRobotMovement2D so far, or sizes of a CObservationRotatingScan
  unsigned version_ = 0;                // of class_
  std::uint32_t points_ = 0;            // of a CGenericPointsMap
  int field_types_ = 0;                 // of a CGenericPointsMap: lists of fields, one for each type, that have begun
  bool has_velocities_ = false;         // the CSimpleMap's keyframes end with one
  const CountedClass* part_ = nullptr;  // whose version comes, within class_
};
}  // namespace scanloom
