// Loads the classifier of grasps, and applies it to the features of a pose.
#include "stages/grasp/grasp_classifier.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/hand/json_fields.h"

namespace barehand {
namespace {

constexpr int kInterface = 1;  // version of the file's format that this program reads
constexpr double kLargest = 1e3;
constexpr double kLeast = 1e-30;  // least probability of a class
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

  // Read the weights of the rows, and the spread and memory.
  GraspClassifier out;
  out.classes_ = std::move(*classes);
  out.bias_.resize(rows);
  Eigen::Matrix<double, kGraspFeatureCount, 1> deviation;
  Eigen::Matrix<double, Eigen::Dynamic, kGraspFeatureCount, Eigen::RowMajor> weights(rows, kGraspFeatureCount);

  numbers("mean", -kLargest, kLargest, out.mean_);
  numbers("deviation", 1e-6, kLargest, deviation);
  numbers("weights", -kLargest, kLargest, weights);
  numbers("bias", -kLargest, kLargest, out.bias_);
  number("spread", 0, kLargest, out.spread_);
  number("memory", 0.01, kLargest, out.memory_);
  if (!read) return tl::unexpected(read.error());

  // Store the inverse deviations, by which the features are scaled.
  out.scale_ = deviation.cwiseInverse();
  out.weights_ = weights;
  return out;
}

std::array<double, kGraspCount> GraspClassifier::classify(const GraspFeatures& features) const {
  // Scores of the rows, smaller where the features are uncertain.
  using Column = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxRows>;
  const auto z = (features.values - mean_).cwiseProduct(scale_).eval();
  const auto spread = (scale_.asDiagonal() * features.spread).eval();
  Column score = (weights_.lazyProduct(z) + bias_).array();
  for (Eigen::Index row = 0; row < score.size(); ++row) {
    const double error = spread_ * spread_ * weights_.row(row).lazyProduct(spread).squaredNorm();
    score[row] /= std::sqrt(1 + std::numbers::pi / 8 * error);
  }

  // Add up the rows of each class.
  std::array<double, kGraspCount> out{};
  const Column p = (score - score.maxCoeff()).exp();
  for (Eigen::Index row = 0; row < p.size(); ++row)
    out[static_cast<std::size_t>(classes_[static_cast<std::size_t>(row)])] += p[row] / p.sum();
  for (double& value : out) value = std::log(std::max(value, kLeast));
  return out;
}

}  // namespace barehand
