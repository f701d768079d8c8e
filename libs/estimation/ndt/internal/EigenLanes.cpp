#include "estimation/ndt/internal/EigenLanes.h"

#include "estimation/ndt/internal/PairLanes.h"

namespace scanloom
{
namespace
{
using Bits = std::uint64_t __attribute__((vector_size(8 * SymmetricBlock::kLanes)));

/** 1 / sqrt(x) for positive normal numbers, to 3e-11: a start to 3 % by the exponent, then Newton's steps. */
SCANLOOM_INLINE Lanes inverseRoot(const Lanes& x)
{
  Bits bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits = 0x5fe6eb50c7b537a9 - (bits >> 1);  // C. Lomont: Fast inverse square root, 2003
  Lanes result;
  std::memcpy(&result, &bits, sizeof bits);
  const Lanes half = 0.5 * x;
  for (int step = 0; step < 3; ++step) result = result * (1.5 - half * result * result);
  return result;
}

SCANLOOM_INLINE Lanes withSignOf(const Lanes& signed_lanes, const Lanes& positive)
{
  Bits sign, bits;
  std::memcpy(&sign, &signed_lanes, sizeof sign);
  std::memcpy(&bits, &positive, sizeof bits);
  bits |= sign & std::uint64_t{1} << 63;
  Lanes result;
  std::memcpy(&result, &bits, sizeof bits);
  return result;
}

struct Two
{
  Lanes a, b;
};

SCANLOOM_INLINE Two turned(const Lanes& cosine, const Lanes& sine, const Lanes& a, const Lanes& b)
{
  return {cosine * a - sine * b, sine * a + cosine * b};
}

/**
 * Turns the axes p and q so that the entry pq becomes 0; r is the third axis. The lanes are changed in place: eleven
 * vectors are more than the registers hold, and would be copied for each of the twelve calls.
 */
SCANLOOM_INLINE void rotate(Lanes& pp, Lanes& qq, Lanes& pq, Lanes& pr, Lanes& qr, Lanes* p, Lanes* q)
{
  const Lanes apart = qq - pp, twice = 2 * pq, square = apart * apart + twice * twice + 1e-300;  // not zero
  const Lanes length = withSignOf(apart, square * inverseRoot(square));
  const Lanes tangent = twice / (apart + length);
  const Lanes cosine = inverseRoot(1 + tangent * tangent);
  const Lanes sine = tangent * cosine;
  pp -= tangent * pq;
  qq += tangent * pq;
  pq = Lanes{};
  const Two to_r = turned(cosine, sine, pr, qr);
  pr = to_r.a, qr = to_r.b;
  for (int i = 0; i < 3; ++i)
  {
    const Two axes = turned(cosine, sine, p[i], q[i]);
    p[i] = axes.a, q[i] = axes.b;
  }
}

SCANLOOM_INLINE EigenBlock solve(const SymmetricBlock& block)
{
  const int sweeps = 4;  // each squares what is left beside the diagonal, and more
  Lanes xx = load(block.xx), xy = load(block.xy), xz = load(block.xz);
  Lanes yy = load(block.yy), yz = load(block.yz), zz = load(block.zz);
  Lanes v[3][3] = {};
  for (int i = 0; i < 3; ++i) v[i][i] += 1;
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    rotate(xx, yy, xy, xz, yz, v[0], v[1]);
    rotate(xx, zz, xz, xy, yz, v[0], v[2]);
    rotate(yy, zz, yz, xy, xz, v[1], v[2]);
  }
  EigenBlock result;
  std::memcpy(result.values[0], &xx, sizeof xx);
  std::memcpy(result.values[1], &yy, sizeof yy);
  std::memcpy(result.values[2], &zz, sizeof zz);
  std::memcpy(result.vectors, v, sizeof v);
  return result;
}

EigenBlock solvePortable(const SymmetricBlock& block) { return solve(block); }

SCANLOOM_AVX2 EigenBlock solveAvx2(const SymmetricBlock& block) { return solve(block); }

SCANLOOM_AVX512 EigenBlock solveAvx512(const SymmetricBlock& block) { return solve(block); }
}  // namespace

EigenBlock eigensystemsOf(const SymmetricBlock& block, Kernel kernel)
{
  switch (kernel)
  {
    case Kernel::Portable:
      return solvePortable(block);
    case Kernel::Avx2:
      return solveAvx2(block);
    case Kernel::Avx512:
      return solveAvx512(block);
  }
  return {};
}
}  // namespace scanloom
