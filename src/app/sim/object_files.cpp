#include "app/sim/object_files.h"

#include "core/both.h"
#include "core/format.h"
#include "io/obj_file.h"

namespace barehand {
namespace {

constexpr std::string_view kPoseHeader = "utime,object,held,x,y,z,qw,qx,qy,qz";
constexpr std::string_view kGraspHeader = "utime,grasp";
constexpr std::string_view kContactHeader = "utime,segment,distance,x,y,z,nx,ny,nz";

std::string pose_row(std::int64_t utime, const std::string& name, const synthetic::ObjectTruth& object) {
  Eigen::Quaterniond q(object.T_camera_object.R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();  // one sign for each rotation
  const Eigen::Vector3d& t = object.T_camera_object.t;
  return formatted("%lld,%s,%d,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", static_cast<long long>(utime), name.c_str(),
                   object.held ? 1 : 0, t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
}

std::string contact_rows(std::int64_t utime, const synthetic::HandContacts& contacts) {
  std::string rows;
  for (int s = 0; s < kSegmentCount; ++s) {
    const auto& [distance, p, n] = contacts[s];
    rows += formatted("%lld,%s,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", static_cast<long long>(utime),
                      std::string(kSegmentNames[s]).c_str(), distance, p.x(), p.y(), p.z(), n.x(), n.y(), n.z());
  }
  return rows;
}

}  // namespace

Result<ObjectFiles> ObjectFiles::create(const Paths& paths, const synthetic::SyntheticSource& source, bool overwrite) {
  const synthetic::GraspedObject& object = *source.grasped();

  // Write the mesh, which does not change.
  if (auto ok = save_obj(object.mesh().vertices, object.mesh().triangles, paths.mesh); !ok)
    return tl::unexpected(ok.error());

  // Create the tables, to which each frame adds its rows.
  auto poses = RowFile::create(paths.poses, kPoseHeader, overwrite);
  if (!poses) return tl::unexpected(poses.error());
  auto grasps = RowFile::create(paths.grasps, kGraspHeader, overwrite);
  if (!grasps) return tl::unexpected(grasps.error());

  // Contacts are written in one table for each hand.
  std::vector<RowFile> contacts;
  for (const std::string& path : paths.contacts) {
    auto rows = RowFile::create(path, kContactHeader, overwrite);
    if (!rows) return tl::unexpected(rows.error());
    contacts.push_back(std::move(*rows));
  }
  return ObjectFiles(object.name(), std::move(*poses), std::move(*grasps), std::move(contacts));
}

Result<void> ObjectFiles::write(const synthetic::SyntheticSource& source, std::int64_t utime) {
  auto written = poses_.write(pose_row(utime, name_, *source.object()));
  const std::string grasp(source.object()->held ? source.grasp_type() : "none");
  written = written.and_then([&] { return grasps_.write(std::to_string(utime) + "," + grasp + "\n"); });
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (!source.hands()[k].truth) continue;  // the hand is not in view
    written = written.and_then([&] { return contacts_[k].write(contact_rows(utime, *source.contacts(k))); });
  }
  return written;
}

Result<void> ObjectFiles::finish() {
  auto finished = both(poses_.finish(), grasps_.finish());
  for (RowFile& rows : contacts_) finished = both(std::move(finished), rows.finish());
  return finished;
}

}  // namespace barehand
