#include "openni2/virtual_device/settings.h"

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>

namespace barehand::virtual_openni {
namespace {

bool yes(const std::string& text) {
  if (text != "0" && text != "1") throw std::invalid_argument("0 or 1 is needed");
  return text == "1";
}

using Setter = std::function<void(Settings&, const std::string&)>;

std::map<std::string, Setter> setters() {
  // How a value of each type is set.
  const auto text = [](auto member) -> Setter { return [=](Settings& s, const std::string& v) { s.*member = v; }; };
  const auto flag = [](auto member) -> Setter {
    return [=](Settings& s, const std::string& v) { s.*member = yes(v); };
  };
  const auto real = [](auto member) -> Setter {
    return [=](Settings& s, const std::string& v) { s.*member = std::stod(v); };
  };

  // What each key sets.
  return {{"sim", text(&Settings::sim)},
          {"frames", [](Settings& s, const std::string& v) { s.frames = std::stoi(v); }},
          {"colour", flag(&Settings::colour)},
          {"registration", flag(&Settings::registration)},
          {"sync", flag(&Settings::sync)},
          {"upright", flag(&Settings::upright)},
          {"field_of_view", flag(&Settings::field_of_view)},
          {"mirror_fixed", flag(&Settings::mirror_fixed)},
          {"lies", flag(&Settings::lies)},
          {"plugged", flag(&Settings::plugged)},
          {"uri", text(&Settings::uri)},
          {"second_uri", text(&Settings::second_uri)},
          {"fps", real(&Settings::fps)},
          {"latency", real(&Settings::latency)},
          {"drift_ppm", real(&Settings::drift_ppm)},
          {"clock_offset_us", [](Settings& s, const std::string& v) { s.clock_offset_us = std::stoll(v); }},
          {"fault", text(&Settings::fault)},
          {"cured_by_reopen", flag(&Settings::cured_by_reopen)}};
}

void set(Settings& settings, const std::string& line) {
  // Never destroyed, since the driver's thread may outlive the end of main.
  static const auto& known = *new std::map<std::string, Setter>(setters());
  const auto equals = line.find('=');
  const auto setter = known.find(line.substr(0, equals));
  if (equals == std::string::npos || setter == known.end()) throw std::invalid_argument("unknown key");
  setter->second(settings, line.substr(equals + 1));
}

}  // namespace

std::shared_ptr<const Settings> read_settings() {
  auto settings = std::make_shared<Settings>();
  const char* path = std::getenv("BAREHAND_VIRTUAL_OPENNI2");
  std::ifstream file(path ? path : "");
  for (std::string line; std::getline(file, line);) {
    if (line.empty()) continue;
    try {
      set(*settings, line);
    } catch (const std::exception& e) {
      std::cerr << "virtual OpenNI2 device: " << path << ": \"" << line << "\": " << e.what() << std::endl;
    }
  }
  return settings;
}

}  // namespace barehand::virtual_openni
