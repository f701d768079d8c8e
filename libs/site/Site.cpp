#include "site/Site.h"

#include "base/positions/Alignment.h"
#include "estimation/ndt/FittedConstants.h"
#include "site/internal/LoopFinder.h"
#include "site/internal/LoopSearch.h"
#include "site/internal/agreeingPairs.h"
#include "site/internal/referencePositions.h"
#include "site/internal/siteGraph.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
constexpr int kMostSweeps = 3;  // what a sweep has found tells the next one where to search

/** Brings the drives together, part by part. */
class SiteBuilder
{
 public:
  SiteBuilder(const std::vector<SiteDrive>& drives, const SlamSettings& settings, const SiteProgress& progress)
    : drives_(drives), layout_(drives), search_(drives, layout_, settings), progress_(progress)
  {
    for (std::size_t i = 0; i < layout_.size(); ++i)
    {
      const std::size_t drive = layout_.driveOf(i), index = layout_.indexOf(i);
      measured_.keyframes.push_back({drive, index, drives[drive].keyframes()[index].drive_T_body});
    }
    for (std::size_t part = 0; part < layout_.parts().size(); ++part) piece_of_part_.push_back(part);
  }

  std::size_t parts() const { return layout_.parts().size(); }

  /** Parts come in their order. */
  void addPart(std::size_t part)
  {
    ++parts_;
    joinPieces(part);
    closeLoops(part);
  }

  /** Pieces with enough positions come into the frame of the references, and hang together by it. */
  void addReferences(const std::vector<Reference>& references)
  {
    for (const Reference& reference : references)
      for (ReferencePosition& position : referencePositions(reference, drives_, layout_))
        measured_.references.push_back(std::move(position));
    std::optional<std::size_t> referenced;
    for (std::size_t piece = 0; piece < parts_; ++piece)
    {
      if (!moveIntoReferenceFrame(piece)) continue;
      if (!referenced) referenced = piece;
      unite(piece, *referenced);
    }
    if (!referenced) return;
    referenced_ = referenced;
    solve(*referenced);
    for (const ReferencePosition& position : measured_.references)
      if (position.used) known_.push_back({position.keyframe, fitted::kSamePlace});
    for (std::size_t part = 0; part < parts_; ++part)
      if (piece_of_part_[part] == *referenced) closeLoops(part);
  }

  Site made() &&
  {
    std::vector<SitePiece> all = pieces();
    for (const SitePiece& piece : all)
      measured_.keyframes = withCovariances(measured_, piece.keyframes, drives_, layout_);
    return {std::move(measured_.keyframes), std::move(measured_.loops), std::move(measured_.references),
            std::move(all)};
  }

 private:
  std::vector<std::size_t> keyframesOf(std::size_t piece) const
  {
    std::vector<std::size_t> found;
    for (std::size_t part = 0; part < parts_; ++part)
      if (piece_of_part_[part] == piece)
        for (std::size_t i = layout_.parts()[part].begin; i < layout_.parts()[part].end; ++i) found.push_back(i);
    return found;
  }

  void move(std::size_t piece, const Rigid& site_T_piece)
  {
    for (const std::size_t i : keyframesOf(piece))
      measured_.keyframes[i].site_T_body = site_T_piece * measured_.keyframes[i].site_T_body;
  }

  void unite(std::size_t piece, std::size_t other)
  {
    std::replace(piece_of_part_.begin(), piece_of_part_.end(), piece, other);
  }

  /** Searches the part in each piece of earlier ones. Pieces in which it is found hang together. */
  void joinPieces(std::size_t part)
  {
    for (std::size_t piece = 0; piece < part; ++piece)
    {
      const std::vector<std::size_t> others = keyframesOf(piece);
      if (others.empty() || piece_of_part_[part] == piece) continue;
      showDone(layout_.parts()[part].begin);
      const std::size_t own = piece_of_part_[part];
      const auto found = search_.findAnywhere(measured_.keyframes, others, keyframesOf(own));
      if (!found) continue;
      move(own, found->site_T_body * measured_.keyframes[found->keyframe].site_T_body.inverse());
      unite(own, piece);
      known_.push_back({found->keyframe, fitted::kSamePlace});
    }
  }

  void showDone(std::size_t keyframe) const
  {
    progress_(static_cast<double>(keyframe) / static_cast<double>(layout_.size()));
  }

