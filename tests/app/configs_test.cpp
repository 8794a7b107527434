#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "app/config.h"

namespace barehand {
namespace {

class ShippedConfig : public ::testing::TestWithParam<const char*> {
 protected:
  const std::string path_ = std::string(BAREHAND_CONFIGS) + "/" + GetParam();
};

INSTANTIATE_TEST_SUITE_P(Configs, ShippedConfig, ::testing::Values("paper.yaml", "default.yaml", "accurate.yaml"),
                         [](const auto& info) { return std::string(info.param, strchr(info.param, '.')); });

TEST_P(ShippedConfig, IsCompleteAndInRange) {
  const auto config = load_config<Config>(path_);
  EXPECT_TRUE(config) << config.error().message();
}

/// What print_config says about a key is what the file says: no stale comment, no changed order.
TEST_P(ShippedConfig, CarriesTheCommentsOfTheCode) {
  const auto config = load_config<Config>(path_);
  ASSERT_TRUE(config);
  std::ifstream file(path_);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(text.find(print_config(*config)), std::string::npos)
      << "write it anew: barehand track --print-config --config " << path_;
}

}  // namespace
}  // namespace barehand
