/** Stems, stumps and branches as solids that rays meet, by Embree. */
#pragma once
#include "simulation/Cone.h"
#include "simulation/Trees.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace scanloom
{
/**
 * Instruction set that Embree is pinned to, so that no other can change a hit: AVX2, and SSE4.2 on machines without it.
 * Embree finds candidates alone; which of them are hits, and where, is computed from the cones in double precision.
 */
std::string embreeInstructionSet();

class Wood
{
 public:
  /** Trees of the same look share the table of their branches, not Embree's copy. Throws std::runtime_error as Embree
   * says. */
  Wood(std::vector<Stem> stems, const std::vector<Cone>& stumps, const TreeOptions&,
       const std::string& instruction_set = embreeInstructionSet());

  const std::vector<Stem>& stems() const { return stems_; }

  /** Where they are in the world. */
  std::vector<Cone> branchesOf(std::uint32_t stem) const;

  /** Pure and safe to call from any thread. */
  std::optional<Hit> cast(const Ray&, double max_range) const;

  /** Embree's memory. */
  std::size_t embreeBytes() const { return static_cast<std::size_t>(*embree_bytes_); }

 private:
  struct Release
  {
    void operator()(RTCDeviceTy*) const;
    void operator()(RTCSceneTy*) const;
  };
  using Device = std::unique_ptr<RTCDeviceTy, Release>;
  using Scene = std::unique_ptr<RTCSceneTy, Release>;

  struct Candidate
  {
    double range;            // m, to the solid with its margin
    std::uint32_t geometry;  // of the scene
    std::uint32_t index;     // of the piece of a trunk, or of the branch among those of all stems
  };

  void growLooks(const TreeOptions&);
  std::optional<Candidate> nextCandidate(const Ray& from_origin, double nearest, double farthest) const;
  std::optional<Hit> hitOf(const Candidate&, const Ray&) const;

  std::vector<Stem> stems_;
  std::vector<Cone> trunks_;                          // stems, then stumps
  std::vector<std::uint32_t> trunk_of_piece_;         // Embree knows trunks in pieces
  std::vector<std::vector<Cone>> looks_;              // branches of a tree
  std::vector<std::uint32_t> look_of_;                // of each stem: into looks_
  std::vector<std::uint32_t> first_branch_{0};        // of each stem, and one more for the end
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  // of Embree's coordinates, in the world
  double margin_ = 0;                                 // m, by which Embree's cones are thicker
  std::unique_ptr<std::atomic<std::int64_t>> embree_bytes_ = std::make_unique<std::atomic<std::int64_t>>(0);
  Device device_;
  Scene scene_;
};
}  // namespace scanloom
