#include "io/mesh/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "support/solid_meshes.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::HasSubstr;

/// Writes meshes of a hammer, in any unit, into a folder of its own.
class MeshFile : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = folder_.path() + "/" + name;
    std::ofstream(path) << text;
    return path;
  }
  static std::string obj(double scale) {
    std::ostringstream text;
    for (const auto& v : mesh().vertices)
      text << "v " << scale * v.x() << " " << scale * v.y() << " " << scale * v.z() << "\n";
    for (const auto& t : mesh().triangles) text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
    return text.str();
  }
  /// `vertex`, `face`: lines of one more vertex and one more face; "": none.
  static std::string ply(const std::string& vertex = "", const std::string& face = "") {
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << mesh().vertices.size() + !vertex.empty()
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
         << mesh().triangles.size() + !face.empty() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& v : mesh().vertices) text << v.transpose() << "\n";
    if (!vertex.empty()) text << vertex << "\n";
    for (const auto& t : mesh().triangles) text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
    if (!face.empty()) text << face << "\n";
    return text.str();
  }
  /// The hammer, so many metres beside its origin.
  static std::string moved_obj(float by) {
    std::ostringstream text;
    for (const auto& v : mesh().vertices) text << "v " << v.x() + by << " " << v.y() << " " << v.z() << "\n";
    for (const auto& t : mesh().triangles) text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
    return text.str();
  }
  static std::string stl() {
    std::ostringstream text;
    text << "solid hammer\n";
    for (const auto& t : mesh().triangles) {
      text << "facet normal 0 0 0\nouter loop\n";
      for (const auto v : t) text << "vertex " << mesh().vertices[v].transpose() << "\n";
      text << "endloop\nendfacet\n";
    }
    text << "endsolid hammer\n";
    return text.str();
  }
  static const ObjectMesh& mesh() {
    static const ObjectMesh hammer = test::hammer_mesh();
    return hammer;
  }
  static std::string refusal(const std::string& path, LengthUnit unit = LengthUnit::metre) {
    const auto loaded = load_mesh(path, unit);
    return loaded ? "loaded" : loaded.error().message();
  }
  test::TempFolder folder_;
};

TEST_F(MeshFile, ReadsTheSameSolidFromEveryFormat) {
  for (const auto& [name, text] : {std::pair{"a.obj", obj(1)}, {"b.ply", ply()}, {"c.stl", stl()}}) {
    const auto loaded = load_mesh(write(name, text), LengthUnit::metre);
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->mesh.vertices.size(), mesh().vertices.size()) << name;
    EXPECT_EQ(loaded->mesh.triangles.size(), mesh().triangles.size()) << name;
    EXPECT_EQ(loaded->mesh.name, std::string(1, name[0]));
  }
}

TEST_F(MeshFile, ReadsOtherUnits) {
  const auto loaded = load_mesh(write("a.obj", obj(1000)), LengthUnit::millimetre);
  ASSERT_TRUE(loaded) << loaded.error().message();
  float widest = 0;
  for (const auto& v : loaded->mesh.vertices) widest = std::max(widest, v.x());
  EXPECT_NEAR(widest, 0.06, 1e-5);
}

TEST_F(MeshFile, NamesTheUnitThatAFileProbablyHas) {
  EXPECT_THAT(refusal(write("mm.obj", obj(1000))), HasSubstr("add --object-unit mm"));
  EXPECT_THAT(refusal(write("cm.obj", obj(100))), HasSubstr("add --object-unit cm"));
  EXPECT_THAT(refusal(write("m.obj", obj(1)), LengthUnit::millimetre), HasSubstr("add --object-unit m"));
  EXPECT_THAT(refusal(write("planet.obj", obj(1e9))), HasSubstr("no hand can hold"));
}

TEST_F(MeshFile, SaysWhatIsWrongWithAFile) {
  EXPECT_THAT(refusal(folder_.path() + "/none.obj"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("is no file"));
  EXPECT_THAT(refusal(write("empty.obj", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(write("noise.ply", "this is no mesh")), HasSubstr("cannot be read as a mesh"));
}

TEST_F(MeshFile, RefusesFilesThatAreBroken) {
  for (const std::string face : {"3 0 1 99999", "3 0 1 -5", "4 0 1 2 77777", "0"})
    EXPECT_THAT(refusal(write("face.ply", ply("", face))), HasSubstr("has a face without corners")) << face;
  const std::string whole = ply();
  for (std::size_t size = 1; 4 * size < 3 * whole.size(); size += 37)
    EXPECT_NE(refusal(write("cut.ply", whole.substr(0, size))), "loaded") << size;
  EXPECT_THAT(refusal(write("cut.ply", whole.substr(0, 60))), HasSubstr("header has no end"));
  EXPECT_THAT(refusal(write("nan.ply", ply("nan 0 0", "3 0 1 " + std::to_string(mesh().vertices.size())))),
              HasSubstr("not finite"));
}

TEST_F(MeshFile, RefusesJsonThatIsNestedTooDeeply) {
  const std::string deep =
      R"({"asset":{"version":"2.0"},"extras":)" + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}";
  EXPECT_THAT(refusal(write("deep.gltf", deep)), HasSubstr("levels of nested JSON"));
  const auto little_endian = [](std::size_t size) { return std::string(reinterpret_cast<const char*>(&size), 4); };
  const std::string binary =
      "glTF" + little_endian(2) + little_endian(20 + deep.size()) + little_endian(deep.size()) + "JSON" + deep;
  EXPECT_THAT(refusal(write("deep.GLB", binary)), HasSubstr("levels of nested JSON"));
  EXPECT_THAT(refusal(write("text.gltf", R"({"a":")" + std::string(1000, '[') + "\"}")),
              HasSubstr("cannot be read as a mesh"))
      << "brackets in a string are no levels";
}

TEST_F(MeshFile, RefusesAnObjectFarFromItsOrigin) {
  EXPECT_EQ(refusal(write("near.obj", moved_obj(5))), "loaded");
  EXPECT_THAT(refusal(write("far.obj", moved_obj(50))), HasSubstr("away from the origin"));
}

TEST_F(MeshFile, LeavesOutVerticesOfNoTriangle) {
  const auto loaded = load_mesh(write("far.ply", ply("1000 0 0")), LengthUnit::metre);
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_EQ(loaded->mesh.vertices.size(), mesh().vertices.size());
}

}  // namespace
}  // namespace barehand
