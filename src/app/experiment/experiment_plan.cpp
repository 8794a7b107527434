// The sequences and variants of each experiment of the paper.
#include "app/experiment/experiment_plan.h"

#include <algorithm>
#include <filesystem>

#include "app/shared/run_inputs.h"

namespace barehand {
namespace {

/// The simulated sequences that an experiment uses.
std::vector<std::string> sequences_of(const std::string& experiment) {
  if (experiment == "fist") return {"fist"};
  if (experiment == "grasp") return {"grasp_mug", "grasp_ball", "grasp_pliers"};
  if (experiment == "ablation") return {"fist", "occlusion_3", "grasp_ball", "grasp_mug"};
  std::vector<std::string> levels;
  for (int degree = 0; degree <= 6; ++degree) levels.push_back("occlusion_" + std::to_string(degree));
  return levels;
}

/// Reads the configurations; each is labelled by its file name.
Result<std::vector<ExperimentVariant>> read_variants(const std::vector<std::string>& configs) {
  std::vector<ExperimentVariant> variants;
  for (const std::string& name : configs) {
    const auto config = read_configuration(name);
    if (!config) return tl::unexpected(config.error());
    const std::string label = std::filesystem::path(name).stem().string();
    const bool twice = std::any_of(variants.begin(), variants.end(),
                                   [&](const ExperimentVariant& variant) { return variant.label == label; });
    if (twice) return fail("two configurations are called " + label, "--configs", "give each once, under its own name");
    variants.push_back({label, *config});
  }
  return variants;
}

}  // namespace

const std::vector<std::string>& experiment_names() {
  static const std::vector<std::string> kNames = {"fist", "occlusion", "grasp", "ablation"};
  return kNames;
}

Result<ExperimentPlan> plan_experiment(const std::string& name, const std::vector<std::string>& configs) {
  auto variants = read_variants(configs);
  if (!variants) return tl::unexpected(variants.error());
  if (name == "ablation") {
    if (variants->size() != 1) return fail("an ablation starts from one configuration", "--configs", "give one");
    variants = ablations(variants->front().config);
  }
  return ExperimentPlan{name, sequences_of(name), std::move(*variants)};
}

std::vector<ExperimentVariant> ablations(const Config& complete) {
  // The first variant is the complete method.
  std::vector<ExperimentVariant> variants = {{"complete", complete}};
  const auto variant = [&](const char* label) -> Config& {
    variants.push_back({label, complete});
    return variants.back().config;
  };
  const auto without = [&](const char* label, auto change) { change(variant(label).tracker); };

  // Variants that each lack one of the parts that estimate the pose.
  without("no_sampling", [](TrackerParams& p) { p.sampling = false; });
  without("no_refinement", [](TrackerParams& p) { p.refinement.enabled = false; });
  without("no_icp", [](TrackerParams& p) { p.icp.enabled = false; });
  without("no_velocity", [](TrackerParams& p) { p.prediction.velocity = false; });

  // Variants that each lack one of the parts that treat hidden fingers, contact and the person's hand shape.
  without("no_following", [](TrackerParams& p) { p.hidden_follow = false; });
  without("no_contact", [](TrackerParams& p) { p.refinement.energy.sigma_overlap = 10; });
  without("no_scan", [](TrackerParams& p) { p.shape_fit.scans = 0; });

  // Variants that each lack one of the rules for starting a track, choosing between poses and finding a lost hand.
  variant("no_detection").detection.enabled = false;
  without("no_ambiguous_search", [](TrackerParams& p) { p.choice.ambiguity_margin = 1000; });
  without("no_uncrossing", [](TrackerParams& p) { p.choice.uncross_fingers = false; });
  without("no_neutral_pose", [](TrackerParams& p) { p.neutral_joints = false; });
  without("one_search", [](TrackerParams& p) { p.search_attempts = 1; });
  without("no_confirmation", [](TrackerParams& p) { p.choice.confirmation_factor = 0; });
  without("no_side_check", [](TrackerParams& p) { p.side_check = false; });
  without("no_size_check", [](TrackerParams& p) { p.size_check = false; });

  // Variants that each lack one of the additions to the local trackers of the paper (Sec. 4).
  without("cylinder_samples", [](TrackerParams& p) { p.skin = "cylinders"; });
  without("palm_unobserved", [](TrackerParams& p) { p.segment_tracker.observe_palm = false; });
  without("missing_is_background", [](TrackerParams& p) { p.segment_tracker.missing_depth = "background"; });
  return variants;
}

}  // namespace barehand
