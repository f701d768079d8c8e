/** Stems, stumps and branches that rays meet, found by Embree. */
#pragma once
#include "lab/simulation/internal/Cone.h"
#include "lab/simulation/internal/Trees.h"

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
 * The instruction set that Embree uses: AVX2, or SSE4.2 on machines without it. Embree only finds candidates; whether
 * and where they are hit is computed from the cones in double precision, so that both give the same hits.
 */
std::string embreeInstructionSet();

class Wood
{
 public:
  /** Throws std::runtime_error with what Embree says. */
  Wood(std::vector<Stem> stems, const std::vector<Cone>& stumps, const TreeOptions&,
       const std::string& instruction_set = embreeInstructionSet());

  const std::vector<Stem>& stems() const { return stems_; }

  /** Height in the world that no wood exceeds, m. */
  double highest() const { return highest_; }

  /** Pure; may be called from any thread. */
  std::optional<Hit> cast(const Ray&, double max_range) const;

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
    std::uint32_t geometry;  // in Embree's scene
    std::uint32_t index;     // number of the piece of a trunk, or of the branch among those of all stems
  };

  void growLooks(const TreeOptions&);
  std::optional<Candidate> nextCandidate(const Ray& from_origin, double nearest, double farthest) const;
  std::optional<Hit> hitOf(const Candidate&, const Ray&) const;

  std::vector<Stem> stems_;
  std::vector<Cone> trunks_;                          // stems, then stumps
  std::vector<std::uint32_t> trunk_of_piece_;         // of each piece that Embree has
  std::vector<std::vector<Cone>> looks_;              // branches of each look
  std::vector<std::uint32_t> look_of_;                // of each stem: index into looks_
  std::vector<std::uint32_t> first_branch_{0};        // of each stem, and the total at the end
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  // of Embree's coordinates, in the world
  double highest_ = 0;                                // m
  double margin_ = 0;                                 // m: Embree's cones are this much thicker
  Device device_;
  Scene scene_;
};
}  // namespace scanloom
