/** A quantity with its first two derivatives by time (automatic differentiation). */
#pragma once
#include <cmath>

namespace scanloom
{
struct Taylor
{
  double value = 0;
  double rate = 0;          // d/dt
  double acceleration = 0;  // d2/dt2

  Taylor() = default;
  Taylor(double constant) : value(constant) {}  // NOLINT: implicit, a number is a constant
  Taylor(double v, double first, double second) : value(v), rate(first), acceleration(second) {}
};

inline Taylor operator+(const Taylor& a, const Taylor& b)
{
  return {a.value + b.value, a.rate + b.rate, a.acceleration + b.acceleration};
}
inline Taylor operator-(const Taylor& a) { return {-a.value, -a.rate, -a.acceleration}; }
inline Taylor operator-(const Taylor& a, const Taylor& b) { return a + -b; }
inline Taylor operator*(const Taylor& a, const Taylor& b)
{
  return {a.value * b.value, a.rate * b.value + a.value * b.rate,
          a.acceleration * b.value + 2 * a.rate * b.rate + a.value * b.acceleration};
}

/** f(x(t)) from f, f' and f'' at x: the chain rule. */
inline Taylor chain(const Taylor& x, double f, double first, double second)
{
  return {f, first * x.rate, first * x.acceleration + second * x.rate * x.rate};
}
inline Taylor sin(const Taylor& x) { return chain(x, std::sin(x.value), std::cos(x.value), -std::sin(x.value)); }
inline Taylor cos(const Taylor& x) { return chain(x, std::cos(x.value), -std::sin(x.value), -std::cos(x.value)); }
inline Taylor atan(const Taylor& x)
{
  const double slope = 1 / (1 + x.value * x.value);
  return chain(x, std::atan(x.value), slope, -2 * x.value * slope * slope);
}
}  // namespace scanloom
