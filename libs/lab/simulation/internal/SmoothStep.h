#pragma once

namespace scanloom
{
/** A step from 0 to 1 over one unit with its integral and its first two derivatives, all continuous (K. Perlin:
 * Improving Noise, SIGGRAPH 2002). */
struct SmoothStep
{
  double integral, value, first, second;
};

inline SmoothStep smoothStep(double u)
{
  if (u <= 0) return {0, 0, 0, 0};
  if (u >= 1) return {0.5 + (u - 1), 1, 0, 0};
  return {((u - 3) * u + 2.5) * u * u * u * u, ((6 * u - 15) * u + 10) * u * u * u, ((30 * u - 60) * u + 30) * u * u,
          ((120 * u - 180) * u + 60) * u};
}
}  // namespace scanloom
