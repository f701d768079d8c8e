#include "estimation/ndt/internal/EigenLanes.h"

#include "estimation/ndt/internal/PairLanes.h"

namespace scanloom
{
namespace
{
using Bits = std::uint64_t __attribute__((vector_size(8 * SymmetricBlock::kLanes)));

/** 1 / sqrt(x) for positive normal numbers, to 3e-11: a start to 3 % by the exponent, then Newton's steps. */
SCANLOOM_INLINE void inverseRoot(const Lanes& x, Lanes& result)
{
  constexpr std::uint64_t kStart = 0x5fe6eb50c7b537a9;  // C. Lomont: Fast inverse square root, 2003
  Bits bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits = kStart - (bits >> 1);
  std::memcpy(&result, &bits, sizeof bits);
  const Lanes half = 0.5 * x;
  for (int step = 0; step < 3; ++step) result = result * (1.5 - half * result * result);
}

SCANLOOM_INLINE void giveSignOf(const Lanes& signed_lanes, Lanes& positive)
{
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  Bits sign, bits;
  std::memcpy(&sign, &signed_lanes, sizeof sign);
  std::memcpy(&bits, &positive, sizeof bits);
  bits |= sign & kSign;
  std::memcpy(&positive, &bits, sizeof bits);
}

SCANLOOM_INLINE void turn(const Lanes& cosine, const Lanes& sine, Lanes& a, Lanes& b)
{
  const Lanes before = a;
  a = cosine * before - sine * b;
  b = sine * before + cosine * b;
}

/** Turns the axes p and q so that the entry pq becomes 0; r is the third axis. */
SCANLOOM_INLINE void rotate(Lanes& pp, Lanes& qq, Lanes& pq, Lanes& pr, Lanes& qr, Lanes* p, Lanes* q)
{
  constexpr double kNotZero = 1e-300;
  const Lanes apart = qq - pp, twice = 2 * pq, square = apart * apart + twice * twice + kNotZero;
  Lanes cosine, length;
  inverseRoot(square, length);
  length = square * length;
  giveSignOf(apart, length);
  const Lanes tangent = twice / (apart + length);
  inverseRoot(1 + tangent * tangent, cosine);
  const Lanes sine = tangent * cosine;
  pp -= tangent * pq;
  qq += tangent * pq;
  pq = Lanes{};
  turn(cosine, sine, pr, qr);
  for (int i = 0; i < 3; ++i) turn(cosine, sine, p[i], q[i]);
}

SCANLOOM_INLINE void solve(const SymmetricBlock& block, EigenBlock& result)
{
  constexpr int kSweeps = 4;  // each squares what is left beside the diagonal, and more
  Lanes xx, xy, xz, yy, yz, zz;
  load(block.xx, xx), load(block.xy, xy), load(block.xz, xz);
  load(block.yy, yy), load(block.yz, yz), load(block.zz, zz);
  Lanes v[3][3] = {};
  for (int i = 0; i < 3; ++i) v[i][i] += 1;
  for (int sweep = 0; sweep < kSweeps; ++sweep)
  {
    rotate(xx, yy, xy, xz, yz, v[0], v[1]);
    rotate(xx, zz, xz, xy, yz, v[0], v[2]);
    rotate(yy, zz, yz, xy, xz, v[1], v[2]);
  }
  std::memcpy(result.values[0], &xx, sizeof xx);
  std::memcpy(result.values[1], &yy, sizeof yy);
  std::memcpy(result.values[2], &zz, sizeof zz);
  std::memcpy(result.vectors, v, sizeof v);
}

void solvePortable(const SymmetricBlock& block, EigenBlock& result) { solve(block, result); }

SCANLOOM_AVX2 void solveAvx2(const SymmetricBlock& block, EigenBlock& result) { solve(block, result); }

SCANLOOM_AVX512 void solveAvx512(const SymmetricBlock& block, EigenBlock& result) { solve(block, result); }
}  // namespace

void eigensystemsOf(const SymmetricBlock& block, EigenBlock& result, Kernel kernel)
{
  switch (kernel)
  {
    case Kernel::Portable:
      return solvePortable(block, result);
    case Kernel::Avx2:
      return solveAvx2(block, result);
    case Kernel::Avx512:
      return solveAvx512(block, result);
  }
}
}  // namespace scanloom
