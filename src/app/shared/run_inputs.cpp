// Loads the configuration and the hand profiles of a run.
#include "app/shared/run_inputs.h"

#include <algorithm>
#include <iterator>

#include "io/data_files.h"
#include "io/hand/hand_json.h"

namespace barehand {
namespace {

Result<NamedHand> named(Result<HandProfile> profile, const std::string& name) {
  if (!profile) return tl::unexpected(profile.error());
  return NamedHand{std::make_shared<const HandProfile>(std::move(*profile)), name};
}

}  // namespace

Result<Config> read_configuration(const std::string& name) {
  if (name == "builtin") return Config{};
  return find_config(name).and_then([](const std::string& path) {
    auto config = load_config<Config>(path);
    if (!config) return config;
    if (config->preprocess.min_depth >= config->preprocess.max_depth)
      return Result<Config>(fail("nothing lies between min_depth and max_depth", path + ": preprocess",
                                 "give a max_depth that is larger than min_depth"));
    if (config->contact.touch_distance > config->contact.near_distance)
      return Result<Config>(fail("touch_distance is larger than near_distance", path + ": contact",
                                 "give a near_distance that is at least touch_distance"));
    const auto world = world_from(config->world, path + ": world.T_world_camera");
    return world ? config : tl::unexpected(world.error());
  });
}

Result<NamedHand> load_hand(const std::string& name) {
  if (name != "right" && name != "left") return named(load_profile(name), name);
  return find_data_file("configs/hands/adult_" + name + ".json").and_then([](const std::string& path) {
    return named(load_profile(path), path);
  });
}

std::vector<std::string> profile_paths(const std::vector<std::string>& names) {
  std::vector<std::string> paths;
  std::ranges::copy_if(names, std::back_inserter(paths),
                       [](const std::string& name) { return name != "right" && name != "left" && name != "both"; });
  return paths;
}

Result<std::vector<NamedHand>> choose_hands(const std::vector<std::string>& wanted, const OpenSource& source) {
  // Load the hands that the user named, else those of the source, else the mean right hand.
  std::vector<Result<NamedHand>> found;
  for (const std::string& name : wanted) {
    if (name == "both") {
      found.push_back(load_hand("right"));
      found.push_back(load_hand("left"));
    } else {
      found.push_back(load_hand(name));
    }
  }

  if (found.empty())
    for (const SourceHand& hand : source.hands) found.push_back(named(hand.load(), hand.name));
  if (found.empty()) found.push_back(load_hand("right"));

  // Accept one hand of each side.
  std::vector<NamedHand> hands;
  for (Result<NamedHand>& hand : found) {
    if (!hand) return tl::unexpected(hand.error());
    for (const NamedHand& other : hands)
      if (other.profile->handedness == hand->profile->handedness)
        return fail("is a " + std::string(to_string(hand->profile->handedness)) + " hand, as " + other.name + " is",
                    hand->name, "give one hand, or a right and a left one");
    hands.push_back(std::move(*hand));
  }
  return hands;
}

std::vector<std::shared_ptr<const HandProfile>> profiles_of(const std::vector<NamedHand>& hands) {
  std::vector<std::shared_ptr<const HandProfile>> profiles;
  for (const NamedHand& hand : hands) profiles.push_back(hand.profile);
  return profiles;
}

}  // namespace barehand
