#include "base/core/Text.h"

#include <gtest/gtest.h>

namespace scanloom::text_unittest
{
TEST(Printable, leavesTextOfEveryLanguageAsItIs)
{
  for (const char* text : {"OS-0-128", "", "größer ≥ 5 °", "雷达", "🌲"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, showsNothingThatATerminalObeys)
{
  EXPECT_EQ(printable("OS\x1b[2J\x1b]0;title\x07"), "OS?[2J?]0;title?");
  EXPECT_EQ(printableLines("a\x1b\nb\n"), "a?\nb\n");
  EXPECT_EQ(printable("a\r\nb\tc\x7f"), "a??b?c?");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "?31m")
      << "CSI as one character";
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "txt"),
            "?txt")
      << "writes to the left from here on";
}

TEST(Printable, showsBytesThatAreNoUtf8AsMarks)
{
  EXPECT_EQ(printable("a\x9b"
                      "b"),
            "a?b")
      << "CSI of an 8-bit terminal";
  EXPECT_EQ(printable("\xc0\x9b"), "??") << "too long a form";
  EXPECT_EQ(printable("\xf0\x9f\x8c"), "???") << "cut";
}
TEST(Printable, textForATableIsNoFormula)
{
  for (const char* text : {"left", "", "-0.5", "+3e2", "a=b"}) EXPECT_EQ(notAFormula(text), text);
  for (const char* text : {"=HYPERLINK(\"http://evil\")", "@SUM(1)", "+cmd|' /C calc'!A0", "-2+3"})
    EXPECT_EQ(notAFormula(text), std::string("'") + text);
}

TEST(Text, isTrimmedOfBlanksAtBothEnds)
{
  EXPECT_EQ(trimmed(" \t a b \r\n"), "a b");
  EXPECT_EQ(trimmed(" \n"), "");
}
}  // namespace scanloom::text_unittest
