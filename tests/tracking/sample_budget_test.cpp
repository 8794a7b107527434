#include "tracking/hypotheses/sample_budget.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

namespace barehand {
namespace {

using ::testing::HasSubstr;

/// Simulates levels whose time grows with the square of the number of samples, as that of the fusion on the CPU: 1 ms
/// for 1000 samples.
class SampleBudgetOf : public ::testing::Test {
 protected:
  SampleBudget budget(int samples, int on_device, double budget_ms) {
    SegmentTrackerParams params;
    params.samples = samples;
    params.samples_on_device = on_device;
    params.level_budget_ms = budget_ms;
    return SampleBudget(params, clock_);
  }
  SampleBudget::Level level(int first_us = 0) {
    return [this, first_us](int samples) {
      const bool first = std::find(tried_.begin(), tried_.end(), samples) == tried_.end();
      clock_->advance(static_cast<std::int64_t>(samples) * samples / 1000 + (first ? first_us : 0));
      tried_.push_back(samples);
    };
  }
  std::shared_ptr<ManualClock> clock_ = std::make_shared<ManualClock>();
  std::vector<int> tried_;
};

TEST_F(SampleBudgetOf, CpuHasItsOwnNumber) {
  SampleBudget budget = this->budget(100, 1000, 0.5);
  EXPECT_FALSE(budget.to_be_measured(false));
  EXPECT_EQ(budget.samples(false), 100);
  EXPECT_EQ(budget.samples(true), 100) << "not measured yet";
  budget.measure(level());
  EXPECT_EQ(budget.samples(false), 100);
}

TEST_F(SampleBudgetOf, DeviceHasAsManyAsFitIntoALevel) {
  SampleBudget budget = this->budget(100, 1000, 0.25);  // 500 samples
  ASSERT_TRUE(budget.to_be_measured(true));
  budget.measure(level());
  EXPECT_LE(budget.samples(true), 500);
  EXPECT_GT(1.2 * budget.samples(true), 500);
  EXPECT_THAT(budget.to_text(), HasSubstr(std::to_string(budget.samples(true)) + " samples per segment and level"));
  EXPECT_THAT(budget.to_text(), HasSubstr("of 0.25 ms"));
  EXPECT_FALSE(budget.to_be_measured(true)) << "once";
  EXPECT_LE(*std::max_element(tried_.begin(), tried_.end()), 600) << "no more than a step beyond the budget is tried";
}

TEST_F(SampleBudgetOf, NoMoreThanAllowedWhateverTheBudget) {
  SampleBudget budget = this->budget(100, 130, 1000);
  budget.measure(level());
  EXPECT_EQ(budget.samples(true), 130);
}

TEST_F(SampleBudgetOf, NeverFewerThanOnTheCpu) {
  SampleBudget tight = this->budget(100, 1000, 0.001);
  tight.measure(level());
  EXPECT_EQ(tight.samples(true), 100);
  EXPECT_THAT(tight.to_text(), HasSubstr("more would take longer than 0.001 ms"));
  for (const int on_device : {0, 60, 100}) {
    const SampleBudget none = budget(100, on_device, 1000);
    EXPECT_FALSE(none.to_be_measured(true)) << on_device;
    EXPECT_EQ(none.samples(true), 100);
  }
}

TEST_F(SampleBudgetOf, FewSamplesGrow) {
  SampleBudget budget = this->budget(1, 50, 1000);
  budget.measure(level());
  EXPECT_EQ(budget.samples(true), 50);
}

TEST_F(SampleBudgetOf, FirstRunWithMoreSamplesDoesNotCount) {
  SampleBudget budget = this->budget(100, 1000, 0.25);
  budget.measure(level(50'000));
  EXPECT_GT(1.2 * budget.samples(true), 500);
}

}  // namespace
}  // namespace barehand
