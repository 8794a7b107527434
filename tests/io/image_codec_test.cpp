#include "io/recording/image_codec.h"

#include <gmock/gmock.h>

#include <sstream>

#include "io/recording/jpeg_codec.h"
#include "io/recording/png_codec.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;
namespace fs = std::filesystem;

/// An encoded image. There is one of every format that the decoders accept, and a file NAME.ppm with its pixels in
/// BAREHAND_PIXELS. The pixels of the PNGs are those that were encoded, those of the JPEGs were decoded by OpenCV 4.6.
Bytes picture(const std::string& name) {
  const std::string text = test::read_text(BAREHAND_PICTURES "/" + name.substr(0, name.find('_')) + "/" + name);
  return {text.begin(), text.end()};
}

Image<Rgb> pixels(const std::string& name) {
  std::istringstream file(test::read_text(BAREHAND_PIXELS "/" + name + ".ppm"));
  std::string kind;
  int width = 0, height = 0, white = 0;
  file >> kind >> width >> height >> white;
  file.get();
  Image<Rgb> image(width, height);
  file.read(reinterpret_cast<char*>(image.data()), static_cast<std::streamsize>(image.size() * sizeof(Rgb)));
  EXPECT_TRUE(file && kind == "P6" && white == 255) << name;
  return image;
}

std::string difference(const Image<Rgb>& a, const Image<Rgb>& b) {
  const auto text = [](const Rgb& p) {
    return std::to_string(p.r) + "," + std::to_string(p.g) + "," + std::to_string(p.b);
  };
  if (a.width() != b.width() || a.height() != b.height()) return "other size";
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) return "pixel " + std::to_string(i) + " is " + text(a[i]) + ", expected " + text(b[i]);
  return "";
}

Result<Image<Rgb>> decode(const Bytes& bytes) {
  return compressed_image_size(bytes).and_then([&](ImageSize size) { return decode_image(bytes, size); });
}

std::vector<std::string> names_of_pictures() {
  std::vector<std::string> names;
  for (const auto& file : fs::directory_iterator(BAREHAND_PIXELS)) names.push_back(file.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(ImageCodec, PicturesHaveTheirPixelsAndNothingIsPrinted) {
  ASSERT_EQ(names_of_pictures().size(), 40);
  for (const std::string& name : names_of_pictures()) {
    testing::internal::CaptureStderr();
    const auto decoded = decode(picture(name));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << name;
    ASSERT_TRUE(decoded) << name << ": " << decoded.error().message();
    EXPECT_EQ(difference(*decoded, pixels(name)), "") << name;
  }
}

TEST(ImageCodec, PicturesThatEndTooEarlyAreAnError) {
  for (const std::string& name : names_of_pictures()) {
    Bytes bytes = picture(name);
    while (bytes.back() == 0) bytes.pop_back();  // padding
    while (bytes.size() > 1) {
      bytes.pop_back();
      ASSERT_FALSE(decode(bytes)) << name << " after " << bytes.size() << " bytes";
    }
  }
}

TEST(ImageCodec, PicturesOfAnotherSizeThanStatedAreAnError) {
  for (const std::string& name : names_of_pictures()) {
    const Bytes bytes = picture(name);
    const ImageSize size = compressed_image_size(bytes).value();
    const auto decode_as = [&](int width, int height) {
      return name.starts_with("png") ? decode_png_colour(bytes, width, height) : decode_jpeg(bytes, width, height);
    };
    EXPECT_TRUE(decode_as(size.width, size.height)) << name;
    EXPECT_THAT(decode_as(size.width + 1, size.height).error().message(), HasSubstr("its size differs")) << name;
    EXPECT_THAT(decode_as(size.width, size.height - 1).error().message(), HasSubstr("its size differs")) << name;
  }
}

TEST(ImageCodec, DepthIsWhatWasStored) {
  for (const char* name : {"png_grey16", "png_grey16_interlaced"}) {
    const auto depth = decode_depth_image(picture(name));
    ASSERT_TRUE(depth) << depth.error().message();
    for (int v = 0; v < depth->height(); ++v)
      for (int u = 0; u < depth->width(); ++u)
        ASSERT_EQ(depth->at(u, v), (u * 7 + v * 5 + u * v) * 37) << name << " " << u << " " << v;
  }
}

TEST(ImageCodec, OnlyOneChannelOf16BitsIsDepth) {
  for (const std::string& name : names_of_pictures()) {
    const auto depth = decode_depth_image(picture(name));
    if (name == "png_grey16" || name == "png_grey16_interlaced") continue;
    ASSERT_FALSE(depth) << name;
    EXPECT_THAT(depth.error().message(), HasSubstr("not a 16-bit image with one channel")) << name;
  }
}

TEST(ImageCodec, DamageThatACheckSumTellsIsAnError) {
  Bytes bytes = picture("png_rgb8");
  bytes[bytes.size() - 20] ^= 1;  // the end of the compressed rows
  EXPECT_THAT(decode(bytes).error().message(), HasSubstr("damaged PNG"));
}

TEST(ImageCodec, AJpegOfEndlessScansIsAnError) {
  const Bytes bytes = picture("jpeg_progressive");
  const auto scan = [&](std::size_t from) {
    const Bytes marker = {0xFF, 0xDA};
    return std::search(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end(), marker.begin(), marker.end());
  };
  const auto first = scan(0);
  const auto tables = std::find(first + 2, scan(static_cast<std::size_t>(first - bytes.begin()) + 2), 0xFF);
  Bytes many(bytes.begin(), first);
  for (int i = 0; i < 200; ++i) many.insert(many.end(), first, tables);
  many.insert(many.end(), {0xFF, 0xD9});
  EXPECT_THAT(decode(many).error().message(), HasSubstr("damaged JPEG"));
}

/// The image that was encoded as jpeg_*.
Image<Rgb> source_of_jpegs() {
  Image<Rgb> image(17, 13);
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u)
      image.at(u, v) = {static_cast<std::uint8_t>(u * 15), static_cast<std::uint8_t>(v * 19 + u * 2),
                        static_cast<std::uint8_t>(u * v * 2 + 40)};
  return image;
}

TEST(ImageCodec, JpegsAreWrittenAsLibjpegDoesByDefault) {
  EXPECT_EQ(encode_jpeg(source_of_jpegs(), 90).value(), picture("jpeg_420"));
  EXPECT_EQ(encode_jpeg(source_of_jpegs(), 10).value(), picture("jpeg_low_quality"));
}

TEST(ImageCodec, PngsAreLossless) {
  const Image<Rgb> colour = source_of_jpegs();
  EXPECT_EQ(difference(decode(encode_png(colour).value()).value(), colour), "");
  Image<std::uint16_t> depth(61, 47);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = static_cast<std::uint16_t>(i * 7919);
  const auto read = decode_depth_image(encode_png(depth).value()).value();
  EXPECT_TRUE(std::equal(read.data(), read.data() + read.size(), depth.data(), depth.data() + depth.size()));
}

TEST(ImageCodec, ImagesThatCannotBeEncodedAreAnError) {
  EXPECT_THAT(encode_png(Image<Rgb>()).error().message(), HasSubstr("empty image"));
  EXPECT_THAT(encode_png(Image<std::uint16_t>()).error().message(), HasSubstr("empty image"));
  EXPECT_THAT(encode_jpeg(Image<Rgb>(), 90).error().message(), HasSubstr("empty image"));
  EXPECT_THAT(encode_jpeg(Image<Rgb>(65'501, 1), 90).error().message(), HasSubstr("Maximum supported"));
}

}  // namespace
}  // namespace barehand
