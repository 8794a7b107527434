// Loads the classifier of grasps, and applies it to the features of a pose.
#include "stages/grasp/grasp_classifier.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "io/hand/json_fields.h"

namespace barehand {
namespace {

constexpr int kInterface = 2;  // version of the file's format that this program reads
constexpr double kLargest = 1e3;
constexpr double kLeast = 1e-30;  // least probability of a class
// A joint of which less is known counts as one of which nothing is known [rad]; the training has the same number.
constexpr double kMostDeviation = 0.3;
constexpr const char* kRemedy = "use the file that came with this version of Barehand";

/// Reads the class of each row, and checks that the file is about the classes of this program.
Result<std::vector<int>> read_classes(const json_fields::Object& file, std::size_t most) {
  const auto version = file.number("interface", 0, kLargest);
  if (!version) return tl::unexpected(version.error());
  if (*version != kInterface)
    return fail("has interface " + std::to_string(static_cast<int>(*version)) + ", and " + std::to_string(kInterface) +
                    " is needed",
                file.where, kRemedy);

  // The list must be there, and not be too long.
  if (!file.has("classes") || !file.json["classes"].is_array() || file.json["classes"].size() > most)
    return fail("has no list \"classes\" of at most 64 rows", file.where, kRemedy);

  // Read the classes; every grasp must have a row.
  std::vector<int> classes;
  std::array<bool, kGraspCount> present{};
  for (const auto& name : file.json["classes"]) {
    const auto type = name.is_string() ? grasp_type_from_name(name.get<std::string>()) : std::nullopt;
    if (!type && name != "none") return fail("\"classes\" has " + name.dump() + ", which is none", file.where, kRemedy);
    classes.push_back(type ? 1 + *type : 0);
    present[static_cast<std::size_t>(classes.back())] = true;
  }

  // Report a grasp without a row.
  for (int k = 0; k < kGraspCount; ++k)
    if (!present[static_cast<std::size_t>(k)])
      return fail("\"classes\" lacks " + std::string(grasp_name(k)), file.where, kRemedy);
  return classes;
}

}  // namespace

Result<GraspClassifier> GraspClassifier::load(const std::string& path) {
  const auto json = json_fields::read_json(path);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object()) return fail("is no JSON object", path, kRemedy);
  const json_fields::Object file{*json, path};

  // Read the classes, each of which has a row of weights.
  auto classes = read_classes(file, kMaxRows);
  if (!classes) return tl::unexpected(classes.error());
  const auto rows = static_cast<Eigen::Index>(classes->size());

  // Read the numbers; the first error is returned.
  Result<void> read;
  const auto number = [&](const char* key, double lo, double hi, double& value) {
    const auto got = file.number(key, lo, hi);
    if (got)
      value = *got;
    else if (read)
      read = tl::unexpected(got.error());
  };

  // Lists are read in the same way.
  const auto numbers = [&](const char* key, double lo, double hi, auto&& values) {
    const auto got = file.numbers(key, static_cast<std::size_t>(values.size()), lo, hi);
    if (got)
      std::copy(got->begin(), got->end(), values.data());
    else if (read)
      read = tl::unexpected(got.error());
  };

  // Read the layers; the biases of the hidden one tell its size.
  GraspClassifier out;
  out.classes_ = std::move(*classes);
  const auto hidden = static_cast<Eigen::Index>(file.has("hidden_bias") ? file.json["hidden_bias"].size() : 0);
  if (hidden < 1 || hidden > kMaxRows) return fail("has no list \"hidden_bias\" of 1 to 64 numbers", path, kRemedy);
  Inputs deviation;
  Eigen::Matrix<double, Eigen::Dynamic, kInputs, Eigen::RowMajor> inner(hidden, kInputs);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> outer(rows, hidden);
  out.hidden_bias_.resize(hidden);
  out.output_bias_.resize(rows);

  numbers("mean", -kLargest, kLargest, out.mean_);
  numbers("deviation", 1e-6, kLargest, deviation);
  numbers("hidden_weights", -kLargest, kLargest, inner);
  numbers("hidden_bias", -kLargest, kLargest, out.hidden_bias_);
  numbers("weights", -kLargest, kLargest, outer);
  numbers("bias", -kLargest, kLargest, out.output_bias_);
  numbers("touches", -kLargest, kLargest, std::span(&out.touches_[0][0][0], kGraspCount * kGraspPartCount * 3));
  number("memory", 0.01, kLargest, out.memory_);
  if (!read) return tl::unexpected(read.error());

  // Store the inverse deviations, by which the features are scaled.
  out.scale_ = deviation.cwiseInverse();
  out.hidden_ = inner;
  out.output_ = outer;
  return out;
}

std::array<double, kGraspCount> GraspClassifier::classify(const GraspFeatures& features) const {
  // Calculate the scores of the rows.
  Inputs inputs;
  inputs << features.values, features.deviations.cwiseMin(kMostDeviation);
  const Inputs z = (inputs - mean_).cwiseProduct(scale_);
  const Column hidden = (hidden_.lazyProduct(z) + hidden_bias_).array().tanh().matrix();
  const Column score = output_.lazyProduct(hidden) + output_bias_;

  // Add up the rows of each class.
  std::array<double, kGraspCount> out{};
  const Column p = (score.array() - score.maxCoeff()).exp().matrix();
  for (Eigen::Index row = 0; row < p.size(); ++row)
    out[static_cast<std::size_t>(classes_[static_cast<std::size_t>(row)])] += p[row];
  for (double& value : out) value = std::log(std::max(value / p.sum(), kLeast));
  if (!features.touches) return out;

  // Add what the touches say, so that the probabilities still sum to one.
  for (std::size_t k = 0; k < out.size(); ++k)
    for (std::size_t part = 0; part < features.touches->size(); ++part)
      out[k] += touches_[k][part][static_cast<std::size_t>((*features.touches)[part])];
  const double most = *std::ranges::max_element(out);
  double sum = 0;
  for (const double value : out) sum += std::exp(value - most);
  for (double& value : out) value -= most + std::log(sum);
  return out;
}

}  // namespace barehand
