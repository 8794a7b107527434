// Reads fields of JSON objects, with error messages that name file, object and key.
#include "io/hand/json_fields.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include "io/atomic_file.h"
#include "io/file_bytes.h"

namespace barehand::json_fields {

using namespace std::string_literals;

namespace {

std::string range_text(double lo, double hi) {
  std::ostringstream text;
  text << "a number from " << lo << " to " << hi;
  return text.str();
}

tl::unexpected<Error> bad(const Object& object, const char* key, const std::string& what, const std::string& wanted) {
  return fail(std::string("\"").append(key).append("\" ").append(what), object.where, "it must be " + wanted);
}

Result<double> checked(const Object& object, const char* key, const Json& value, double lo, double hi) {
  if (!value.is_number()) return bad(object, key, "is " + shown(value) + ", not a number", range_text(lo, hi));
  const double number = value.get<double>();
  if (!(number >= lo && number <= hi))  // rejects NaN, too
    return bad(object, key, "is " + value.dump(), range_text(lo, hi));
  return number;
}

/// Describes the position of a byte in a text by its line and column. `byte` is the byte's number, from 1.
std::string place_in(const std::string& text, std::size_t byte) {
  const std::string_view before = std::string_view(text).substr(0, std::max<std::size_t>(byte, 1) - 1);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t column = before.size() - (before.rfind('\n') + 1);  // npos + 1 is 0: the first line
  return "line " + std::to_string(line) + ", column " + std::to_string(column + 1);
}

}  // namespace

std::string shown(const Json& value) {
  return value.is_structured() ? std::string("an ") + value.type_name() : value.dump();
}

Result<Json> read_json(const std::string& path) {
  return read_text(path).and_then([&](const std::string& text) { return parse_json(text, path); });
}

Result<Json> parse_json(const std::string& text, const std::string& where) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) return fail("is empty", where, "it must hold JSON");
    return fail("is not valid JSON at " + place_in(text, error.byte), where, "correct that place");
  } catch (const Json::out_of_range&) {
    return fail("holds a number that is too large", where, "correct it");
  }
}

Result<void> write_json(const std::string& path, const Json& json) {
  // A path in the text may be invalid UTF-8; its invalid bytes are replaced.
  return write_file_atomically(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Result<double> Object::number(const char* key, double lo, double hi) const {
  if (!has(key)) return bad(*this, key, "is missing", range_text(lo, hi));
  return checked(*this, key, json.at(key), lo, hi);
}

Result<double> Object::number_or(const char* key, double fallback, double lo, double hi) const {
  return has(key) ? number(key, lo, hi) : fallback;
}

Result<std::vector<double>> Object::numbers(const char* key, std::size_t count, double lo, double hi) const {
  // Check the shape of the list.
  const std::string wanted = "a list of " + std::to_string(count) + " numbers";
  if (!has(key)) return bad(*this, key, "is missing", wanted);
  const Json& list = json.at(key);
  if (!list.is_array() || list.size() != count) return bad(*this, key, "has the wrong shape", wanted);

  // Check and copy its values.
  std::vector<double> values;
  for (const Json& element : list) {
    const auto value = checked(*this, key, element, lo, hi);
    if (!value) return tl::unexpected(value.error());
    values.push_back(*value);
  }
  return values;
}

Result<std::string> Object::text(const char* key) const {
  if (!has(key)) return bad(*this, key, "is missing", "a text");
  if (!json.at(key).is_string()) return bad(*this, key, "is " + shown(json.at(key)), "a text");
  return json.at(key).get<std::string>();
}

Result<bool> Object::boolean(const char* key) const {
  if (!has(key)) return bad(*this, key, "is missing", "true or false");
  if (!json.at(key).is_boolean()) return bad(*this, key, "is " + shown(json.at(key)), "true or false");
  return json.at(key).get<bool>();
}

Result<SE3> Object::transform(const char* key) const {
  const char* wanted = "a 4x4 rigid transform, row by row, in metres";

  // Check the shape of the matrix.
  if (!has(key)) return bad(*this, key, "is missing", wanted);
  const Json& rows = json.at(key);
  if (!rows.is_array() || rows.size() != 4) return bad(*this, key, "does not have 4 rows", wanted);

  // Check and copy its numbers.
  Eigen::Matrix4d m;
  for (int r = 0; r < 4; ++r) {
    if (!rows[r].is_array() || rows[r].size() != 4) return bad(*this, key, "has a row without 4 numbers", wanted);
    for (int c = 0; c < 4; ++c) {
      const auto value = checked(*this, key, rows[r][c], -100, 100);
      if (!value) return tl::unexpected(value.error());
      m(r, c) = *value;
    }
  }

  // Reject a matrix that is not a rigid motion.
  const Eigen::Matrix3d R = m.topLeftCorner<3, 3>();
  const double skew = (R * R.transpose() - Eigen::Matrix3d::Identity()).norm();

  // A nearly orthonormal matrix is most likely a rotation with too few decimals.
  if (R.determinant() > 0 && skew >= 1e-3 && skew < 0.1)
    return bad(*this, key, "does not hold an exact rotation: perhaps its numbers are rounded",
               wanted + ", with 4 decimals or more"s);
  if (!(skew < 1e-3 && R.determinant() > 0)) return bad(*this, key, "does not hold a right-handed rotation", wanted);
  if ((m.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() > 1e-9)
    return bad(*this, key, "does not end with the row 0 0 0 1", wanted);
  return SE3{orthonormalised(R), m.topRightCorner<3, 1>()};
}

double rounded(double value) {
  const double r = std::round(value * 1e9) / 1e9;
  return r == 0 ? 0.0 : r;  // replaces -0, so that files never contain "-0.0"
}

Json to_json(const SE3& T) {
  Json rows = Json::array();
  for (int r = 0; r < 4; ++r) {
    Json row = Json::array();
    for (int c = 0; c < 4; ++c) row.push_back(rounded(T.matrix()(r, c)));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace barehand::json_fields
