// Tests networks whose files are missing, damaged or made for other inputs, and networks whose output is not finite.
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "stages/detection/detection_stage.h"
#include "stages/detection/networks.h"
#include "support/rendered_person.h"
#include "support/temp_folder.h"
#include "support/text_logger.h"

namespace barehand {
namespace {

const std::string kShipped = std::string(BAREHAND_CONFIGS) + "/nets";

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void write(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

class NetworksTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"nets.json", "full.onnx", "crop.onnx"})
      std::filesystem::copy(kShipped + "/" + name, folder_ / name);
  }
  std::string error() const {
    const auto detector = HandDetector::load(folder_.path(), DetectionParams{});
    return detector ? "" : detector.error().message();
  }
  /// Writes the checksum that the error message names into nets.json.
  void accept(const std::string& key, const std::string& message) const {
    const auto found = message.find("has checksum ");
    ASSERT_NE(found, std::string::npos) << message;
    std::string manifest = bytes_of(folder_ / "nets.json");
    const auto at = manifest.find("\"crc32\": \"", manifest.find("\"" + key + "\": {")) + 10;
    manifest.replace(at, 8, message.substr(found + 13, 8));
    write(folder_ / "nets.json", manifest);
  }
  test::TempFolder folder_;
};

TEST(FrameViews, AreFewAlsoForAFocalLengthInMillimetres) {
  EXPECT_EQ(frame_views({640, 480, 525, 525, 319.5, 239.5}).size(), 1u);
  EXPECT_GT(frame_views({640, 480, 185, 185, 319.5, 239.5}).size(), 1u) << "120 degrees";
  EXPECT_LE(frame_views({640, 480, 3.6, 3.6, 319.5, 239.5}).size(), 36u);
}

TEST_F(NetworksTest, TheShippedOnesLoad) { EXPECT_EQ(error(), ""); }

TEST_F(NetworksTest, AMissingFolderOrFileIsSaid) {
  std::filesystem::remove(folder_ / "crop.onnx");
  EXPECT_THAT(error(), testing::HasSubstr("crop.onnx"));
  std::filesystem::remove(folder_ / "nets.json");
  EXPECT_THAT(error(), testing::HasSubstr("nets.json"));
}

TEST_F(NetworksTest, ADamagedFileIsSaid) {
  std::string bytes = bytes_of(folder_ / "full.onnx");
  bytes[bytes.size() / 2] ^= 1;
  write(folder_ / "full.onnx", bytes);
  EXPECT_THAT(error(), testing::AllOf(testing::HasSubstr("full.onnx"), testing::HasSubstr("checksum")));
}

TEST_F(NetworksTest, AFileThatIsNoNetworkIsSaid) {
  write(folder_ / "full.onnx", "this is no network");
  accept("full", error());
  EXPECT_THAT(error(), testing::HasSubstr(folder_ / "full.onnx" + ": is not a network"));
}

TEST_F(NetworksTest, ANetworkOfAnotherShapeIsSaid) {
  std::filesystem::copy(folder_ / "full.onnx", folder_ / "crop.onnx",
                        std::filesystem::copy_options::overwrite_existing);
  accept("crop", error());
  EXPECT_THAT(error(),
              testing::AllOf(testing::HasSubstr(folder_ / "crop.onnx"), testing::HasSubstr("other inputs or outputs")));
}

TEST_F(NetworksTest, AnOperatorThatIsNotSupportedIsSaid) {
  std::string bytes = bytes_of(folder_ / "full.onnx");
  const std::string known("\x22\x04Relu");  // the field op_type of a node
  bytes.replace(bytes.find(known), known.size(), "\x22\x04Tanh");
  write(folder_ / "full.onnx", bytes);
  accept("full", error());
  EXPECT_THAT(error(), testing::HasSubstr("Tanh"));
}

TEST_F(NetworksTest, AnotherInterfaceIsSaid) {
  std::string manifest = bytes_of(folder_ / "nets.json");
  const std::string known = "\"interface\": \"2\"";
  manifest.replace(manifest.find(known), known.size(), "\"interface\": \"7\"");
  write(folder_ / "nets.json", manifest);
  EXPECT_THAT(error(), testing::HasSubstr("interface 7"));
}

TEST_F(NetworksTest, WeightsThatAreNotFiniteAreSaid) {
  // Nearly all bytes of the file are float weights, but their alignment in the file is unknown: of the four possible
  // ones, one turns 64 weights in a row into NaN.
  const std::string bytes = bytes_of(folder_ / "crop.onnx"), nan("\x00\x00\xc0\x7f", 4);
  bool said = false;
  for (std::size_t alignment = 0; alignment < 4; ++alignment) {
    std::string spoilt = bytes;
    for (int i = 0; i < 64; ++i) spoilt.replace(bytes.size() / 2 + alignment + 4 * i, 4, nan);
    write(folder_ / "crop.onnx", spoilt);
    write(folder_ / "nets.json", bytes_of(kShipped + "/nets.json"));
    accept("crop", error());
    said |= error().find("not finite") != std::string::npos;
  }
  EXPECT_TRUE(said);
}

TEST_F(NetworksTest, WithoutThemTheStageSaysSoOnceAndDetectsNothing) {
  std::filesystem::remove(folder_ / "full.onnx");
  std::ostringstream said;
  DetectionParams params;
  params.enabled = true;
  Workers workers(1);
  DetectionStage stage(params, folder_.path(), workers, test::text_logger(said));
  const auto frame = test::RenderedPerson(test::vga_camera()).frame();
  EXPECT_EQ(stage.process(frame, {}), nullptr);
  EXPECT_EQ(stage.process(frame, {}), nullptr);
  const std::string text = said.str();
  EXPECT_THAT(text, testing::HasSubstr("full.onnx"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

}  // namespace
}  // namespace barehand
