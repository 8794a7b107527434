#include "core/format.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(Format, PrintsAsPrintf) { EXPECT_EQ(formatted("%3d %s %.2f", 7, "x", 0.125), "  7 x 0.12"); }

TEST(Format, CutsNothingOff) {
  const std::string text(5000, 'a');
  EXPECT_EQ(formatted("%s|", text.c_str()), text + "|");
}

}  // namespace
}  // namespace barehand
