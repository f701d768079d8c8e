#include "lab/simulation/internal/Solids.h"

#include "lab/simulation/internal/Random.h"

#include <gtest/gtest.h>

#include "mantle.h"

namespace scanloom::solids_unittest
{
namespace
{
Eigen::Vector3d randomVector(Random& random)
{
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

/** For comparison: the first point along the ray with inside(p), in steps of 1 mm. */
template <typename Inside>
std::optional<double> march(const Ray& ray, Inside&& inside)
{
  for (double range = 0; range < 30; range += 1e-3)
    if (inside(ray.at(range))) return range;
  return std::nullopt;
}

TEST(Solids, aBoxIsMetWhereItIsFirstEntered)
{
  const Rigid frame_T_box = Rigid::fromXyzYawPitchRoll(1, -2, 0.5, 0.7, -0.3, 1.1);
  const Eigen::Vector3d half(1.5, 0.6, 0.9);
  const OrientedBox box(frame_T_box, half);
  const auto inside = [&](const Eigen::Vector3d& p)
  { return ((frame_T_box.inverse() * p).cwiseAbs() - half).maxCoeff() < 0; };
  int hits = 0;
  for (std::uint64_t i = 0; i < 60; ++i)
  {
    Random random(1, RandomStream::Stand, i);
    const Eigen::Vector3d origin = 8 * randomVector(random).normalized();
    const Eigen::Vector3d aim = frame_T_box.translation + randomVector(random);
    const Ray ray{origin, (aim - origin).normalized()};
    const auto contact = box.cast(ray);
    const auto expected = march(ray, inside);
    ASSERT_EQ(contact.has_value(), expected.has_value()) << i;
    if (!contact) continue;
    ++hits;
    EXPECT_NEAR(contact->range, *expected, 1.1e-3);
    EXPECT_GT(contact->cosine_incidence, 0);
    EXPECT_LE(contact->cosine_incidence, 1);
  }
  EXPECT_GT(hits, 20);
}

TEST(Solids, aConeIsMetWhereItIsFirstEnteredAndOnlyThere)
{
  const Eigen::Vector3d foot(1, 2, -1), axis = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  const Cone cone{foot, axis, 4, 0.8, 0.2};
  const auto inside = [&](const Eigen::Vector3d& p)
  {
    const double height = (p - foot).dot(axis);
    return height > 0 && height < 4 && (p - foot - height * axis).norm() < 0.8 - 0.15 * height;
  };
  int hits = 0;
  for (std::uint64_t i = 0; i < 80; ++i)
  {
    Random random(2, RandomStream::Stand, i);
    Eigen::Vector3d origin = 9 * randomVector(random).normalized();
    origin.z() = std::abs(origin.z());  // its foot is open: from below one sees into it
    const Eigen::Vector3d aim = foot + 2 * axis + randomVector(random);
    const Ray ray{origin, (aim - origin).normalized()};
    const auto contact = castCone(cone, ray);
    const auto expected = march(ray, inside);
    ASSERT_EQ(contact.has_value(), expected.has_value()) << i;
    if (!contact) continue;
    ++hits;
    EXPECT_NEAR(contact->range, *expected, 2e-3);
  }
  EXPECT_GT(hits, 15);
}

TEST(Solids, aCylinderSeenSquarelyHasItsRadiusAndItsNormal)
{
  const Cone upright{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 2, 0.25, 0.25};

  const auto squarely = castCone(upright, {{-5, 0, 1}, Eigen::Vector3d::UnitX()});
  ASSERT_TRUE(squarely);
  EXPECT_NEAR(squarely->range, 4.75, 1e-12);
  EXPECT_NEAR(squarely->cosine_incidence, 1, 1e-12);

  const auto from_above = castCone(upright, {{0.1, 0.1, 7}, -Eigen::Vector3d::UnitZ()});
  ASSERT_TRUE(from_above);
  EXPECT_NEAR(from_above->range, 5, 1e-12);
  EXPECT_FALSE(castCone(upright, {{-5, 0.26, 1}, Eigen::Vector3d::UnitX()}));
  EXPECT_FALSE(castCone(upright, {{5, 0, 1}, Eigen::Vector3d::UnitX()})) << "behind";
  EXPECT_NEAR(distanceToMantle(upright, {1, 0, 1}), 0.75, 1e-12);
}
}  // namespace
}  // namespace scanloom::solids_unittest
