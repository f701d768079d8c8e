#include "input/rig/internal/makeBatcher.h"

#include "input/batching/TimeBatcher.h"
#include "input/whole_turns/WholeTurns.h"
#include "support/FakeLidar.h"

#include <gtest/gtest.h>

namespace scanloom::make_batcher_unittest
{
namespace
{
std::unique_ptr<Batcher> named(const std::string& name)
{
  BatcherOptions options;
  options.batching = name;
  return makeBatcher({{"lidar", std::make_shared<FakeLidar>()}}, options);
}

template <typename T>
bool is(const std::unique_ptr<Batcher>& batcher)
{
  return dynamic_cast<const T*>(batcher.get()) != nullptr;
}
}  // namespace

TEST(Batcher, isTheOneThatTheOptionNames)
{
  EXPECT_TRUE(is<TimeBatcher>(named(BatcherOptions{}.batching)));
  EXPECT_TRUE(is<TimeBatcher>(named("time")));
  EXPECT_TRUE(is<WholeTurns>(named("nearest_turns")));
  EXPECT_TRUE(is<WholeTurns>(named("one_turn_of_each")));
  EXPECT_THROW(named("turns"), std::invalid_argument);
}

TEST(Batcher, wholeTurnsHaveNoSlices)
{
  BatcherOptions options;
  options.slices = 4;
  EXPECT_NO_THROW(makeBatcher({{"lidar", std::make_shared<FakeLidar>()}}, options));
  options.batching = "nearest_turns";
  EXPECT_THROW(makeBatcher({{"lidar", std::make_shared<FakeLidar>()}}, options), std::invalid_argument);
}
}  // namespace scanloom::make_batcher_unittest
