// Sequences of one hand that moves in the air: fist, open, scan, wave and returns.
#include <iterator>

#include "drivers/synthetic/rendering/stage_set.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

FreeSequence::Setting setting(double duration, std::vector<HandKey> keys, std::uint64_t seed) {
  FreeSequence::Setting s;
  s.duration = duration;
  s.keys = std::move(keys);
  s.seed = seed;
  return s;
}

}  // namespace

/// The motion of the paper's Fig. 6a: two fists, the first made from joined and the second from spread fingers.
std::unique_ptr<Sequence> make_fist(std::uint64_t seed) {
  const Vector3d here(0.0, 0.08, 0.58), forward(0.01, 0.075, 0.57), aside(-0.015, 0.085, 0.585);
  const Vector3d still(0.12, 0, 0.03), leaning(0.2, 0.15, -0.06), turned(0.05, -0.14, 0.08);
  return std::make_unique<FreeSequence>(setting(6.4,
                                                {{0.0, here, still, open_joined()},
                                                 {0.4, here, still, open_joined()},
                                                 {1.5, forward, leaning, fist()},
                                                 {1.8, forward, leaning, fist()},
                                                 {2.9, here, still, open_joined()},
                                                 {3.2, here, still, open_joined()},
                                                 {3.8, aside, turned, open_spread()},
                                                 {4.0, aside, turned, open_spread()},
                                                 {4.9, here, leaning, fist()},
                                                 {5.1, here, leaning, fist()},
                                                 {6.1, here, still, open_spread()}},
                                                seed));
}

/// An open hand that turns slowly about the forearm and nods.
std::unique_ptr<Sequence> make_open(std::uint64_t seed) {
  const Vector3d here(0.0, 0.08, 0.6);
  return std::make_unique<FreeSequence>(setting(6.0,
                                                {{0.0, here, {0, 0, 0}, open_spread()},
                                                 {0.5, here, {0, 0, 0}, open_spread()},
                                                 {1.6, here, {0, 0.9, 0}, open_relaxed()},
                                                 {3.4, here, {0, -0.9, 0}, open_spread()},
                                                 {4.4, here, {0, 0, 0}, open_joined()},
                                                 {5.1, here, {0.4, 0, 0.25}, open_joined()},
                                                 {6.0, here, {0, 0, 0}, open_spread()}},
                                                seed));
}

/// A hand as `barehand calibrate` needs it: it is shown from all sides; then the thumb circles and every joint bends
/// separately from its neighbours (the tendon glides of hand therapy: hook, table top, straight fist and full fist),
/// first with the palm and then with the back towards the camera.
std::unique_ptr<Sequence> make_scan(std::uint64_t seed) {
  // Define the shapes of the hand.
  const Vector3d here(0.0, 0.08, 0.55), palm(0, 0, 0), back(0, 2.9, 0);
  const HandAngles open = open_spread();
  const auto with_thumb = [](const HandAngles& hand, const FingerAngles& thumb) {
    HandAngles result = hand;
    result[0] = thumb;
    return result;
  };

  const auto with_fingers = [](double mcp, double pip, double dip) {
    HandAngles result = open_relaxed();
    for (int f = 1; f < kFingerCount; ++f) result[f].flexion = {mcp, pip, dip};
    return result;
  };

  const HandAngles hook = with_fingers(0.05, 1.5, 0.95), table_top = with_fingers(1.25, 0.1, 0.05),
                   straight_fist = with_fingers(1.25, 1.5, 0.05);

  // Define functions that append keyframes.
  std::vector<HandKey> keys;
  double time = 0;
  const auto show = [&](double seconds, const Vector3d& turn, const HandAngles& angles) {
    keys.push_back({time, here, turn, angles});
    time += 0.8 * seconds;
  };
  const auto bend_all = [&](const Vector3d& side) {
    // Bend the thumb while the fingers are out of its way.
    show(0.7, side, with_thumb(open, {0.5, {-0.25, 0, 0}}));
    show(0.7, side + Vector3d(0, 0.4, 0), with_thumb(open, {0.5, {0.5, 0, 0}}));
    show(0.7, side, with_thumb(open, {-0.3, {0.5, 0.1, 0.1}}));
    show(0.7, side + Vector3d(0, -0.4, 0), with_thumb(open, {-0.3, {-0.25, 0, 0}}));
    show(0.8, side, with_thumb(open, {0.15, {0, 0, 1.3}}));
    show(0.8, side + Vector3d(0, -0.5, 0), with_thumb(open, {0.15, {0, 0.85, 1.2}}));
    show(0.8, side + Vector3d(0, 0.5, 0), with_thumb(open, {0.15, {0.1, 0.85, 0}}));

    // Bend the fingers: hook, table top, straight fist and full fist.
    show(1.0, side, open);
    show(0.8, side + Vector3d(0, 0.5, 0), hook);
    show(1.0, side + Vector3d(0, -0.5, 0), hook);
    show(0.8, side + Vector3d(0, -0.5, 0), table_top);
    show(1.0, side + Vector3d(0.3, 0.4, 0), table_top);
    show(0.8, side + Vector3d(0, 0.4, 0), straight_fist);
    show(0.8, side + Vector3d(0, -0.4, 0), fist());
    show(1.0, side + Vector3d(0.2, 0.3, 0), fist());
    show(1.0, side, open);
  };

  // Show the hand from all sides; then bend it, seen from the palm and from the back.
  show(0.6, palm, open);
  show(1.2, palm, open);
  show(1.8, {0, 1.1, 0}, open);
  show(1.2, {0, -1.1, 0}, open);
  show(1.0, {0.5, 0, 0}, open_joined());
  show(1.0, {-0.6, 0, 0.2}, open_relaxed());

  // Bend the fingers in both views, with an open hand between them.
  bend_all(palm);
  show(2.0, palm, open);
  bend_all(back);
  show(1.8, back, open_joined());
  show(0.2, palm, open);
  return std::make_unique<FreeSequence>(setting(time, std::move(keys), seed));
}

