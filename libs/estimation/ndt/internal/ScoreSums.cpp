#include "estimation/ndt/internal/ScoreSums.h"

#include "estimation/ndt/internal/PairLanes.h"

namespace scanloom
{
namespace
{
SCANLOOM_INLINE ScoreSums sumCell(const TurnedCell& s, const TargetBlock* block, std::uint32_t count, double d2)
{
  Lanes score{}, best{}, fx{}, fy{}, fz{}, wxx{}, wxy{}, wxz{}, wyy{}, wyz{}, wzz{};
  for (const TargetBlock* end = block + count; block != end; ++block)
  {
    const PairTerms t = termsOf(s, *block, d2);
    const Lanes w = d2 * t.e;
    score += t.e;
    best = t.e > best ? t.e : best;
    fx += w * t.ux, fy += w * t.uy, fz += w * t.uz;
    wxx += w * t.b.xx, wxy += w * t.b.xy, wxz += w * t.b.xz;
    wyy += w * t.b.yy, wyz += w * t.b.yz, wzz += w * t.b.zz;
  }
  double most = 0;
  for (std::size_t i = 0; i < TargetBlock::kLanes; ++i) most = best[i] > most ? best[i] : most;
  return {total(score), most,       total(fx),  total(fy),  total(fz), total(wxx),
          total(wxy),   total(wxz), total(wyy), total(wyz), total(wzz)};
}

SCANLOOM_INLINE void sumAll(const PairBatch& batch, double d2, ScoreSums* sums)
{
  for (std::size_t i = 0; i < batch.count; ++i)
    sums[i] = sumCell(batch.cells[i], batch.blocks + batch.ranges[i].first, batch.ranges[i].count, d2);
}

void sumPortable(const PairBatch& batch, double d2, ScoreSums* sums) { sumAll(batch, d2, sums); }

SCANLOOM_AVX2 void sumAvx2(const PairBatch& batch, double d2, ScoreSums* sums) { sumAll(batch, d2, sums); }

SCANLOOM_AVX512 void sumAvx512(const PairBatch& batch, double d2, ScoreSums* sums) { sumAll(batch, d2, sums); }
}  // namespace

void sumPairs(const PairBatch& batch, double d2, ScoreSums* sums, Kernel kernel)
{
  switch (kernel)
  {
    case Kernel::Portable:
      return sumPortable(batch, d2, sums);
    case Kernel::Avx2:
      return sumAvx2(batch, d2, sums);
    case Kernel::Avx512:
      return sumAvx512(batch, d2, sums);
  }
}
}  // namespace scanloom
