#include "base/core/csvField.h"

#include <gtest/gtest.h>

namespace scanloom::csv_field_unittest
{
TEST(CsvField, isOneFieldOfOneLine)
{
  EXPECT_EQ(csvField("left"), "left");
  EXPECT_EQ(csvField("a,b"), "\"a,b\"");
  EXPECT_EQ(csvField("a\n1,2"), "\"a\n1,2\"");
}

TEST(CsvField, isNoFormula)
{
  EXPECT_EQ(csvField("=HYPERLINK(\"http://evil\")"), "\"'=HYPERLINK(\"\"http://evil\"\")\"");
}
}  // namespace scanloom::csv_field_unittest