  /** Finds what loops the part has with its piece, and solves the piece, until nothing new is found. */
  void closeLoops(std::size_t part)
  {
    for (int sweep = 0; sweep < kMostSweeps; ++sweep)
    {
      const std::size_t before = accepted();
      for (std::size_t about = 0; about < parts_; ++about)
        if (piece_of_part_[about] == piece_of_part_[part])
          measured_.loops =
              withLoopsFound({measured_.keyframes, measured_.loops, known_}, layout_, search_, std::max(part, about),
                             std::min(part, about), [&](std::size_t keyframe) { showDone(keyframe); });
      measured_.loops = withoutLoneOnes(std::move(measured_.loops), measured_.keyframes, layout_);
      if (sweep > 0 && accepted() == before) return;
      solve(piece_of_part_[part]);
    }
  }

  std::size_t accepted() const
  {
    return static_cast<std::size_t>(std::count_if(measured_.loops.begin(), measured_.loops.end(),
                                                  [](const Loop& loop)
                                                  { return loop.decision == LoopDecision::Accepted; }));
  }

  void solve(std::size_t piece) { measured_ = solvedPiece(std::move(measured_), keyframesOf(piece), drives_, layout_); }

  /** By the positions during it, of which some may be wrong. @return whether enough of them agree. */
  bool moveIntoReferenceFrame(std::size_t piece)
  {
    const std::vector<std::size_t> keyframes = keyframesOf(piece);
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < measured_.references.size(); ++i)
      if (std::binary_search(keyframes.begin(), keyframes.end(), measured_.references[i].keyframe))
        positions.push_back(i);
    const std::vector<PositionPair> pairs = pairsOf(positions);
    double largest_sigma = 0;
    for (const std::size_t i : positions) largest_sigma = std::max(largest_sigma, measured_.references[i].sigma);
    std::vector<PositionPair> agreeing;
    for (const std::size_t k : agreeingPairs(pairs, largest_sigma))
    {
      agreeing.push_back(pairs[k]);
      measured_.references[positions[k]].used = true;
    }
    if (agreeing.empty()) return false;
    move(piece, align(agreeing, AlignmentKind::Yaw).reference_T_map);
    return true;
  }

  std::vector<PositionPair> pairsOf(const std::vector<std::size_t>& positions) const
  {
    std::vector<PositionPair> pairs;
    for (const std::size_t i : positions)
    {
      const ReferencePosition& position = measured_.references[i];
      pairs.push_back({position.stamp, measured_.keyframes[position.keyframe].site_T_body * position.keyframe_p_point,
                       position.measured});
    }
    return pairs;
  }

  bool usesReferences() const
  {
    return std::any_of(measured_.references.begin(), measured_.references.end(),
                       [](const ReferencePosition& position) { return position.used; });
  }

  std::vector<SitePiece> pieces() const
  {
    std::vector<SitePiece> pieces;
    for (std::size_t piece = 0; piece < parts_; ++piece)
      if (std::vector<std::size_t> keyframes = keyframesOf(piece); !keyframes.empty())
        pieces.push_back({std::move(keyframes), referenced_ == piece && usesReferences()});
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const SitePiece& a, const SitePiece& b) { return a.keyframes.size() > b.keyframes.size(); });
    return pieces;
  }

  const std::vector<SiteDrive>& drives_;
  SiteLayout layout_;
  LoopSearch search_;
  const SiteProgress& progress_;
  SiteMeasurements measured_;
  std::vector<KnownKeyframe> known_;
  std::size_t parts_ = 0;                   // that were added
  std::vector<std::size_t> piece_of_part_;  // a piece has the number of its first part
  std::optional<std::size_t> referenced_;   // the piece in the references' frame
};
}  // namespace

std::string toString(LoopDecision decision)
{
  switch (decision)
  {
    case LoopDecision::Accepted:
      return "accepted";
    case LoopDecision::NotFound:
      return "not found";
    case LoopDecision::LookAlike:
      return "look alike";
    case LoopDecision::Alone:
      return "alone";
    case LoopDecision::Contradicts:
      break;
  }
  return "contradicts";
}

Site madeOf(const std::vector<SiteDrive>& drives, const SlamSettings& settings,
            const std::vector<Reference>& references, const SiteProgress& progress)
{
  SiteBuilder builder(drives, settings, progress);
  if (builder.parts() == 0) throw std::invalid_argument("a site without a keyframe");
  for (std::size_t part = 0; part < builder.parts(); ++part) builder.addPart(part);
  builder.addReferences(references);
  return std::move(builder).made();
}
}  // namespace scanloom
