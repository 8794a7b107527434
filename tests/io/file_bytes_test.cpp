#include "io/file_bytes.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
using namespace std::string_literals;

class FileBytes : public ::testing::Test {
 protected:
  std::string text_of(const std::string& bytes) const {
    test::write_text(path_, bytes);
    const auto text = read_text(path_);
    return text ? *text : text.error().message();
  }
  const test::TempFolder folder_;
  const std::string path_ = folder_ / "file";
};

TEST_F(FileBytes, ATextIsTheSameHoweverItsEditorWritesIt) {
  EXPECT_EQ(text_of("a\nb\n"), "a\nb\n");
  EXPECT_EQ(text_of("\xef\xbb\xbf"
                    "a\r\nb\r\n"),
            "a\nb\n");
  EXPECT_EQ(text_of("a\rb\r"), "a\nb\n");
  EXPECT_EQ(text_of("\xef\xbb\xbf"), "");
  EXPECT_EQ(text_of(""), "");
  EXPECT_EQ(text_of("\n\xef\xbb\xbf"), "\n\xef\xbb\xbf") << "a mark elsewhere is none";
  EXPECT_EQ(*read_file(path_), "\n\xef\xbb\xbf");
}

TEST_F(FileBytes, Utf16IsSaid) {
  for (const std::string& bytes : {"\xff\xfe"
                                   "a\0"s,
                                   "\xfe\xff\0a"s, "a\0b\0"s, "\0a\0b"s, "\xff\xfe\0\0a\0\0\0"s})
    EXPECT_THAT(text_of(bytes), HasSubstr("is UTF-16, or not a text file (save it as UTF-8)"));
}

TEST_F(FileBytes, APipeIsReadOnceAndKept) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_TRUE(is_pipe(path_));
  const std::string bytes = "\xef\xbb\xbf" + std::string(200'000, 'x');  // more than a pipe holds
  {
    const std::jthread writer([&] { test::write_text(path_, bytes); });
    EXPECT_EQ(read_file(path_), bytes);
  }
  EXPECT_EQ(read_file(path_), bytes) << "nobody writes any more";
  EXPECT_EQ(read_text(path_), bytes.substr(3));
}

TEST_F(FileBytes, AnEndlessDeviceIsAnError) {
  EXPECT_THAT(read_file("/dev/zero").error().message(), HasSubstr("delivers more than 64 MiB"));
  EXPECT_EQ(read_file("/dev/null"), "");
}

TEST_F(FileBytes, OnlyWhatCanBeReadOnceIsAPipe) {
  test::write_text(path_, "");
  EXPECT_FALSE(is_pipe(path_));
  EXPECT_FALSE(is_pipe(folder_.path()));
  EXPECT_FALSE(is_pipe(folder_ / "none"));
}

}  // namespace
}  // namespace barehand
