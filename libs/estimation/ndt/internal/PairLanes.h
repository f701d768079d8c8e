/** One source cell against eight target cells: the common part of all kernels over pairs of cells. */
#pragma once
#include "estimation/ndt/FittedConstants.h"
#include "estimation/ndt/internal/ScoreSums.h"
#include "estimation/ndt/internal/Symmetric3.h"

#include <cstdint>
#include <cstring>

#define SCANLOOM_INLINE [[gnu::always_inline]] inline

namespace scanloom
{
// Values of vectors never leave a function that is inlined, so how they are returned matters to nobody.
#pragma GCC diagnostic ignored "-Wpsabi"

// Vectors of the compiler: the same operations in the same order, whatever registers the machine has.
using Lanes = double __attribute__((vector_size(8 * TargetBlock::kLanes)));

constexpr double kRound = 0x1.8p52;  // adding and subtracting it rounds to a whole number
constexpr std::uint64_t kBitsOfRound = 0x4338000000000000;

SCANLOOM_INLINE Lanes load(const double* from)
{
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

using SymmetricLanes = SymmetricOf<Lanes>;

/**
 * The smaller of two numbers that are not negative, whose bits have the order of the numbers. Not by a comparison: GCC
 * splits comparisons of vectors before it knows the registers of a function's target.
 */
SCANLOOM_INLINE Lanes atMost(double most, const Lanes& v)
{
  using Bits = std::uint64_t __attribute__((vector_size(8 * TargetBlock::kLanes)));
  Bits bits, most_bits;
  const Lanes most_lanes = Lanes{} + most;
  std::memcpy(&bits, &v, sizeof v);
  std::memcpy(&most_bits, &most_lanes, sizeof v);
  const Bits keep = -((bits - most_bits) >> 63);
  bits = (bits & keep) | (most_bits & ~keep);
  Lanes kept;
  std::memcpy(&kept, &bits, sizeof kept);
  return kept;
}

/** exp(-h) for h from 0 to 690, to 1e-11: 2^-n exp(r) with |r| <= ln 2 / 2, by Taylor's series. */
SCANLOOM_INLINE Lanes expOfMinus(const Lanes& h)
{
  using Whole = std::int64_t __attribute__((vector_size(8 * TargetBlock::kLanes)));
  constexpr double kLog2E = 1.4426950408889634, kLn2High = 0x1.62e42fefa3800p-1, kLn2Low = 0x1.ef35793c76730p-45;
  constexpr double kOver[] = {1,         1,         1.0 / 2,    1.0 / 6,     1.0 / 24,
                              1.0 / 120, 1.0 / 720, 1.0 / 5040, 1.0 / 40320, 1.0 / 362880};  // the factorials
  const Lanes shifted = h * kLog2E + kRound;
  const Lanes n = shifted - kRound;
  const Lanes r = (n * kLn2High - h) + n * kLn2Low;
  Lanes sum = kOver[8] + r * kOver[9];
  for (int k = 7; k >= 0; --k) sum = kOver[k] + r * sum;

  Whole bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  const std::int64_t exponent_bias = 1023;
  bits = (exponent_bias - (bits - static_cast<std::int64_t>(kBitsOfRound))) << 52;
  Lanes power;
  std::memcpy(&power, &bits, sizeof power);
  return sum * power;
}

/** The sum of the lanes, in a fixed tree so that its bits are the same everywhere. */
SCANLOOM_INLINE double total(const Lanes& v)
{
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/** See ScoreSums: e, B and u = Bm. */
struct PairTerms
{
  Lanes e, ux, uy, uz;
  SymmetricLanes b;
};

SCANLOOM_INLINE PairTerms termsOf(const TurnedCell& s, const TargetBlock& block, double d2)
{
  const Lanes x = s.x - load(block.x), y = s.y - load(block.y), z = s.z - load(block.z);
  const Lanes apart = s.zz - load(block.zz);
  const Lanes xx = s.xx + load(block.xx), xy = s.xy + load(block.xy), xz = s.xz + load(block.xz),
              yy = s.yy + load(block.yy), yz = s.yz + load(block.yz), zz = s.zz + load(block.zz);

  // Where one cell is thin along z and the other thick, one side has seen the ground and the other also what grows on
  // it: their means differ by a part of the difference of their deviations. As a variance M it is (s - t)^2 (s + t)^2 /
  // (s^2 + t^2) of deviations s and t, times kMixture and d2. Wide scores, for starts that are far away, need all pairs
  // to find the way. With M, the variance along z is q / zz. The inverse of a symmetric 3x3 by its cofactors, all of
  // them times zz, so that one division does.
  PairTerms terms;
  SymmetricLanes& b = terms.b;
  const Lanes q = zz * zz + (fitted::kMixture * d2) * (apart * apart), xz_zz = xz * zz, yz_zz = yz * zz;
  const Lanes cxx = yy * q - yz * yz_zz, cxy = xz * yz_zz - xy * q, cxz = xy * yz_zz - yy * xz_zz;
  const Lanes inverse = 1 / (xx * cxx + xy * cxy + xz * cxz);
  b.xx = inverse * cxx, b.xy = inverse * cxy, b.xz = inverse * cxz;
  b.yy = inverse * (xx * q - xz * xz_zz), b.yz = inverse * (xy * xz_zz - xx * yz_zz);
  b.zz = inverse * (zz * (xx * yy - xy * xy));
  terms.ux = b.xx * x + b.xy * y + b.xz * z;
  terms.uy = b.xy * x + b.yy * y + b.yz * z;
  terms.uz = b.xz * x + b.yz * y + b.zz * z;

  // exp(-690) is still normal.
  terms.e = expOfMinus(atMost(690, (d2 / 2) * (x * terms.ux + y * terms.uy + z * terms.uz)));
  return terms;
}
}  // namespace scanloom
