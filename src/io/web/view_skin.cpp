// Encodes the skin of a hand profile for the live page.
#include "io/web/view_skin.h"

#include <cstring>

#include "hand/skin.h"
#include "io/web/view_bytes.h"

namespace barehand {
namespace {

constexpr double kCell = 0.004;  // size of the skin's triangles [m]; smaller ones make no visible difference

void put_vector(ChunkWriter& out, const Eigen::Vector3f& v) {
  for (int i = 0; i < 3; ++i) out.put<float>(v[i]);
}

std::vector<std::uint8_t> skin_chunk(const HandProfile& profile) {
  // Make the skin with a mesh that is coarse enough to be sent.
  Skin skin = make_skin(profile, kCell);
  if (profile.scanned_skin) skin = coarsened(skin, kCell);

  // Write the number of vertices and triangles.
  std::vector<std::uint8_t> bytes;
  ChunkWriter out(bytes);
  out.begin('S', static_cast<int>(profile.handedness));
  out.put(static_cast<std::uint32_t>(skin.vertices.size()));
  out.put(static_cast<std::uint32_t>(skin.triangles.size()));

  // Write the positions, the normals and the skinning weights of the vertices.
  for (const SkinVertex& v : skin.vertices) put_vector(out, v.in_a);
  for (const SkinVertex& v : skin.vertices) put_vector(out, v.a == v.b ? v.in_a : v.in_b);
  for (const SkinVertex& v : skin.vertices) put_vector(out, v.normal_in_a);
  for (const SkinVertex& v : skin.vertices) out.put<float>(v.weight_b);

  // Write the triangles, then the segments of each vertex as single bytes.
  for (const auto& triangle : skin.triangles)
    for (const std::int32_t corner : triangle) out.put(static_cast<std::uint32_t>(corner));
  for (const SkinVertex& v : skin.vertices) out.put(static_cast<std::uint8_t>(v.a));
  for (const SkinVertex& v : skin.vertices) out.put(static_cast<std::uint8_t>(v.b));
  out.end();
  return bytes;
}

/// A chunk whose positions are scaled; normals, weights and triangles stay.
std::vector<std::uint8_t> scaled_chunk(std::vector<std::uint8_t> bytes, double size) {
  constexpr std::size_t kHead = 8, kCounts = 8;  // of the chunk, and the numbers of vertices and triangles
  std::uint32_t vertices = 0;
  std::memcpy(&vertices, bytes.data() + kHead, sizeof vertices);
  std::uint8_t* at = bytes.data() + kHead + kCounts;
  for (std::size_t i = 0; i < 6 * std::size_t{vertices}; ++i, at += sizeof(float)) {
    float coordinate = 0;
    std::memcpy(&coordinate, at, sizeof coordinate);
    coordinate *= static_cast<float>(size);
    std::memcpy(at, &coordinate, sizeof coordinate);
  }
  return bytes;
}

}  // namespace

const std::vector<std::uint8_t>& ViewSkin::bytes() const {
  std::call_once(made_, [this] { bytes_ = base_ ? scaled_chunk(base_->bytes(), size_) : skin_chunk(*profile_); });
  return bytes_;
}

}  // namespace barehand
