#pragma once
#include <Eigen/Core>

#include <cmath>

namespace scanloom
{
template <int kCount>
struct SineCosine
{
  Eigen::Array<double, kCount, 1> sine, cosine;
};

/**
 * Of several angles at once, without the branches of std::sin: each ray needs about ten. To 1e-12 with Taylor's series
 * to r^17, to 1e-7 with that to r^11.
 */
template <int kCount, int kLast = 17>
SineCosine<kCount> sineCosine(const Eigen::Array<double, kCount, 1>& angle)
{
  using Angles = Eigen::Array<double, kCount, 1>;
  constexpr double kRound = 0x1.8p52;  // adding and subtracting it rounds to a whole number
  const Angles half_turns = (angle * M_1_PI + kRound) - kRound;
  const Angles r = angle - half_turns * M_PI, q = r * r;  // |r| <= pi / 2
  const Angles sign = 1 - 2 * (half_turns - 2 * ((0.5 * half_turns + kRound) - kRound)).abs();
  Angles sine = Angles::Ones(), cosine = Angles::Ones();
  for (int n = kLast - 1; n >= 2; n -= 2)  // Taylor's series, inside out
  {
    sine = 1 - (q * (1.0 / (n * (n + 1)))) * sine;
    cosine = 1 - (q * (1.0 / (n * (n - 1)))) * cosine;
  }
  return {sign * r * sine, sign * cosine};
}
}  // namespace scanloom
