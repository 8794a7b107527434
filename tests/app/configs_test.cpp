#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "pipeline/config.h"

namespace barehand {
namespace {

class ShippedConfig : public ::testing::TestWithParam<const char*> {
 protected:
  const std::string path_ = std::string(BAREHAND_CONFIGS) + "/" + GetParam();
};

INSTANTIATE_TEST_SUITE_P(Configs, ShippedConfig, ::testing::Values("paper.yaml", "default.yaml", "accurate.yaml"),
                         [](const auto& info) { return std::string(info.param, strchr(info.param, '.')); });

TEST_P(ShippedConfig, IsInRange) {
  const auto config = load_config<Config>(path_);
  EXPECT_TRUE(config) << config.error().message();
}

/// A file contains exactly what print_config prints: the default configuration all keys for users, the others those
/// that differ from it; each with its help text, in the same order.
TEST_P(ShippedConfig, HoldsWhatItMustAndNoMore) {
  const auto config = load_config<Config>(path_);
  ASSERT_TRUE(config);
  std::ifstream file(path_);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const bool is_default = std::string(GetParam()) == "default.yaml";
  const auto keys = is_default ? ConfigKeys::user : ConfigKeys::changed;
  EXPECT_TRUE(text.ends_with("\n\n" + print_config(*config, keys)))
      << "write it anew: barehand track --print-config=" << (is_default ? "user" : "changed") << " --config " << path_;
}

TEST(DefaultConfig, IsWhatTheCodeSays) {
  const auto config = load_config<Config>(std::string(BAREHAND_CONFIGS) + "/default.yaml");
  ASSERT_TRUE(config);
  EXPECT_EQ(config_values(*config), config_values(Config{}));
}

/// Whoever chooses between the shipped files reads them all.
TEST(ShippedConfigs, AreShortTogether) {
  std::ptrdiff_t lines = 0;
  for (const char* name : {"paper.yaml", "default.yaml", "accurate.yaml"}) {
    std::ifstream file(std::string(BAREHAND_CONFIGS) + "/" + name);
    lines += std::count(std::istreambuf_iterator<char>(file), {}, '\n');
  }
  EXPECT_GT(lines, 50);
  EXPECT_LE(lines, 250);
}

/// Users who open the default configuration read all of its keys, so these must stay few.
TEST(DefaultConfig, ShowsFewKeys) {
  const std::string text = print_config(Config{}, ConfigKeys::user);
  const auto lines = std::count(text.begin(), text.end(), '\n'), comments = std::count(text.begin(), text.end(), '#');
  EXPECT_LE(lines - comments, 75) << "groups and empty lines included";
}

}  // namespace
}  // namespace barehand
