#include "core/quote.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(Quote, ANameStandsInQuotesAndATerminalFollowsNothingInIt) {
  EXPECT_EQ(in_quotes("left cam, a"), "\"left cam, a\"");
  EXPECT_EQ(in_quotes("gr\xc3\xb6\xc3\x9f"
                      "e"),
            "\"gr\xc3\xb6\xc3\x9f"
            "e\"");
  EXPECT_EQ(in_quotes("a\"b\\c"), "\"a\\\"b\\\\c\"");
  EXPECT_EQ(in_quotes("\x1b[2J\n"), "\"\\x1b[2J\\x0a\"");
}

TEST(Quote, AShellTakesItAsOneWord) {
  EXPECT_EQ(shell_word("DESK_RGBD_FRAME"), "DESK_RGBD_FRAME");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("left cam"), "'left cam'");
  EXPECT_EQ(shell_word("cam[0]*"), "'cam[0]*'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("a\n'b"), "$'a\\x0a\\'b'");
}

TEST(Utf8, IsToldFromWhatIsNot) {
  for (const char* good : {"", "plain", "\xc3\xbc", "\xe2\x82\xac", "\xf0\x9f\x96\x90", "\xf4\x8f\xbf\xbf"})
    EXPECT_TRUE(is_utf8(good)) << good;
  for (const char* bad :
       {"mess\xfcng", "\xc3", "\xe2\x82", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff", "\x80"})
    EXPECT_FALSE(is_utf8(bad)) << bad;
  EXPECT_EQ(as_utf8("mess\xfcng \xc3\xbc"), "mess\xef\xbf\xbdng \xc3\xbc");
}

}  // namespace
}  // namespace barehand
