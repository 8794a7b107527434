// Decides whether a request comes from the program's own page, to refuse those of other web sites.
#include "io/web/allowed_origin.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace barehand {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// The host name without port and brackets: "::1" of "[::1]:8765", "localhost" of "localhost:8765".
std::string name_of(std::string_view host) {
  if (host.starts_with('[')) return lower(host.substr(1, host.find(']') - 1));
  return lower(host.substr(0, host.find(':')));
}

bool is_number_address(const std::string& name) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(AF_INET, name.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, name.c_str(), address.data()) == 1;
}

std::string machine_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "";
  return lower(name.data());
}

}  // namespace

bool is_own_host(std::string_view host) {
  const std::string name = name_of(host);
  if (name.empty()) return false;
  if (name == "localhost" || name.ends_with(".localhost") || is_number_address(name)) return true;
  const std::string machine = machine_name();
  return !machine.empty() && (name == machine || name == machine + ".local");
}

bool is_allowed_origin(std::string_view origin, std::string_view host, std::span<const std::string> allowed_origins) {
  if (origin.empty() || lower(origin) == "http://" + lower(host)) return true;
  return std::ranges::find(allowed_origins, origin) != allowed_origins.end();
}

}  // namespace barehand
