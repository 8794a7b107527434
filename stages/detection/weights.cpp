// Reads the files of the networks, and checks them by their checksums.
#include "stages/detection/weights.h"

#include <zlib.h>

#include "core/format.h"
#include "io/file_bytes.h"
#include "io/hand/json_fields.h"

namespace barehand {
namespace {

constexpr const char* kInterface = "2";  // version of the networks' inputs and outputs (docs/nets.md)
constexpr const char* kRemedy = "install Barehand again, or correct the checksum in nets.json";

/// Reads the file that nets.json names under `key`, and compares its checksum.
Result<DetectionWeights::File> checked_file(const std::string& folder, const json_fields::Object& manifest,
                                            const char* key) {
  if (!manifest.has(key)) return fail("has no entry for \"" + std::string(key) + "\"", manifest.where, kRemedy);
  const json_fields::Object entry{manifest.json[key], manifest.where + ": " + key};
  const auto file = entry.text("file"), checksum = entry.text("crc32");
  if (!file) return tl::unexpected(file.error());
  if (!checksum) return tl::unexpected(checksum.error());
  if (file->find('/') != std::string::npos)
    return fail("names a file of another folder, " + *file, entry.where, "give the name of a file beside nets.json");

  const std::string path = folder + "/" + *file;
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto* data = reinterpret_cast<const Bytef*>(bytes->data());
  const std::string found = formatted("%08lx", crc32_z(0, data, bytes->size()));
  if (found != *checksum) return fail("has checksum " + found + ", nets.json states " + *checksum, path, kRemedy);
  return DetectionWeights::File{path, std::move(*bytes)};
}

}  // namespace

Result<DetectionWeights> load_weights(const std::string& folder) {
  const std::string where = folder + "/nets.json";
  const auto json = json_fields::read_json(where);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object()) return fail("is not a JSON object", where, kRemedy);
  const json_fields::Object manifest{*json, where};

  // Verify that this program supports the interface of the networks.
  const auto version = manifest.text("version"), interface = manifest.text("interface");
  if (!version) return tl::unexpected(version.error());
  if (!interface) return tl::unexpected(interface.error());
  if (*interface != kInterface)
    return fail("has interface " + *interface + ", this program supports " + kInterface, where, kNetworkRemedy);

  // Read the two networks.
  auto full = checked_file(folder, manifest, "full"), crop = checked_file(folder, manifest, "crop");
  if (!full) return tl::unexpected(full.error());
  if (!crop) return tl::unexpected(crop.error());
  return DetectionWeights{*version, std::move(*full), std::move(*crop)};
}

}  // namespace barehand
