#pragma once

#include <memory>

#include "app/sink.h"
#include "io/overlay.h"
#include "io/result_table.h"

namespace barehand {

/// --result: the table of formats.md.
class ResultTableSink : public Sink {
 public:
  static Result<std::unique_ptr<Sink>> create(const std::string& path);
  std::string name() const override { return "result table"; }
  Result<void> consume(const TrackedFrame& tracked) override { return writer_.write(*tracked.estimate); }

 private:
  explicit ResultTableSink(TableWriter writer) : writer_(std::move(writer)) {}
  TableWriter writer_;
};

/// --overlay: the tracked hand drawn over the images, on the first and then on each `every`-th frame.
class OverlaySink : public Sink {
 public:
  static Result<std::unique_ptr<Sink>> create(const std::string& path, double fps, int every);
  std::string name() const override { return "overlay"; }
  Result<void> consume(const TrackedFrame& tracked) override {
    if (seen_++ % every_ != 0) return {};
    return writer_.write(*tracked.frame, *tracked.estimate);
  }
  Result<void> finish() override { return writer_.finish(); }

 private:
  OverlaySink(OverlayWriter writer, int every) : writer_(std::move(writer)), every_(every) {}
  OverlayWriter writer_;
  const std::int64_t every_;
  std::int64_t seen_ = 0;
};

/// --save-hand: the hand that was tracked with in the end, as fitted to the person.
class SaveHandSink : public Sink {
 public:
  explicit SaveHandSink(std::string path) : path_(std::move(path)) {}
  std::string name() const override { return "hand profile"; }
  Result<void> consume(const TrackedFrame& tracked) override {
    if (tracked.estimate->has_pose()) profile_ = tracked.estimate->profile;
    return {};
  }
  Result<void> finish() override;

 private:
  const std::string path_;
  std::shared_ptr<const HandProfile> profile_;
};

}  // namespace barehand
