// Tests the messages to systemd's journal: receives them at /run/systemd/journal/socket in the journal's place. To be
// started by with_own_run.sh.
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/log.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Journal : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories("/run/systemd/journal");
    std::filesystem::remove(kPath);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::string(kPath).copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Journal() override {
    close(socket_);
    unsetenv("JOURNAL_STREAM");
  }
  /// The next message that was received, "" if there is none. Nothing to wait for: sending is synchronous.
  std::string received() const {
    char buffer[4096];
    const ssize_t count = recv(socket_, buffer, sizeof buffer, MSG_DONTWAIT);
    return count > 0 ? std::string(buffer, static_cast<std::size_t>(count)) : "";
  }
  static constexpr const char* kPath = "/run/systemd/journal/socket";
  const int socket_ = socket(AF_UNIX, SOCK_DGRAM, 0);
};

TEST_F(Journal, GetsWholeMessagesWithTheirPriority) {
  struct stat error_output {};
  ASSERT_EQ(fstat(STDERR_FILENO, &error_output), 0);
  const std::string stream = std::to_string(error_output.st_dev) + ":" + std::to_string(error_output.st_ino);
  setenv("JOURNAL_STREAM", stream.c_str(), 1);
  make_logger()->warn("first line\nsecond line");
  EXPECT_THAT(received(), AllOf(HasSubstr("PRIORITY=4\n"), HasSubstr("first line\nsecond line"),
                                HasSubstr("SYSLOG_IDENTIFIER=barehand\n")));
}

TEST_F(Journal, GetsNothingWhenStandardErrorLeadsElsewhere) {
  setenv("JOURNAL_STREAM", "1:2", 1);
  make_logger()->warn("for a file");
  EXPECT_EQ(received(), "");
}

}  // namespace
}  // namespace barehand
