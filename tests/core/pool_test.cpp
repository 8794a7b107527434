#include "core/pool.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(Pool, LendsWhatIsInUseToNobodyElse) {
  Pool<int> pool;
  const auto a = pool.take(), b = pool.take();
  EXPECT_NE(a.get(), b.get());
}

TEST(Pool, LendsAgainWhatCameBack) {
  Pool<int> pool;
  const int* first = pool.take().get();
  const auto again = pool.take();
  EXPECT_EQ(again.get(), first);
}

}  // namespace
}  // namespace barehand
