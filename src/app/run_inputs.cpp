#include "app/run_inputs.h"

#include "app/data_files.h"
#include "io/hand_json.h"

namespace barehand {
namespace {

Result<NamedHand> named(Result<HandProfile> profile, const std::string& name) {
  if (!profile) return tl::unexpected(profile.error());
  return NamedHand{std::make_shared<const HandProfile>(std::move(*profile)), name};
}

}  // namespace

Result<Config> read_configuration(const std::string& name) {
  if (name == "builtin") return Config{};
  return find_config(name).and_then([](const std::string& path) { return load_config<Config>(path); });
}

Result<NamedHand> choose_hand(const std::string& wanted, const OpenSource& source) {
  if (!wanted.empty()) return named(load_profile(wanted), wanted);
  if (source.hand) return named(source.hand(), source.hand_name);
  return find_data_file("configs/hands/adult_right.json").and_then([](const std::string& shipped) {
    return named(load_profile(shipped), shipped);
  });
}

}  // namespace barehand
