#include "base/core/Array.h"

#include <gmock/gmock.h>

#include <cstdint>

namespace scanloom::array_unittest
{
TEST(Array, whatIsWrittenIntoItsRoomBecomesPartOfItByGrowing)
{
  Array<int> array{1, 2};
  int* const room = array.room(100);
  room[0] = 3;
  room[1] = 4;
  array.grow(1);
  EXPECT_THAT(array, testing::ElementsAre(1, 2, 3));
}

TEST(Array, roomKeepsWhatIsThere)
{
  Array<std::uint16_t> array;
  for (std::uint16_t i = 0; i < 1000; ++i) array.push_back(i);
  for (std::uint16_t i = 0; i < 1000; ++i) ASSERT_EQ(array[i], i);
}

TEST(Array, newElementsOfResizeAreZeroEvenInMemoryThatWasUsedBefore)
{
  Array<float> array{1, 2, 3};
  array.resize(1);
  array.resize(3);
  EXPECT_THAT(array, testing::ElementsAre(1, 0, 0));
}

TEST(Array, memoryStartsAtACacheLine)
{
  const Array<std::uint8_t> array{1};
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 64, 0u);
}

TEST(Array, copiesAreApartAndMovesTakeTheMemory)
{
  Array<int> array{1, 2};
  Array<int> copy = array;
  copy.back() = 5;
  EXPECT_EQ(array, (Array<int>{1, 2}));
  EXPECT_NE(copy, array);

  const int* const memory = array.data();
  const Array<int> moved = std::move(array);
  EXPECT_EQ(moved.data(), memory);
}

TEST(Array, anArrayCanBeAssignedToItself)
{
  Array<int> array{1, 2};
  const Array<int>& same = array;
  array = same;
  EXPECT_THAT(array, testing::ElementsAre(1, 2));
}

TEST(Array, anEmptyOneHasNoMemoryAndCanBeCopied)
{
  const Array<int> empty;
  const Array<int> copy = empty;
  EXPECT_EQ(copy.capacity(), 0u);
  EXPECT_TRUE(copy.empty());
}
}  // namespace scanloom::array_unittest
