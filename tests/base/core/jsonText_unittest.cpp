#include "base/core/jsonText.h"

#include <gtest/gtest.h>

namespace scanloom::json_text_unittest
{
TEST(JsonText, hasAReplacementCharacterForWhatIsNoUtf8)
{
  EXPECT_EQ(jsonText({{"recording",
                       "dr\xe4"
                       "ve"}},
                     -1),
            "{\"recording\":\"dr\xef\xbf\xbdve\"}");
}
}  // namespace scanloom::json_text_unittest
