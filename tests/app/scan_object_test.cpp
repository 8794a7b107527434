#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>

#include "io/mesh/mesh_file.h"
#include "support/child_process.h"
#include "support/quick_config.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ScanObject : public ::testing::Test {
 protected:
  void SetUp() override { test::write_text(folder_ / "quick.yaml", test::quick_config()); }
  std::vector<std::string> scan(const std::string& source, const std::string& out) const {
    return {BAREHAND_PROGRAM, "scan-object", "--source", source, "--config", folder_ / "quick.yaml", "--out", out};
  }

  const test::TempFolder folder_;
  const std::string mesh_ = folder_ / "ball.obj";
  const std::string ball_ = "sim:grasp_ball,frames=120,width=320,height=240";
};

TEST_F(ScanObject, SavesAMeshThatTrackReads) {
  ChildProcess child(scan(ball_, mesh_));
  ASSERT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), AllOf(HasSubstr("% of its surface seen"), HasSubstr("saved in " + mesh_)));
  const auto loaded = load_mesh(mesh_, LengthUnit::metre);
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_EQ(loaded->repair.closed, 0u);
  EXPECT_THAT(test::read_text(mesh_), AllOf(HasSubstr("g seen\nf "), HasSubstr("g closed\nf ")));
}

TEST_F(ScanObject, WritesNothingIfNoObjectIsSeen) {
  ChildProcess child(scan("sim:open,frames=8,width=320,height=240", mesh_));
  EXPECT_EQ(child.finish(), 1) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("nothing is saved"));
  EXPECT_FALSE(std::filesystem::exists(mesh_));
}

TEST_F(ScanObject, ReplacesNothingUnasked) {
  test::write_text(mesh_, "mine");
  ChildProcess child(scan(ball_, mesh_));
  EXPECT_EQ(child.finish(), 2) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("--overwrite"));
  EXPECT_EQ(test::read_text(mesh_), "mine");
}

TEST_F(ScanObject, RefusesOtherFormats) {
  ChildProcess child(scan(ball_, folder_ / "ball.stl"));
  EXPECT_EQ(child.finish(), 2) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("does not end in .obj"));
}

TEST_F(ScanObject, CtrlCSavesWhatWasSeen) {
  // There are so many frames that the end does not come first.
  ChildProcess child(scan("sim:grasp_ball,width=320,height=240,fps=120", mesh_));
  ASSERT_TRUE(child.wait_for("% of its surface seen")) << child.output();
  child.signal(SIGINT);
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_TRUE(load_mesh(mesh_, LengthUnit::metre));
}

}  // namespace
}  // namespace barehand
