// Reads the meshes that `--object` names.
#include "app/shared/known_objects.h"

#include <CLI/CLI.hpp>

#include "core/format.h"
#include "io/mesh/mesh_file.h"

namespace barehand {
namespace {

void report(const LoadedMesh& loaded, const KnownObject& object, const std::string& path, spdlog::logger& log) {
  const Eigen::Vector3d mm = 1000 * object.extent;
  log.info("object {}: {}, {}", object.id, path, formatted("%.0f x %.0f x %.0f mm", mm.x(), mm.y(), mm.z()));
  const MeshRepair& repair = loaded.repair;
  if (repair.removed + repair.flipped + repair.closed > 0)
    log.warn("{}: mended the mesh: {} triangles without area or given twice, {} turned outwards, {} holes closed", path,
             repair.removed, repair.flipped, repair.closed);
}

}  // namespace

void add_object_options(CLI::App& command, ObjectMeshes& files) {
  command
      .add_option(
          "--object", files.paths,
          "mesh of an object that the hand may hold (OBJ, PLY, STL, glTF), which is then tracked, too; repeat it "
          "for several")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);

  command
      .add_option("--object-unit", files.units,
                  "unit of the mesh's file: m, cm or mm; once for all objects or once for each; default: m")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->needs("--object");
}

Result<std::vector<KnownObjectPtr>> load_objects(const ObjectMeshes& files, spdlog::logger& log) {
  const auto& [paths, units] = files;
  if (units.size() > 1 && units.size() != paths.size())
    return fail(formatted("is given %zu times for %zu objects", units.size(), paths.size()), "--object-unit",
                "give it once for all objects, or once for each");
  std::vector<KnownObjectPtr> objects;

  // Load one mesh after the other and number the objects from 1.
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto unit =
        units.empty() ? Result<LengthUnit>(LengthUnit::metre) : unit_from(units[units.size() == 1 ? 0 : i]);
    if (!unit) return tl::unexpected(unit.error());

    const auto loaded = load_mesh(paths[i], *unit);
    if (!loaded) return tl::unexpected(loaded.error());
    objects.push_back(make_known_object(loaded->mesh, static_cast<std::int32_t>(i) + 1));
    report(*loaded, *objects.back(), paths[i], log);
  }
  return objects;
}

}  // namespace barehand
