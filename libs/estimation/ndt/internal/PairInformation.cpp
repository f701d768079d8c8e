#include "estimation/ndt/internal/PairInformation.h"

#include "estimation/ndt/internal/PairLanes.h"

namespace scanloom
{
namespace
{
SCANLOOM_INLINE SymmetricLanes loadAll(const SymmetricBlock& from)
{
  return {load(from.xx), load(from.xy), load(from.xz), load(from.yy), load(from.yz), load(from.zz)};
}

SCANLOOM_INLINE SymmetricLanes sumWith(const SymmetricLanes& sum, const Lanes& w, const SymmetricLanes& m)
{
  return {sum.xx + w * m.xx, sum.xy + w * m.xy, sum.xz + w * m.xz,
          sum.yy + w * m.yy, sum.yz + w * m.yz, sum.zz + w * m.zz};
}

SCANLOOM_INLINE Symmetric3 totals(const SymmetricLanes& sum)
{
  return {total(sum.xx), total(sum.xy), total(sum.xz), total(sum.yy), total(sum.yz), total(sum.zz)};
}

SCANLOOM_INLINE PairInformation gatherOf(const TurnedCell& cell, const BlockRange& range, const TargetBlock* blocks,
                                         const SymmetricBlock* structures, double d2)
{
  Lanes fx{}, fy{}, fz{};
  SymmetricLanes weight{}, structured{}, pull{};
  for (std::uint32_t i = range.first; i != range.first + range.count; ++i)
  {
    const PairTerms t = termsOf(cell, blocks[i], d2);
    const Lanes w = d2 * t.e;
    fx += w * t.ux, fy += w * t.uy, fz += w * t.uz;
    weight = sumWith(weight, w, t.b);
    structured = sumWith(structured, w, sandwich(loadAll(structures[i]), t.b));

    const Lanes x = d2 * t.ux, y = d2 * t.uy, z = d2 * t.uz;
    const SymmetricLanes bent{t.b.xx - x * t.ux, t.b.xy - x * t.uy, t.b.xz - x * t.uz,
                              t.b.yy - y * t.uy, t.b.yz - y * t.uz, t.b.zz - z * t.uz};
    pull = sumWith(pull, w, bent);
  }
  return {total(fx), total(fy), total(fz), totals(weight), totals(structured), totals(pull)};
}

SCANLOOM_INLINE void gatherAll(const PairBatch& batch, const SymmetricBlock* structures, double d2,
                               PairInformation* pairs)
{
  for (std::size_t i = 0; i < batch.count; ++i)
    pairs[i] = gatherOf(batch.cells[i], batch.ranges[i], batch.blocks, structures, d2);
}

void gatherPortable(const PairBatch& batch, const SymmetricBlock* structures, double d2, PairInformation* pairs)
{
  gatherAll(batch, structures, d2, pairs);
}

SCANLOOM_AVX2 void gatherAvx2(const PairBatch& batch, const SymmetricBlock* structures, double d2,
                              PairInformation* pairs)
{
  gatherAll(batch, structures, d2, pairs);
}

SCANLOOM_AVX512 void gatherAvx512(const PairBatch& batch, const SymmetricBlock* structures, double d2,
                                  PairInformation* pairs)
{
  gatherAll(batch, structures, d2, pairs);
}
}  // namespace

void gatherPairs(const PairBatch& batch, const SymmetricBlock* structures, double d2, PairInformation* pairs,
                 Kernel kernel)
{
  switch (kernel)
  {
    case Kernel::Portable:
      return gatherPortable(batch, structures, d2, pairs);
    case Kernel::Avx2:
      return gatherAvx2(batch, structures, d2, pairs);
    case Kernel::Avx512:
      return gatherAvx512(batch, structures, d2, pairs);
  }
}
}  // namespace scanloom
