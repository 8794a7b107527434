// Writes the expected results of the clients' tests: FOLDER/states.lcmlog and FOLDER/hands.mcap, hand states as the
// tracker publishes them, and FOLDER/golden.csv, the same hands in the conventions of other consumers, computed here
// with Eigen.
//   write_client_golden FOLDER
#include <Eigen/SVD>
#include <cstdio>
#include <iostream>

#include "io/lcm/lcm_log_writer.h"
#include "io/mcap/mcap_scene.h"
#include "publish/published_hand.h"
#include "stages/publish/glove_angles.h"
#include "stages/publish/hand_messages.h"
#include "stages/publish/openxr_joints.h"
#include "stages/publish/publisher.h"

namespace barehand {
namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000, kFrameInterval = 16'667;  // microseconds

/// Writes rows "frame,outlet,index,value,...", each value with all of its digits.
class Table {
 public:
  explicit Table(const std::string& path) : file_(std::fopen(path.c_str(), "w")) {}
  ~Table() { std::fclose(file_); }

  void row(std::int64_t frame, const char* outlet, std::size_t index, std::initializer_list<double> values) {
    std::fprintf(file_, "%lld,%s,%zu", static_cast<long long>(frame), outlet, index);
    for (const double value : values) std::fprintf(file_, ",%.17g", value);
    std::fprintf(file_, "\n");
  }

 private:
  std::FILE* file_;
};

/// Angles that bend every joint, by other amounts in each frame [rad].
Angles bent(int frame) {
  Angles angles{};
  for (int s = 1; s < kSegmentCount; ++s) {
    angles[s].flexion = 0.1 + 0.05 * ((s + 3 * frame) % 16);
    if (s % 3 == 1) angles[s].abduction = 0.02 * (s % 7 - 3);
  }
  return angles;
}

using Landmarks = Eigen::Matrix<double, 3, 21>;

Landmarks landmarks(const std::array<OpenXrJoint, kOpenXrJointCount>& joints) {
  Landmarks points;
  int column = 0;
  for (int joint = 1; joint < kOpenXrJointCount; ++joint) {
    const bool metacarpal_of_finger = joint > 5 && (joint - 6) % 5 == 0;
    if (!metacarpal_of_finger) points.col(column++) = joints[static_cast<std::size_t>(joint)].T_camera_joint.t;
  }
  return points;
}

/// Landmarks in MANO's wrist frame as dex-retargeting computes them: the plane of wrist and two knuckles by a singular
/// value decomposition, then its operator2mano.
Landmarks in_mano_frame(Landmarks points, Handedness side) {
  points.colwise() -= points.col(0).eval();

  // The wrist's frame: x from middle knuckle to wrist, the normal, z towards the index finger.
  Eigen::Matrix3d three;
  three << points.col(0), points.col(5), points.col(9);
  const Eigen::Matrix3d centred = three.colwise() - three.rowwise().mean();
  Eigen::Vector3d normal = Eigen::JacobiSVD<Eigen::Matrix3d>(centred, Eigen::ComputeFullU).matrixU().col(2);
  Eigen::Vector3d x = points.col(0) - points.col(9);
  x = (x - x.dot(normal) * normal).normalized();

  // Complete the axes, and let z point to the index finger.
  Eigen::Vector3d z = x.cross(normal);
  if (z.dot(centred.col(1) - centred.col(2)) < 0) {
    normal = -normal;
    z = -z;
  }
  Eigen::Matrix3d frame;
  frame << x, normal, z;

  // Rotate to the axes of MANO, which differ between the hands.
  Eigen::Matrix3d operator2mano;
  if (side == Handedness::right)
    operator2mano << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  else
    operator2mano << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  return (points.transpose() * frame * operator2mano).transpose();
}

void write_outlets(Table& table, const HandProfile& profile, const HandPose& pose, std::int64_t frame) {
  const auto joints = openxr_joints(profile, pose);
  const Eigen::Matrix3d to_xr = Eigen::Vector3d(1, -1, -1).asDiagonal();

  // Write the joints in OpenXR's axes, which have y up and z backwards.
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Eigen::Vector3d p = to_xr * joints[i].T_camera_joint.t;
    Eigen::Quaterniond q(Eigen::Matrix3d(to_xr * joints[i].T_camera_joint.R));
    if (q.w() < 0) q.coeffs() *= -1;
    table.row(frame, "openxr26", i, {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), joints[i].radius});
  }

  // Write the landmarks, the channels of the data glove and the joint angles.
  const Landmarks points = in_mano_frame(landmarks(joints), profile.handedness);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    table.row(frame, "mano21", static_cast<std::size_t>(i), {points(0, i), points(1, i), points(2, i)});
  const GloveAngles glove = glove_angles(profile, pose);
  for (std::size_t i = 0; i < glove.channel.size(); ++i) table.row(frame, "glove22", i, {glove.channel[i]});
  for (std::size_t i = 0; i < glove.joint.size(); ++i) table.row(frame, "joint_angles", i, {glove.joint[i]});
}

/// A right and a left hand in each of four frames, and a fifth in which both are lost.
int write(const std::string& folder) {
  const auto failed = [](const Error& error) {
    std::cerr << error.message() << "\n";
    return 1;
  };

  // Open the outputs.
  auto log = LcmLogWriter::create(folder + "/states.lcmlog", true);
  if (!log) return failed(log.error());
  auto file = mcap::McapWriter::create(folder + "/hands.mcap", true);
  if (!file) return failed(file.error());
  Table table(folder + "/golden.csv");
  auto publisher = Publisher::create("", {log->get()}).value();

  // Write five frames of both hands; in the last one the hands are lost.
  for (int frame = 0; frame < 5; ++frame) {
    ros::Scene scene;
    scene.utime = kStart + frame * kFrameInterval;
    scene.number = frame;
    for (const Handedness side : {Handedness::right, Handedness::left}) {
      // Make an estimate of a bent and turned hand.
      const auto profile = test::adult_hand(side);
      const bool lost = frame == 4;
      HandEstimate estimate =
          estimate_of(*profile, bent(frame), scene.utime, lost ? TrackStatus::lost : TrackStatus::tracking);
      estimate.number = frame;
      estimate.hand_id = side == Handedness::right ? 1 : 2;

      const HandPose pose = test::turned(pose_of(estimate.segments), {0.7 * frame, -0.4, 1.1 * frame}, {0.1, 0, 0.5});
      for (int s = 0; s < kSegmentCount; ++s) estimate.segments[s].T_camera_segment = pose[s];
      if (lost) estimate.segments = {};

      // Every frame gets a new message maker, so that its smoothed pose equals the raw one.
      const HandMessages messages = HandMessageMaker({}).process(estimate);
      scene.hands.push_back({messages.state, messages.glove, messages.joints});
      if (auto sent = publisher.send_hand(messages); !sent) return failed(sent.error());
      if (!lost) write_outlets(table, *profile, pose, 2 * frame + (side == Handedness::left ? 1 : 0));
    }
    if (auto written = mcap::write_scene(**file, scene); !written) return failed(written.error());
  }
  return (*log)->finish() && (*file)->finish() ? 0 : 1;
}

}  // namespace
}  // namespace barehand

int main(int argc, char** argv) { return argc == 2 ? barehand::write(argv[1]) : 2; }
