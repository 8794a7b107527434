#include <gmock/gmock.h>

#include <filesystem>
#include <limits>

#include "app/bench/bench_report.h"
#include "app/bench/bench_sweep.h"
#include "io/hand/json_fields.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;

/// Frames of 4x2 pixels whose depth values number the pixels.
FrameStore stored(int frames) {
  FrameStore store;
  for (int k = 0; k < frames; ++k) {
    auto frame = std::make_shared<RgbdFrame>();
    frame->number = k;
    frame->camera = {4, 2, 100, 100, 2, 1};
    frame->depth.reset(4, 2);
    for (std::size_t i = 0; i < frame->depth.size(); ++i) frame->depth[i] = static_cast<std::uint16_t>(i);
    store.frames.push_back(std::move(frame));
  }
  return store;
}

std::vector<std::int64_t> numbers_of(FrameSource& source) {
  std::vector<std::int64_t> numbers;
  while (true) {
    const SourceEvent event = source.next(std::chrono::milliseconds(0));
    if (std::holds_alternative<EndOfStream>(event)) return numbers;
    numbers.push_back(std::get<FramePtr>(event)->number);
  }
}

TEST(MemorySource, PlaysForthAndBackWithoutAJump) {
  const FrameStore store = stored(3);
  const ManualClock clock;
  MemorySource source(store, {8, std::nullopt}, clock);
  EXPECT_FALSE(source.live());
  EXPECT_THAT(numbers_of(source), ::testing::ElementsAre(0, 1, 2, 1, 0, 1, 2, 1));
}

TEST(MemorySource, AtARateAFrameComesWhenItIsDue) {
  const FrameStore store = stored(2);
  ManualClock clock(1'000'000);
  MemorySource source(store, {3, 10.0}, clock);
  EXPECT_TRUE(source.live());
  const auto no_wait = std::chrono::milliseconds(0);
  ASSERT_TRUE(std::holds_alternative<FramePtr>(source.next(no_wait)));
  EXPECT_TRUE(std::holds_alternative<Timeout>(source.next(no_wait)));
  clock.advance(130'000);  // 30 ms after the frame is due
  const SourceEvent second = source.next(no_wait);
  ASSERT_TRUE(std::holds_alternative<FramePtr>(second));
  EXPECT_EQ(std::get<FramePtr>(second)->number, 1);
  EXPECT_EQ(std::get<FramePtr>(second)->utime, 1'100'000) << "captured when due, not when fetched";
}

TEST(MemorySource, DecimationKeepsTheRays) {
  const FrameStore small = decimated(stored(1), 2);
  const RgbdFrame& frame = *small.frames[0];
  EXPECT_EQ(frame.depth.width(), 2);
  EXPECT_EQ(frame.depth.height(), 1);
  EXPECT_EQ(frame.depth.at(1, 0), 2);  // pixel (2, 0) of the original
  const Intrinsics full{4, 2, 100, 100, 2, 1};
  EXPECT_TRUE(frame.camera.unproject(1, 0, 0.5).isApprox(full.unproject(2, 0, 0.5)));
}

TEST(BenchSweep, VariesOneParameterOfTheBaseCase) {
  BenchCase base;
  base.threads = 3;
  const auto cases = parse_sweep("samples=20,60", base);
  ASSERT_TRUE(cases.has_value()) << cases.error().message();
  ASSERT_EQ(cases->size(), 2u);
  EXPECT_EQ((*cases)[1].config.tracker.segment_tracker.samples, 60);
  EXPECT_EQ((*cases)[1].value, 60);
  EXPECT_EQ((*cases)[1].threads, 3);
  EXPECT_EQ((*cases)[1].config.tracker.fusion.levels, base.config.tracker.fusion.levels);
}

TEST(BenchSweep, RefusesWhatCannotBeRun) {
  EXPECT_THAT(parse_sweep("hats=1", {}).error().message(), HasSubstr("samples, levels"));
  EXPECT_FALSE(parse_sweep("samples", {}).has_value());
  for (const char* value : {"0", "-3", "many", "20x", "99999999999999", "100001"})
    EXPECT_FALSE(parse_sweep(std::string("samples=") + value, {}).has_value()) << value;
  EXPECT_FALSE(parse_sweep("threads=0", {}).has_value());
}

BenchReport small_report() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  BenchReport report;
  report.conditions.frames = 100;
  for (const double value : {0.0, 10.0, 20.0, 40.0}) {
    // The name of the case, and figures that grow with the swept value.
    BenchRow row;
    row.sweep = value == 0 ? "" : "samples";
    row.value = value;
    row.config = "default.yaml";
    row.result.cpu_seconds_per_frame = 0.01 + value * 1e-4;
    row.result.resident_mb = {50, 51};
    if (value == 0) row.result.first_pose_seconds = 0.05;

    // The times of its stages; how full the queue was is missing.
    row.result.health.stages = {{"track", {100, 0.008, 0.007, 0.009, 0.010, 0.011}, 0}};
    row.result.health.queues = {{"input", 1, 0, 0, 0, 0, {0, kNaN, kNaN, kNaN, kNaN, kNaN}}};
    row.result.health.latency = {100, 0.012, 0.011, 0.013, 0.014, 0.015};
    report.rows.push_back(row);
  }
  report.observers.push_back({"default.yaml", 2, {"Card 9", "OpenGL ES 3.2", false}, {640, {0.3e-3, 0.1e-3}}});
  return report;
}

