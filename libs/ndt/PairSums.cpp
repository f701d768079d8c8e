#include "ndt/PairSums.h"

#include <cstring>

#define INLINE [[gnu::always_inline]] inline

namespace scanloom
{
namespace
{
// Vectors of the compiler's: the same operations in the same order whatever registers a machine has for them.
using Lanes = double __attribute__((vector_size(8 * TargetBlock::kLanes)));
using Whole = std::int64_t __attribute__((vector_size(8 * TargetBlock::kLanes)));

INLINE void load(const double* from, Lanes& lanes) { std::memcpy(&lanes, from, sizeof lanes); }

/** exp(-h) for h from 0 to 690, to 1e-15: 2^-n exp(r) with |r| <= ln 2 / 2, by Taylor's series. */
INLINE void expOfMinus(const Lanes& h, Lanes& result)
{
  constexpr double kRound = 0x1.8p52;  // added and taken away again, it leaves a whole number
  constexpr double kLog2E = 1.4426950408889634, kLn2High = 0x1.62e42fefa3800p-1, kLn2Low = 0x1.ef35793c76730p-45;
  const Lanes shifted = h * kLog2E + kRound;
  const Lanes n = shifted - kRound;
  const Lanes r = (n * kLn2High - h) + n * kLn2Low;
  Lanes sum = 1 + r * (1.0 / 13);
  for (int k = 12; k >= 1; --k) sum = 1 + r * (1.0 / k) * sum;

  Whole bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  constexpr std::int64_t kBitsOfRound = 0x4338000000000000, kExponentBias = 1023;
  bits = (kExponentBias - (bits - kBitsOfRound)) << 52;
  Lanes power;
  std::memcpy(&power, &bits, sizeof power);
  result = sum * power;
}

/** In a fixed tree. */
INLINE double total(const Lanes& v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

INLINE void sumCell(const TurnedCell& s, const TargetBlock* block, std::uint32_t count, double d2, PairSums& sums)
{
  Lanes score{}, best{}, fx{}, fy{}, fz{}, wxx{}, wxy{}, wxz{}, wyy{}, wyz{}, wzz{};
  for (const TargetBlock* end = block + count; block != end; ++block)
  {
    Lanes x, y, z, xx, xy, xz, yy, yz, zz;
    load(block->x, x), load(block->y, y), load(block->z, z);
    load(block->xx, xx), load(block->xy, xy), load(block->xz, xz);
    load(block->yy, yy), load(block->yz, yz), load(block->zz, zz);
    x = s.x - x, y = s.y - y, z = s.z - z;
    xx = s.xx + xx, xy = s.xy + xy, xz = s.xz + xz, yy = s.yy + yy, yz = s.yz + yz, zz = s.zz + zz;

    // The inverse of a symmetric 3x3 by its cofactors.
    const Lanes cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
    const Lanes inverse = 1 / (xx * cxx + xy * cxy + xz * cxz);
    const Lanes bxx = inverse * cxx, bxy = inverse * cxy, bxz = inverse * cxz;
    const Lanes byy = inverse * (xx * zz - xz * xz), byz = inverse * (xy * xz - xx * yz),
                bzz = inverse * (xx * yy - xy * xy);
    const Lanes ux = bxx * x + bxy * y + bxz * z, uy = bxy * x + byy * y + byz * z, uz = bxz * x + byz * y + bzz * z;

    constexpr double kNothing = 690;  // exp(-690) is still normal
    Lanes h = (d2 / 2) * (x * ux + y * uy + z * uz);
    h = h < kNothing ? h : Lanes{} + kNothing;
    Lanes e;
    expOfMinus(h, e);
    const Lanes w = d2 * e;
    score += e;
    best = e > best ? e : best;
    fx += w * ux, fy += w * uy, fz += w * uz;
    wxx += w * bxx, wxy += w * bxy, wxz += w * bxz, wyy += w * byy, wyz += w * byz, wzz += w * bzz;
  }
  double most = 0;
  for (std::size_t i = 0; i < TargetBlock::kLanes; ++i) most = best[i] > most ? best[i] : most;
  sums = {total(score), most,       total(fx),  total(fy),  total(fz), total(wxx),
          total(wxy),   total(wxz), total(wyy), total(wyz), total(wzz)};
}

INLINE void sumAll(const TurnedCell* cells, const BlockRange* ranges, std::size_t count, const TargetBlock* blocks,
                   double d2, PairSums* sums)
{
  for (std::size_t i = 0; i < count; ++i) sumCell(cells[i], blocks + ranges[i].first, ranges[i].count, d2, sums[i]);
}

void sumPortable(const TurnedCell* cells, const BlockRange* ranges, std::size_t count, const TargetBlock* blocks,
                 double d2, PairSums* sums)
{
  sumAll(cells, ranges, count, blocks, d2, sums);
}

[[gnu::target("avx2")]] void sumAvx2(const TurnedCell* cells, const BlockRange* ranges, std::size_t count,
                                     const TargetBlock* blocks, double d2, PairSums* sums)
{
  sumAll(cells, ranges, count, blocks, d2, sums);
}

[[gnu::target("avx512f,avx512dq")]] void sumAvx512(const TurnedCell* cells, const BlockRange* ranges, std::size_t count,
                                                   const TargetBlock* blocks, double d2, PairSums* sums)
{
  sumAll(cells, ranges, count, blocks, d2, sums);
}
}  // namespace

void sumPairs(const TurnedCell* cells, const BlockRange* ranges, std::size_t count, const TargetBlock* blocks,
              double d2, PairSums* sums, Kernel kernel)
{
  switch (kernel)
  {
    case Kernel::Portable:
      return sumPortable(cells, ranges, count, blocks, d2, sums);
    case Kernel::Avx2:
      return sumAvx2(cells, ranges, count, blocks, d2, sums);
    case Kernel::Avx512:
      return sumAvx512(cells, ranges, count, blocks, d2, sums);
  }
}
}  // namespace scanloom
