#include "io/web/allowed_origin.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

namespace barehand {
namespace {

TEST(OwnHost, IsLocalhostANumberOrTheMachinesName) {
  for (const char* host : {"localhost", "localhost:8765", "LOCALHOST:1", "127.0.0.1:8765", "192.168.7.3", "[::1]:8765",
                           "[fe80::1]", "view.localhost"})
    EXPECT_TRUE(is_own_host(host)) << host;
  char name[256] = "";
  ASSERT_EQ(gethostname(name, sizeof name - 1), 0);
  EXPECT_TRUE(is_own_host(name));
  EXPECT_TRUE(is_own_host(std::string(name) + ".local:8765"));
}

TEST(OwnHost, IsNoNameThatSomebodyElseMayOwn) {
  for (const char* host : {"", ":8765", "evil.org", "evil.org:8765", "localhost.evil.org", "127.0.0.1.evil.org",
                           "evil-localhost", "[evil.org]", "["})
    EXPECT_FALSE(is_own_host(host)) << host;
}

TEST(AllowedOrigin, IsThePageThatWasServedHereAndWhoSendsNoOrigin) {
  EXPECT_TRUE(is_allowed_origin("", "localhost:8765", {}));
  EXPECT_TRUE(is_allowed_origin("http://localhost:8765", "localhost:8765", {}));
  EXPECT_TRUE(is_allowed_origin("http://LOCALHOST:8765", "localhost:8765", {}));
}

TEST(AllowedOrigin, IsNoOtherPage) {
  for (const char* origin : {"http://evil.org", "null", "file://", "http://localhost", "http://localhost:9999",
                             "https://localhost:8765", "http://localhost:8765.evil.org", "http://127.0.0.1:8765"})
    EXPECT_FALSE(is_allowed_origin(origin, "localhost:8765", {})) << origin;
}

TEST(AllowedOrigin, IsWhoIsInvited) {
  const std::vector<std::string> allowed_origins = {"https://example.org"};
  EXPECT_TRUE(is_allowed_origin("https://example.org", "localhost:8765", allowed_origins));
  EXPECT_FALSE(is_allowed_origin("https://example.org.evil.org", "localhost:8765", allowed_origins));
}

TEST(AllowedOrigin, MayBeWrittenInOtherWays) {
  for (const char* invited : {"HTTPS://Example.org", "https://example.org/", "https://example.org:443"}) {
    EXPECT_EQ(wrong_origin(invited), "");
    EXPECT_TRUE(is_allowed_origin("https://example.org", "localhost:8765", std::vector<std::string>{invited}))
        << invited;
    EXPECT_FALSE(is_allowed_origin("https://example.org:8000", "localhost:8765", std::vector<std::string>{invited}));
    EXPECT_FALSE(is_allowed_origin("http://example.org", "localhost:8765", std::vector<std::string>{invited}));
  }
  EXPECT_EQ(wrong_origin("file://"), "");
  for (const char* none : {"example.org", "*", "https://example.org/page", "://example.org"})
    EXPECT_NE(wrong_origin(none), "") << none;
}

}  // namespace
}  // namespace barehand
