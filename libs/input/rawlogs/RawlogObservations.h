#pragma once
#include "input/rawlogs/CountedArchive.h"

#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <deque>
#include <filesystem>
#include <string>

namespace scanloom
{
/**
 * The observations of a rawlog in the file's order: the objects of the observation format, or the contents of the
 * frames in the action/frame format. Reading ends where the file is damaged, cut, or has an object of an unknown class
 * or with more items than the file can hold, or is a map; damage() then says why.
 */
class RawlogObservations
{
 public:
  /** Throws std::runtime_error with the file's name if it can't be opened. */
  explicit RawlogObservations(const std::filesystem::path& path) : archive_(path) {}

  /** Null at the end. */
  mrpt::obs::CObservation::Ptr next();

  /** Empty if there is none so far. */
  const std::string& damage() const { return damage_; }

  /** Ends reading for a reason that only the one who uses the observations sees; damage() then says it. */
  void endBecause(const std::string& why);

  /** Compressed bytes. */
  std::uint64_t bytesRead() const { return archive_.bytesRead(); }

  /** Objects that are no observations: actions, maps. */
  std::uint64_t passedOver() const { return passed_over_; }

 private:
  void readObject();
  void takeFrame(const mrpt::obs::CSensoryFrame&);

  CountedArchive archive_;
  std::deque<mrpt::obs::CObservation::Ptr> waiting_;
  std::size_t objects_ = 0;
  std::uint64_t passed_over_ = 0;
  bool ended_ = false;
  std::string damage_;
};
}  // namespace scanloom
