#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "math/se3.h"

namespace barehand::json_fields {

using Json = nlohmann::json;

/// Reads and parses a file; a missing file and a syntax error (with its line) become errors.
Result<Json> read_json(const std::string& path);
/// `where`: what the text comes from, for messages.
Result<Json> parse_json(const std::string& text, const std::string& where);
/// Writes `json` to a file, replacing one that is there; a directory that does not exist or a full disk is an error.
Result<void> write_json(const std::string& path, const Json& json);

/// One JSON object and where it stands, so that every message names file, object and key.
struct Object {
  const Json& json;
  std::string where;  ///< "hand.json: segment index_distal"

  Result<double> number(const char* key, double lo, double hi) const;
  Result<double> number_or(const char* key, double fallback, double lo, double hi) const;
  Result<std::vector<double>> numbers(const char* key, std::size_t count, double lo, double hi) const;
  Result<std::string> text(const char* key) const;
  Result<SE3> transform(const char* key) const;
  bool has(const char* key) const { return json.contains(key); }
};

/// 4x4 row-major, rounded to 1e-9: what `Object::transform` reads.
Json to_json(const SE3& T);
/// Short decimal form of a quantity: rounded to 1e-9.
double rounded(double value);

}  // namespace barehand::json_fields
