#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

namespace barehand {

/// Finds the colour image that belongs to each depth image by the sensor's time stamps. A depth image waits for its
/// colour only briefly, and not at all once colour has stopped, since tracking needs depth first of all. `Picture` is
/// the type of a handle to an image, empty by default. Times are in microseconds: `device_us` by the sensor's clock,
/// all others by the host's steady clock.
template <class Picture>
class ColourPairing {
 public:
  struct Stamped {
    std::int64_t device_us = 0, arrival_us = 0;
    Picture picture{};
  };
  struct Pair {
    Stamped depth;
    std::optional<Picture> colour;
  };

  /// `period_us`: time between two depth frames. Colour belongs to depth if their stamps differ by less than half of
  /// it.
  explicit ColourPairing(std::int64_t period_us) : period_us_(period_us) {}

  /// Adds a depth image. Returns a pair that is now complete, or else the previous depth image, which does not wait any
  /// longer.
  std::optional<Pair> add_depth(Stamped depth) {
    std::optional<Pair> before;
    if (waiting_) before = flush();
    waiting_ = std::move(depth);
    if (before) return before;  // the new depth image waits for its colour or the next call of due()
    return matched();
  }
  /// Adds a colour image. Returns the pair that it completes.
  std::optional<Pair> add_colour(Stamped colour) {
    colour_ = std::move(colour);
    colour_taken_ = false;
    return matched();
  }
  /// The waiting depth image with its colour, if that has arrived.
  std::optional<Pair> matched() {
    if (!waiting_ || !colour_ || colour_taken_ || 2 * std::abs(waiting_->device_us - colour_->device_us) >= period_us_)
      return std::nullopt;
    colour_taken_ = true;
    return Pair{std::move(*std::exchange(waiting_, std::nullopt)), std::exchange(colour_->picture, Picture{})};
  }
  /// The waiting depth image, with or without its colour.
  std::optional<Pair> flush() {
    if (auto pair = matched()) return pair;
    if (!waiting_) return std::nullopt;
    return Pair{std::move(*std::exchange(waiting_, std::nullopt)), std::nullopt};
  }
  /// The waiting depth image if its colour has arrived or is no longer expected.
  std::optional<Pair> due(std::int64_t now_us) {
    if (auto pair = matched()) return pair;
    if (!waiting_ || (colour_runs(now_us) && now_us - waiting_->arrival_us < period_us_)) return std::nullopt;
    return flush();
  }
  /// The latest time at which `due` must be called; none if nothing waits.
  std::optional<std::int64_t> due_at(std::int64_t now_us) const {
    if (!waiting_) return std::nullopt;
    return colour_runs(now_us) ? waiting_->arrival_us + period_us_ : now_us;
  }
  /// Whether colour has arrived within the last kColourGone.
  bool colour_runs(std::int64_t now_us) const { return colour_ && now_us - colour_->arrival_us < kColourGone; }

  static constexpr std::int64_t kColourGone = 500'000;

 private:
  std::int64_t period_us_;
  std::optional<Stamped> waiting_, colour_;
  bool colour_taken_ = false;
};

}  // namespace barehand
