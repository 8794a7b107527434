// Encodes the skin of a hand profile for the live page.
#include "io/web/view_skin.h"

#include <algorithm>

#include "io/web/view_bytes.h"

namespace barehand {
namespace {

constexpr double kCell = 0.004;  // size of the skin's triangles [m]; smaller ones make no visible difference

void put_vector(ChunkWriter& out, const Eigen::Vector3f& v) {
  for (int i = 0; i < 3; ++i) out.put<float>(v[i]);
}

Skin coarse_skin(const HandProfile& profile) {
  Skin skin = make_skin(profile, kCell);
  return profile.scanned_skin ? coarsened(skin, kCell) : skin;
}

/// The skin of `profile` with segments of other sizes, which change evenly from one end of a bone to the other.
Skin resized(const Skin& skin, const HandProfile& profile, const SegmentSizes& sizes) {
  const auto resize = [&](Eigen::Vector3f& point, int s) {
    const float along = std::clamp(point.z() / static_cast<float>(profile.segments[s].distal.z()), 0.0f, 1.0f);
    point.array() *= (1 - along) * sizes.col(s).head<3>().array() + along * sizes.col(s).tail<3>().array();
  };
  Skin other = skin;
  for (SkinVertex& v : other.vertices) {
    resize(v.in_a, v.a);
    resize(v.in_b, v.b);
  }
  return other;
}

std::vector<std::uint8_t> skin_chunk(Handedness side, const Skin& skin) {
  // Write the number of vertices and triangles.
  std::vector<std::uint8_t> bytes;
  ChunkWriter out(bytes);
  out.begin('S', static_cast<int>(side));
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

}  // namespace

const Skin& ViewSkin::mesh() const {
  std::call_once(
      meshed_, [this] { mesh_ = base_ ? resized(base_->mesh(), *base_->profile(), sizes_) : coarse_skin(*profile_); });
  return mesh_;
}

const std::vector<std::uint8_t>& ViewSkin::bytes() const {
  std::call_once(written_, [this] { bytes_ = skin_chunk(profile_->handedness, mesh()); });
  return bytes_;
}

}  // namespace barehand
