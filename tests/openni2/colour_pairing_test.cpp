#include "drivers/openni2/frames/colour_pairing.h"

#include <gtest/gtest.h>

#include <string>

namespace barehand {
namespace {

using Pairing = ColourPairing<std::string>;
constexpr std::int64_t kPeriod = 33'000;

Pairing::Stamped at(std::int64_t device_us, std::int64_t arrival_us, const std::string& name) {
  return {device_us, arrival_us, name};
}

std::string text(const std::optional<Pairing::Pair>& pair) {
  return pair ? pair->depth.picture + "+" + pair->colour.value_or("-") : "none";
}

TEST(ColourPairing, WhicheverComesFirstWaitsForTheOther) {
  Pairing pairing(kPeriod);
  EXPECT_EQ(text(pairing.add_depth(at(1000, 5000, "d1"))), "none");
  EXPECT_EQ(text(pairing.add_colour(at(1200, 6000, "c1"))), "d1+c1");
  EXPECT_EQ(text(pairing.add_colour(at(34'000, 38'000, "c2"))), "none");
  EXPECT_EQ(text(pairing.add_depth(at(34'100, 39'000, "d2"))), "d2+c2");
}

TEST(ColourPairing, ColourOfAnotherExposureIsNotTaken) {
  Pairing pairing(kPeriod);
  pairing.add_colour(at(1000, 5000, "c1"));
  EXPECT_EQ(text(pairing.add_depth(at(34'000, 38'000, "d2"))), "none");
  EXPECT_EQ(text(pairing.due(39'000)), "none");
  // The next exposure: the old one has waited long enough.
  EXPECT_EQ(text(pairing.add_depth(at(67'000, 71'000, "d3"))), "d2+-");
  EXPECT_EQ(text(pairing.add_colour(at(67'000, 72'000, "c3"))), "d3+c3");
}

TEST(ColourPairing, DepthThatFindsItsColourThereIsNotLostBehindAnOlderOne) {
  Pairing pairing(kPeriod);
  pairing.add_colour(at(0, 4000, "c0"));
  pairing.add_depth(at(33'000, 37'000, "d1"));
  pairing.add_colour(at(66'000, 70'000, "c2"));
  EXPECT_EQ(text(pairing.add_depth(at(66'000, 71'000, "d2"))), "d1+-");
  EXPECT_EQ(text(pairing.due(71'000)), "d2+c2");
}

TEST(ColourPairing, WaitsOnePeriodAtMost) {
  Pairing pairing(kPeriod);
  pairing.add_colour(at(0, 4000, "c0"));
  pairing.add_depth(at(33'000, 37'000, "d1"));
  EXPECT_EQ(pairing.due_at(38'000), 37'000 + kPeriod);
  EXPECT_EQ(text(pairing.due(37'000 + kPeriod - 1)), "none");
  EXPECT_EQ(text(pairing.due(37'000 + kPeriod)), "d1+-");
  EXPECT_FALSE(pairing.due_at(80'000));
}

TEST(ColourPairing, DoesNotWaitForColourThatStopped) {
  Pairing pairing(kPeriod);
  EXPECT_EQ(text(pairing.add_depth(at(0, 4000, "d0"))), "none");
  EXPECT_EQ(text(pairing.due(4000)), "d0+-");  // no colour has ever arrived
  pairing.add_colour(at(33'000, 37'000, "c1"));
  const std::int64_t later = 37'000 + Pairing::kColourGone;
  pairing.add_depth(at(600'000, later, "d2"));
  EXPECT_EQ(text(pairing.due(later)), "d2+-");
}

TEST(ColourPairing, AColourPictureBelongsToOneDepthPictureOnly) {
  Pairing pairing(kPeriod);
  pairing.add_colour(at(0, 0, "c0"));
  EXPECT_EQ(text(pairing.add_depth(at(0, 0, "d0"))), "d0+c0");
  EXPECT_EQ(text(pairing.add_depth(at(10'000, 10'000, "d1"))), "none");
  EXPECT_EQ(text(pairing.flush()), "d1+-");
}

}  // namespace
}  // namespace barehand