TEST(BenchReport, WritesFiguresInMillisecondsAndDrawsThem) {
  const test::TempFolder folder;
  ASSERT_TRUE(write_bench_json(small_report(), folder / "bench.json").has_value());
  const auto json = json_fields::read_json(folder / "bench.json");
  ASSERT_TRUE(json.has_value()) << json.error().message();
  EXPECT_EQ(json->at("cases")[0].at("stages_ms").at("track").at("p99"), 10);
  EXPECT_EQ(json->at("cases")[1].at("cpu_ms_per_frame"), 11);
  EXPECT_EQ(json->at("cases")[0].at("first_pose_ms"), 50);
  EXPECT_TRUE(json->at("cases")[1].at("first_pose_ms").is_null());
  EXPECT_EQ(json->at("observers")[0].at("samples"), 640);
  EXPECT_EQ(json->at("observers")[0].at("cpu_ms"), 0.3);
  EXPECT_EQ(json->at("observers")[0].at("device_ms"), 0.1);
  const auto drawn = draw_bench(folder / "bench.json", folder / "plots");
  ASSERT_TRUE(drawn.has_value()) << drawn.error().message();
  for (const char* name : {"stages.png", "memory.png", "samples.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / "plots/" + name)) << name;
}

TEST(BenchReport, SaysWhichObserverIsFaster) {
  ObserverRow row = small_report().observers[0];
  EXPECT_EQ(bench_text(row),
            "default.yaml, 640 samples compared, 2 threads, Card 9: a call takes 0.30 ms on the CPU and 0.10 ms on the "
            "device, which is 3.0 times as fast\n");
  row.device.software = true;
  EXPECT_THAT(bench_text(row), HasSubstr("Card 9 (software, which observer: auto never uses): "));
}

TEST(BenchReport, WillNotDrawSomethingElse) {
  const test::TempFolder folder;
  const std::string path = folder / "no_bench.json";
  ASSERT_TRUE(json_fields::write_json(path, {{"cases", {{{"a", 1}}}}}).has_value());
  const auto drawn = draw_bench(path, folder / "no_plots");
  ASSERT_FALSE(drawn.has_value());
  EXPECT_THAT(drawn.error().message(), HasSubstr("not a report of barehand bench"));
}

}  // namespace
}  // namespace barehand
