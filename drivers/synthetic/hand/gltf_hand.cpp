// Reads a rigged hand from a glTF file. This is the only file that uses assimp.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <map>
#include <tuple>

#include "drivers/synthetic/hand/hand_mesh.h"

namespace barehand::synthetic {
namespace {

constexpr const char* kRemedy = "use a rigged glTF hand with OpenXR joint names, for example deploy/fetch_hand_mesh.sh";

/// The rigid part of a node's matrix.
SE3 rigid(const aiMatrix4x4& m) {
  Eigen::Matrix3d R;
  R << m.a1, m.a2, m.a3, m.b1, m.b2, m.b3, m.c1, m.c2, m.c3;
  for (int i = 0; i < 3; ++i) R.col(i).normalize();
  return {orthonormalised(R), {m.a4, m.b4, m.c4}};
}

/// The largest mesh with bones; null if there is none.
const aiMesh* skinned_mesh(const aiScene& scene) {
  const aiMesh* best = nullptr;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh* mesh = scene.mMeshes[i];
    if (mesh->HasBones() && (!best || mesh->mNumVertices > best->mNumVertices)) best = mesh;
  }
  return best;
}

/// The bone of every joint; bones with other names are ignored.
std::array<const aiBone*, kJointCount> bones_by_joint(const aiMesh& mesh) {
  std::array<const aiBone*, kJointCount> bones{};
  for (unsigned i = 0; i < mesh.mNumBones; ++i)
    if (const auto joint = joint_from_name(mesh.mBones[i]->mName.C_Str())) bones[*joint] = mesh.mBones[i];
  return bones;
}

/// The four largest weights of every vertex, normalised to a sum of 1.
std::vector<SkinWeights> vertex_weights(const aiMesh& mesh, const std::array<const aiBone*, kJointCount>& bones) {
  // Collect all weights of each vertex.
  std::vector<std::vector<std::pair<float, int>>> all(mesh.mNumVertices);
  for (int joint = 0; joint < kJointCount; ++joint)
    for (unsigned i = 0; i < bones[joint]->mNumWeights; ++i)
      all[bones[joint]->mWeights[i].mVertexId].emplace_back(bones[joint]->mWeights[i].mWeight, joint);

  // Keep the largest ones; a vertex without weights follows the wrist.
  std::vector<SkinWeights> weights(mesh.mNumVertices);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    auto& list = all[v];
    std::sort(list.begin(), list.end(), [](auto& a, auto& b) { return a.first > b.first; });
    if (list.empty()) list.emplace_back(1.0f, kWristJoint);
    list.resize(std::min<std::size_t>(list.size(), 4));

    float sum = 0;
    for (const auto& entry : list) sum += entry.first;
    for (std::size_t i = 0; i < list.size(); ++i) {
      weights[v].joint[i] = static_cast<std::uint8_t>(list[i].second);
      weights[v].weight[i] = list[i].first / sum;
    }
  }
  return weights;
}

/// Copies the vertices in the hand frame, merging those that coincide, and the triangles that use them.
void copy_skin(const aiMesh& mesh, const SE3& T_hand_mesh, const std::vector<SkinWeights>& weights, HandMesh& hand) {
  // Merge vertices that lie at the same place.
  std::map<std::tuple<float, float, float>, std::uint32_t> seen;
  std::vector<std::uint32_t> index(mesh.mNumVertices);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    const auto [it, fresh] = seen.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(hand.vertices.size()));
    index[v] = it->second;
    if (!fresh) continue;

    // Copy the first vertex of each place.
    hand.vertices.push_back((T_hand_mesh * Eigen::Vector3d(p.x, p.y, p.z)).cast<float>());
    hand.weights.push_back(weights[v]);
  }

  // Copy the triangles, except those that became degenerate by the merging.
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    const Triangle t = {index[face.mIndices[0]], index[face.mIndices[1]], index[face.mIndices[2]]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) hand.triangles.push_back(t);
  }
}

/// Checks that the rest pose has OpenXR's axes, a human size and the right side.
Result<void> check_rest(const HandMesh& hand, const std::string& path) {
  // Check the size.
  const double length = (hand.T_hand_joint[joint_of(2, 4)].t).norm();
  if (length < 0.08 || length > 0.35)
    return fail("the hand is " + std::to_string(length) + " units long from wrist to middle tip", path,
                "the file must be in metres");

  // Check the axes.
  for (int joint = 1; joint + 1 < kJointCount; ++joint) {
    if (parent_of_joint(joint + 1) != joint) continue;
    const Eigen::Vector3d next = hand.T_hand_joint[joint].inverse() * hand.T_hand_joint[joint + 1].t;
    if (-next.z() < 0.7 * next.norm())
      return fail("joint " + std::string(joint_name(joint)) + " does not have -z along its bone", path, kRemedy);
  }

  // Check the side.
  const bool thumb_at_negative_x = hand.T_hand_joint[joint_of(0, 2)].t.x() < 0;
  if (thumb_at_negative_x != (hand.handedness == Handedness::right))
    return fail("this is not a " + std::string(to_string(hand.handedness)) + " hand", path, "give the other file");
  return {};
}

}  // namespace

Result<HandMesh> load_hand_mesh(const std::string& path, Handedness handedness) {
  // Read the file.
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_ValidateDataStructure);
  if (!scene) return fail(std::string("cannot read the hand mesh: ") + importer.GetErrorString(), path, kRemedy);
  const aiMesh* mesh = skinned_mesh(*scene);
  if (!mesh) return fail("no skinned mesh in this file", path, kRemedy);
  const auto bones = bones_by_joint(*mesh);

  // Compute the joints at rest, in the frame of the mesh.
  HandMesh hand;
  hand.handedness = handedness;
  for (int joint = 0; joint < kJointCount; ++joint) {
    if (!bones[joint]) return fail("joint " + std::string(joint_name(joint)) + " is missing", path, kRemedy);
    aiMatrix4x4 bind = bones[joint]->mOffsetMatrix;  // maps mesh to joint; its inverse is the joint's rest pose
    hand.T_hand_joint[joint] = rigid(bind.Inverse());
  }

  // Express everything in the hand frame.
  const SE3 T_hand_mesh = hand.T_hand_joint[kWristJoint].inverse();
  for (SE3& T : hand.T_hand_joint) T = T_hand_mesh * T;
  copy_skin(*mesh, T_hand_mesh, vertex_weights(*mesh, bones), hand);
  if (auto ok = check_rest(hand, path); !ok) return tl::unexpected(ok.error());
  return hand;
}

}  // namespace barehand::synthetic