/// A hand that waves, leaves the view on the right and comes back.
std::unique_ptr<Sequence> make_wave(std::uint64_t seed) {
  const Vector3d here(-0.02, 0.08, 0.6), edge(0.2, 0.1, 0.6), away(0.62, 0.12, 0.6);
  return std::make_unique<FreeSequence>(setting(8.0,
                                                {{0.0, here, {0, 0, 0}, open_spread()},
                                                 {0.4, here, {0, 0, 0}, open_spread()},
                                                 {0.9, here, {0, 0, 0.4}, open_spread()},
                                                 {1.4, here, {0, 0, -0.35}, open_spread()},
                                                 {1.9, here, {0, 0, 0.4}, open_spread()},
                                                 {2.4, here, {0, 0, 0}, open_relaxed()},
                                                 {3.0, edge, {0, 0, 0.3}, open_relaxed()},
                                                 {3.8, away, {0, 0, 0.5}, open_relaxed()},
                                                 {4.8, away, {0, 0, 0.5}, open_relaxed()},
                                                 {6.0, here, {0, 0, 0}, open_spread()},
                                                 {6.6, here, {0, 0.5, 0}, open_spread()},
                                                 {7.4, here, {0, 0, 0}, open_spread()}},
                                                seed));
}

/// A hand that leaves the view and comes back ten times, each time at another position, distance and orientation.
std::unique_ptr<Sequence> make_returns(std::uint64_t seed) {
  struct Visit {
    Vector3d from, here, turn;
    HandAngles angles;
  };

  // Choose where the hand enters the view from, and its position, orientation and shape there.
  const Vector3d left(-0.75, 0.1, 0.6), right(0.75, 0.1, 0.6), below(0.05, 0.65, 0.6);

  const Visit visits[] = {{right, {0.0, 0.08, 0.6}, {0, 0, 0}, open_spread()},
                          {right, {0.05, 0.08, 0.5}, {0.1, 0, 0.4}, open_relaxed()},
                          {below, {0.0, 0.1, 0.7}, {0, 0.2, -0.3}, open_joined()},
                          {left, {-0.06, 0.06, 0.55}, {0.3, 0, 0}, open_spread()},
                          {right, {0.08, 0.1, 0.65}, {0, 2.9, 0}, open_relaxed()},
                          {below, {-0.03, 0.09, 0.45}, {0, 0, 0.7}, open_spread()},
                          {left, {0.0, 0.07, 0.8}, {0, 0.6, 0.2}, open_relaxed()},
                          {below, {0.02, 0.08, 0.6}, {0.2, 0.1, -0.6}, fist()},
                          {right, {-0.05, 0.12, 0.5}, {0, -0.7, 0}, open_joined()},
                          {below, {0.04, 0.06, 0.7}, {-0.3, 3.0, 0.2}, open_spread()},
                          {left, {0.0, 0.08, 0.55}, {0, 0, 0.2}, open_relaxed()}};

  // Add the keyframes of each visit: enter, turn a little, leave.
  constexpr double kVisit = 3.5;  // time from one visit to the next [s]; the last 1.4 s are out of view
  std::vector<HandKey> keys;
  for (const Visit& visit : visits) {
    const double start = kVisit * static_cast<double>(keys.size()) / 4;
    keys.push_back({start, visit.from, visit.turn, visit.angles});
    keys.push_back({start + 0.8, visit.here, visit.turn, visit.angles});
    keys.push_back({start + 1.3, visit.here, visit.turn + Vector3d(0.1, 0.1, 0.1), open_relaxed()});
    keys.push_back({start + 2.1, visit.from, visit.turn, open_relaxed()});
  }

  // The first visit begins in view.
  keys.front().position = visits[0].here;
  return std::make_unique<FreeSequence>(setting(kVisit * std::size(visits), std::move(keys), seed));
}

}  // namespace barehand::synthetic
