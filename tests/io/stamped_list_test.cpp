#include "io/recording/stamped_list.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class StampedList : public ::testing::Test {
 protected:
  /// The list as "100000=depth/0.png ..." (time [us] and path relative to the list's folder), or the error message.
  std::string read(const std::string& text) const {
    test::write_text(list_, text);
    const auto files = read_stamped_list(list_);
    if (!files) return files.error().message();
    std::string result;
    for (const StampedFile& file : *files) {
      const bool below = file.file.starts_with(folder_.path() + "/");
      result +=
          std::to_string(file.utime) + "=" + (below ? file.file.substr(folder_.path().size() + 1) : file.file) + ";";
    }
    return result;
  }
  void make(const std::string& name) const {
    fs::create_directories(fs::path(folder_ / name).parent_path());
    test::write_text(folder_ / name, "image");
  }
  const test::TempFolder folder_;
  const std::string list_ = folder_ / "depth.txt";
};

const std::string kBom = "\xef\xbb\xbf";
constexpr const char* kTwo = "100000=depth/0.png;200000=depth/1.png;";

TEST_F(StampedList, IsReadHoweverItsEditorWritesText) {
  EXPECT_EQ(read("# timestamp filename\n0.1 depth/0.png\n0.2 depth/1.png\n"), kTwo);
  EXPECT_EQ(read(kBom + "0.1 depth/0.png\n0.2 depth/1.png"), kTwo);
  EXPECT_EQ(read(kBom + "# timestamp filename\r\n0.1 depth/0.png\r\n0.2 depth/1.png\r\n\r\n"), kTwo);
  EXPECT_EQ(read("0.1 depth/0.png\r0.2 depth/1.png\r"), kTwo);
  EXPECT_EQ(read("\n  0.1\tdepth/0.png  \n\t0.2   depth/1.png\t# the last one\n"), kTwo);
  EXPECT_EQ(read(kBom), "");
}

TEST_F(StampedList, AHeaderNeedsNoNumberSign) {
  EXPECT_EQ(read("timestamp filename\n0.1 depth/0.png\n0.2 depth/1.png\n"), kTwo);
  EXPECT_EQ(read(kBom + "# made by hand\ntimestamp filename\r\n0.1 depth/0.png\r\n0.2 depth/1.png\r\n"), kTwo);
  EXPECT_THAT(read("0.1 depth/0.png\nnoon depth/1.png\n"), HasSubstr("line 2 is \"noon depth/1.png\""));
  EXPECT_THAT(read("1,5 depth/0.png\n"), HasSubstr("line 1 is")) << "a stamp that is none is no header";
}

TEST_F(StampedList, Utf16IsSaid) {
  using namespace std::string_literals;
  EXPECT_THAT(read("\xff\xfe"
                   "0\0.\0"s),
              HasSubstr("is UTF-16"));
  EXPECT_THAT(read("\xfe\xff"
                   "\0"
                   "0\0."s),
              HasSubstr("is UTF-16"));
  EXPECT_THAT(read("0\0.\0"
                   "1\0"s),
              HasSubstr("is UTF-16"));
}

TEST_F(StampedList, NamesMayHaveSpaces) {
  make("depth images/0 a.png");
  EXPECT_EQ(read("0.1 depth images/0 a.png # first\n"), "100000=depth images/0 a.png;");
  EXPECT_EQ(read("0.1 \"depth images/0 a.png\"\n"), "100000=depth images/0 a.png;");
  EXPECT_EQ(read("0.1 \"depth #1.png\" # a comment\n"), "100000=depth #1.png;");
  EXPECT_EQ(read("0.1 depth#1/0.png\n"), "100000=depth#1/0.png;");
  EXPECT_EQ(read("0.1 depth images/gone.png\n"), "100000=depth images/gone.png;");
  EXPECT_THAT(read("0.1 \"depth/0.png\n"), HasSubstr("line 1 is"));
  EXPECT_THAT(read("0.1 \"\"\n"), HasSubstr("line 1 is"));
  EXPECT_THAT(read("0.1 \"a.png\" b.png\n"), HasSubstr("line 1 is"));
  EXPECT_THAT(read("0.1 # nothing\n"), HasSubstr("line 1 is"));
}

TEST_F(StampedList, MoreColumnsAreLeftAlone) {
  make("depth/0.png");
  EXPECT_EQ(read("0.1 depth/0.png 0.11 rgb/0.png\n"), "100000=depth/0.png;");
}

TEST_F(StampedList, BackSlashesAreSlashesUnlessTheFileIsNamedSo) {
  EXPECT_EQ(read("0.1 depth\\0.png\n"), "100000=depth/0.png;");
  make("depth images/0.png");
  EXPECT_EQ(read("0.1 depth images\\0.png\n"), "100000=depth images/0.png;");
  make("odd\\name.png");
  EXPECT_EQ(read("0.1 odd\\name.png\n"), "100000=odd\\name.png;");
}

TEST_F(StampedList, AbsoluteNamesAreTakenAsTheyAre) {
  EXPECT_EQ(read("0.1 /data/depth/0.png\n"), "100000=/data/depth/0.png;");
  EXPECT_EQ(read("0.1 " + (folder_ / "depth/0.png") + "\n"), "100000=depth/0.png;");
}

TEST_F(StampedList, TellsWhatLiesOutside) {
  const std::string in = folder_.path();
  EXPECT_FALSE(is_outside(in, in + "/depth/0.png"));
  EXPECT_FALSE(is_outside(in, in + "/a/../depth/0.png"));
  EXPECT_FALSE(is_outside(in + "/", in + "/depth/0..png"));
  EXPECT_FALSE(is_outside("rec", fs::absolute("rec/depth/0.png").string()));
  EXPECT_TRUE(is_outside(in, in + "/../depth/0.png"));
  EXPECT_TRUE(is_outside(in, "/data/0.png"));
  EXPECT_TRUE(is_outside(in, in + "2/0.png"));
}

}  // namespace
}  // namespace barehand
