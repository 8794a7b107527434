#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "math/se3.h"

namespace barehand::json_fields {

using Json = nlohmann::json;

/// The value for a message. Lists and objects are not written out, since they may be long, and nested without limit.
std::string shown(const Json& value);

/// Reads and parses a file. Errors: a missing file, or a syntax error with its line and column.
Result<Json> read_json(const std::string& path);
/// Parses a text. `where`: origin of the text, for messages.
Result<Json> parse_json(const std::string& text, const std::string& where);
/// Writes `json` to a file, replacing one that is there; a directory that does not exist or a full disk is an error.
Result<void> write_json(const std::string& path, const Json& json);

/// A JSON object together with its origin, so that every message names file, object and key.
struct Object {
  const Json& json;
  std::string where;  ///< for example "hand.json: segment index_distal"

  /// Members by key, checked for type and range; a missing or wrong one is an error, except with a `fallback`.
  Result<double> number(const char* key, double lo, double hi) const;
  Result<double> number_or(const char* key, double fallback, double lo, double hi) const;
  Result<std::vector<double>> numbers(const char* key, std::size_t count, double lo, double hi) const;
  Result<std::string> text(const char* key) const;
  Result<bool> boolean(const char* key) const;
  Result<SE3> transform(const char* key) const;
  bool has(const char* key) const { return json.contains(key); }
};

/// The 4x4 matrix, row by row, rounded to 1e-9; Object::transform() reads this form.
Json to_json(const SE3& T);
/// A number rounded to a multiple of 1e-9, so that its decimal form is short.
double rounded(double value);

}  // namespace barehand::json_fields
