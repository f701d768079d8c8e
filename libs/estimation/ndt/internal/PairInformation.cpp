#include "estimation/ndt/internal/PairInformation.h"

#include "estimation/ndt/internal/PairLanes.h"

namespace scanloom
{
namespace
{
SCANLOOM_INLINE void loadAll(const SymmetricBlock& from, SymmetricLanes& lanes)
{
  load(from.xx, lanes.xx), load(from.xy, lanes.xy), load(from.xz, lanes.xz);
  load(from.yy, lanes.yy), load(from.yz, lanes.yz), load(from.zz, lanes.zz);
}

SCANLOOM_INLINE void addTimes(const Lanes& w, const SymmetricLanes& m, SymmetricLanes& sum)
{
  sum.xx += w * m.xx, sum.xy += w * m.xy, sum.xz += w * m.xz;
  sum.yy += w * m.yy, sum.yz += w * m.yz, sum.zz += w * m.zz;
}

SCANLOOM_INLINE void totals(const SymmetricLanes& sum, Symmetric3& result)
{
  result = {total(sum.xx), total(sum.xy), total(sum.xz), total(sum.yy), total(sum.yz), total(sum.zz)};
}

SCANLOOM_INLINE void gatherOf(const TurnedCell& cell, const BlockRange& range, const TargetBlock* blocks,
                              const SymmetricBlock* structures, double d2, PairInformation& evidence)
{
  Lanes fx{}, fy{}, fz{};
  SymmetricLanes weight{}, structured{}, pull{};
  for (std::uint32_t i = range.first; i != range.first + range.count; ++i)
  {
    PairTerms t;
    termsOf(cell, blocks[i], d2, t);
    const Lanes w = d2 * t.e;
    fx += w * t.ux, fy += w * t.uy, fz += w * t.uz;
    addTimes(w, t.b, weight);

    SymmetricLanes thin, resisting;
    loadAll(structures[i], thin);
    sandwich(thin, t.b, resisting);
    addTimes(w, resisting, structured);

    const Lanes x = d2 * t.ux, y = d2 * t.uy, z = d2 * t.uz;
    const SymmetricLanes bent{t.b.xx - x * t.ux, t.b.xy - x * t.uy, t.b.xz - x * t.uz,
                              t.b.yy - y * t.uy, t.b.yz - y * t.uz, t.b.zz - z * t.uz};
    addTimes(w, bent, pull);
  }
  evidence.fx = total(fx), evidence.fy = total(fy), evidence.fz = total(fz);
  totals(weight, evidence.weight);
  totals(structured, evidence.structured);
  totals(pull, evidence.pull);
}

SCANLOOM_INLINE void gatherAll(const PairBatch& batch, const SymmetricBlock* structures, double d2,
                               PairInformation* evidence)
{
  for (std::size_t i = 0; i < batch.count; ++i)
    gatherOf(batch.cells[i], batch.ranges[i], batch.blocks, structures, d2, evidence[i]);
}

void gatherPortable(const PairBatch& batch, const SymmetricBlock* structures, double d2, PairInformation* evidence)
{
  gatherAll(batch, structures, d2, evidence);
}

SCANLOOM_AVX2 void gatherAvx2(const PairBatch& batch, const SymmetricBlock* structures, double d2,
                              PairInformation* evidence)
{
  gatherAll(batch, structures, d2, evidence);
}

SCANLOOM_AVX512 void gatherAvx512(const PairBatch& batch, const SymmetricBlock* structures, double d2,
                                  PairInformation* evidence)
{
  gatherAll(batch, structures, d2, evidence);
}
}  // namespace

void gatherEvidence(const PairBatch& batch, const SymmetricBlock* structures, double d2, PairInformation* evidence,
                    Kernel kernel)
{
  switch (kernel)
  {
    case Kernel::Portable:
      return gatherPortable(batch, structures, d2, evidence);
    case Kernel::Avx2:
      return gatherAvx2(batch, structures, d2, evidence);
    case Kernel::Avx512:
      return gatherAvx512(batch, structures, d2, evidence);
  }
}
}  // namespace scanloom
