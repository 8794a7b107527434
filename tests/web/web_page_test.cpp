#include "io/web/web_page.h"

#include <gtest/gtest.h>

#include <regex>

namespace barehand {
namespace {

TEST(WebPage, HasEveryFileThatItNames) {
  const auto page = read_web_page();
  ASSERT_TRUE(page) << page.error().message();
  const std::regex name(R"re((?:src|href|from|import)[=( ]+"\.?/?([\w./]+\.(?:js|css|svg))")re");
  int found = 0;
  for (const auto& [path, file] : *page) {
    if (path.starts_with("/three/")) continue;
    for (std::sregex_iterator it(file.bytes.begin(), file.bytes.end(), name); it != std::sregex_iterator();
         ++it, ++found)
      EXPECT_TRUE(page->contains("/" + (*it)[1].str())) << path << " names " << (*it)[1];
  }
  EXPECT_GT(found, 10);
}

TEST(WebPage, NeedsNothingFromOutside) {
  const auto page = read_web_page();
  ASSERT_TRUE(page);
  for (const auto& [path, file] : *page) {
    if (path.starts_with("/three/")) continue;
    EXPECT_EQ(file.bytes.find("https://"), std::string::npos) << path;
  }
}

}  // namespace
}  // namespace barehand
