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
  static std::string ply() {
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << mesh().vertices.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh().triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& v : mesh().vertices) text << v.transpose() << "\n";
    for (const auto& t : mesh().triangles) text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
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
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("no such file"));
  EXPECT_THAT(refusal(write("empty.obj", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(write("noise.ply", "this is no mesh")), HasSubstr("cannot be read as a mesh"));
}

}  // namespace
}  // namespace barehand
