// Keeps what has been seen of the object that is scanned.
#include "app/scan/object_scan.h"

#include <algorithm>
#include <tuple>

#include "stages/contact/scanned_mesh.h"

namespace barehand {

void ObjectScan::add(std::span<const ObjectTrack> tracks) {
  ++frames_;

  // Forget objects that are gone, but for the best one.
  const std::int32_t best = objects_.empty() ? 0 : object()->id;
  std::erase_if(objects_, [&](const Object& object) {
    const auto is_it = [&](const ObjectTrack& track) { return track.state.id == object.id; };
    return object.id != best && std::ranges::none_of(tracks, is_it);
  });

  // Store the state of the other objects.
  for (const ObjectTrack& track : tracks) {
    if (!track.modelled()) continue;
    auto at = std::ranges::find(objects_, track.state.id, &Object::id);
    if (at == objects_.end()) at = objects_.insert(at, Object{track.state.id, 0, {}});
    at->held += track.state.held;
    at->surface = track.model.surface();
  }
}

const ObjectScan::Object* ObjectScan::object() const {
  if (objects_.empty()) return nullptr;
  const auto merit = [](const Object& object) {
    const std::size_t size = object.surface.size();
    return std::tuple(size >= kFewestSamples, object.held, size);
  };
  return &*std::ranges::max_element(objects_, {}, merit);
}

}  // namespace barehand
