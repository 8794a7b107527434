// Decides whether a request comes from the program's own page, to refuse those of other web sites.
#include "io/web/allowed_origin.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <utility>

#include "core/quote.h"

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

/// An origin as browsers write it: in lower case, without a slash at its end, and without the port that its scheme has.
std::string plain(std::string_view origin) {
  std::string out = lower(origin);
  if (out.ends_with('/') && !out.ends_with("//")) out.pop_back();
  for (const auto& [scheme, port] : {std::pair("http://", ":80"), std::pair("https://", ":443")})
    if (out.starts_with(scheme) && out.ends_with(port)) out.resize(out.size() - std::strlen(port));
  return out;
}

}  // namespace

std::string wrong_origin(const std::string& text) {
  const auto scheme = text.find("://");
  const bool right =
      scheme != std::string::npos && scheme > 0 && plain(text).find('/', scheme + 3) == std::string::npos;
  return right ? "" : in_quotes(text) + " is no origin: give one such as https://example.org or http://localhost:8000";
}

bool is_own_host(std::string_view host) {
  const std::string name = name_of(host);
  if (name.empty()) return false;
  if (name == "localhost" || name.ends_with(".localhost") || is_number_address(name)) return true;
  const std::string machine = machine_name();
  return !machine.empty() && (name == machine || name == machine + ".local");
}

bool is_allowed_origin(std::string_view origin, std::string_view host, std::span<const std::string> allowed_origins) {
  if (origin.empty() || lower(origin) == "http://" + lower(host)) return true;
  return std::ranges::find(allowed_origins, plain(origin), plain) != allowed_origins.end();
}

}  // namespace barehand
